#!/bin/sh
# The word channels: further channels of OpenEXR files (common.sh, channels.py).
. "$(dirname "$0")/common.sh"
python="/usr/bin/python3 $here/channels.py"

# scene NAME WORDS [SAMPLES]: a floor beyond the plane of focus and a wall across it; see geometry in channels.py.
scene() {
	cat > "$1.pov" <<-EOF
		#version 3.7;
		global_settings { assumed_gamma 1 }
		camera {
			tilt_lens { focal_plane 0.5 * y, y  aperture_diameter 0.3 $2 }
			location 2 * y right x * 4 / 3 up y direction z
			blur_samples ${3:-8}
		}
		light_source { <5, 9, -6> 1 }
		plane { y, 0 pigment { checker rgb 0.8 rgb <0.2, 0.1, 0.1> } }
		plane {
			<1, 0, 2>, 24 / sqrt(5) clipped_by { plane { y, 5 } }
			pigment { checker rgb <0.3, 0.6, 0.9> rgb 0.1 scale 0.7 } finish { ambient 0.4 }
		}
	EOF
}

case $case in
geometry)
	scene with channels
	scene without ""
	render "$ours" with.exr with.pov
	render "$ours" without.exr without.pov
	check "depth and blur" $python geometry with.exr
	check "samples" $python samples with.exr with.exr.log
	check "colours are the same" "$compare" same with.exr without.exr
	check "names" $python names with.exr R G B Z blur.X samples.X error.X
	check "names without" $python names without.exr R G B
	render "$ours" alpha.exr with.pov +UA
	check "with alpha" $python names alpha.exr R G B A Z blur.X samples.X error.X
	# Of other formats it says so, and writes them as ever.
	render "$ours" with.ppm with.pov
	grep -q 'channels are' with.ppm.log || fail "no word about PPM"
	render "$ours" without.ppm without.pov
	check "PPM" "$compare" same with.ppm without.ppm
	;;
determinism)
	# By threads, in strips, and denoised; a frame without the word has none of the frame before.
	scene view "channels denoise" "4, 16 variance 0.0002"
	render "$ours" whole.exr view.pov
	check "samples" $python samples whole.exr whole.exr.log
	render "$ours" threads.exr view.pov +WT3 +BS8
	check "threads" $python same whole.exr threads.exr
	render "$ours" lower.exr view.pov +SR50
	check "a strip" $python same whole.exr lower.exr 49
	scene frames "#if(frame_number = 1) channels #end"
	render "$ours" frame.exr frames.pov +KFF2
	check "first frame" $python names frame1.exr R G B Z blur.X samples.X error.X
	check "second frame" $python names frame2.exr R G B
	;;
interrupted)
	# A render that was interrupted begins anew: what it has not traced it knows nothing of.
	scene view channels 4000
	render "$ours" whole.exr view.pov +WT2
	"$ours" -D +W120 +H90 -A +WT1 +FE +Iview.pov +Okilled.exr +C < /dev/null > killed.log 2>&1 &
	pid=$!
	for _ in $(seq 100); do
		[ -s killed.pov-state ] && break
		sleep 0.1
	done
	sleep 0.5
	kill -9 $pid && wait $pid 2> /dev/null
	[ -s killed.pov-state ] || fail "it was not interrupted"
	render "$ours" killed.exr view.pov +WT2 +C
	check "went on" $python same whole.exr killed.exr
	;;
error)
	# Fixed and adaptive numbers of samples, and denoised, against 2048 samples of another seed.
	scene truth "seed 77" 2048
	render "$ours" truth.exr truth.pov +WT2
	scene fixed channels 32
	scene adaptive channels "4, 64 variance 0.0001"
	scene denoised "channels denoise" 16
	# From one sample on, of which the pixel itself knows no error.
	scene few channels "1, 64 variance 0.001"
	for how in fixed adaptive denoised few; do
		render "$ours" $how.exr $how.pov
		check "$how" $python error $how.exr truth.exr
	done
	;;
highlights)
	# The same around bright lights, from sharp to discs of many pixels; the mean of eight pictures, since one of few samples may have met
	# a light or not.
	lights() {
		cat > "$1.pov" <<-EOF
			#version 3.7;
			global_settings { assumed_gamma 1 }
			#ifndef (Seed) #declare Seed = 77; #end
			camera {
				tilt_lens { focal_plane <0, 0, 6>, <0.5, 0, 1>  aperture_diameter 0.25  seed Seed  $2 }
				location 0 right x * 4 / 3 up y direction z
				blur_samples $3
			}
			plane { z, 10 pigment { rgb <0.3, 0.25, 0.2> } finish { ambient 1 diffuse 0 } }
			#declare R = seed(4);
			#for (I, 0, 89)
				#local Z = 3 + 6.5 * rand(R);
				sphere { Z * <1.3 * rand(R) - 0.65, rand(R) - 0.5, 1>, 0.008 * Z pigment { rgb 1 } finish { ambient 4 + 8 * rand(R) diffuse 0 } }
			#end
		EOF
	}
	lights truth "" 2048
	render "$ours" truth.exr truth.pov +WT2
	lights fixed channels 16
	lights adaptive channels "8, 64 variance 0.0001"
	lights denoised "channels denoise" 16
	for how in fixed adaptive denoised; do
		for seed in 1 2 3 4 5 6 7 8; do
			render "$ours" $how$seed.exr $how.pov Declare=Seed=$seed
		done
		check "$how" $python highlights $how truth.exr
	done
	;;
radiosity)
	# The first pass of a denoised picture is no pretrace: as many samples of radiosity are kept as without.
	for how in "" denoise; do
		scene "view$how" "$how" 4
		sed -i 's/assumed_gamma 1/assumed_gamma 1 radiosity { count 20 nearest_count 3 error_bound 0.5 pretrace_end 0.04 }/; s/light_source.*/background { rgb 1 }/' "view$how.pov"
		render "$ours" "view$how.exr" "view$how.pov"
		sed -n 's/^ *Radiosity (final) calculated: *\([0-9]*\) .*/\1/p' "view$how.exr.log" > "count$how.txt"
	done
	[ "$(cat count.txt)" -gt 0 ] && cmp count.txt countdenoise.txt || fail "samples: $(cat count.txt) without denoise, $(cat countdenoise.txt) with it"
	;;
*)
	echo "no case '$case'"
	exit 1
	;;
esac
finish
