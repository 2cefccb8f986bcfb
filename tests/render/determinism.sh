#!/bin/sh
# The same pixels from any number of threads, from strips, and after an interruption (common.sh). With tilt, blur and
# adaptive numbers of samples, where what a pixel gets depends on its neighbours.
#
# Stock itself, measured with its perspective camera: the same pixels for any number of threads and any strips without
# blur, with its own focal blur, and with area lights without jitter. Not so with area_light jitter or media jitter,
# whose random numbers every thread draws for itself (2 to 4 thousand of 15 thousand pixels differ, by up to 0.06), and
# with radiosity, whose samples depend on the order of pixels (two pixels of three). One thread and the whole picture
# repeat those exactly; strips do not. There tilt_lens can do no better; case `stock` measures the first.
. "$(dirname "$0")/common.sh"

size="+W150 +H101" # no multiple of the 32 x 32 blocks
scene() {
	printf '%s\n' '#include "oracle-scene.inc"' "camera { $1 $view $2 }" "$3" > scene.pov
}
lens=$tilted blur='blur_samples 16, 128 variance 1/4000 confidence 0.9'
area='light_source { <6, 9, -4> rgb <0.5, 0.4, 0.3> area_light <3, 0, 0>, <0, 0, 3>, 5, 5 adaptive 1 circular orient }'

state() {
	[ -f killed.pov-state ] && wc -c < killed.pov-state || echo 0
}

# start_to_kill OPTION...: killed.ppm, in the background.
start_to_kill() {
	"$ours" -D $size -A +WT1 +FP16 File_Gamma=1 "+L$here" +Iscene.pov +Okilled.ppm "$@" < /dev/null > killed.log 2>&1 &
	process=$!
}
# until_or_ended COMMAND...
until_or_ended() {
	until "$@" || ! kill -0 $process 2> /dev/null; do
		sleep 0.02
	done
}
# Whether it was killed, and not at its end before (128 + 9), and left what can be continued.
killed() {
	kill -9 $process 2> /dev/null
	wait $process 2> /dev/null
	[ $? = 137 ] && [ "$(state)" -gt 0 ]
}

larger() { [ "$(state)" -gt "$1" ]; }
# kill_at BYTES: begins or continues killed.ppm, and kills it when its state, which grows by 12 kB with every block, is larger.
kill_at() {
	start_to_kill +C
	until_or_ended larger "$1"
	killed || fail "finished before it could be killed"
	echo "killed with $(state) bytes of state"
}

traced() { [ "$(tr '\r' '\n' < killed.log | sed -n 's/.*pixels (\([0-9]*\)%).*/\1/p' | tail -1 | grep . || echo 0)" -ge "$1" ]; }
# kill_traced PERCENT [shown]: begins killed.ppm, and kills it when so much is traced; shown: and its state has grown since. Where it was too late,
# again: how fast the machine is nobody knows.
kill_traced() {
	for attempt in 1 2 3 4 5 6 7 8 9 10; do
		rm -f killed.ppm killed.pov-state
		start_to_kill
		until_or_ended traced "$1"
		[ "${2:-}" != shown ] || until_or_ended larger "$(state)"
		killed && traced "$1" && echo "killed at $* % with $(state) bytes of state" && return
	done
	fail "finished ten times before it could be killed at $* %"
}

# PROGRAM, what it shows, the last row of the upper part, the last row of all
threads_and_rows() {
	render "$1" whole.ppm scene.pov $size
	for n in 2 4; do
		render "$1" threads.ppm scene.pov $size +WT$n
		check "$2, $n threads" "$compare" same whole.ppm threads.ppm
	done
	render "$1" top.ppm scene.pov $size +SR1 +ER$3
	render "$1" bottom.ppm scene.pov $size +SR$(($3 + 1)) +ER$4
	check "$2, rows" "$compare" sum whole.ppm top.ppm bottom.ppm
}

threads_and_strips() {
	threads_and_rows "$1" "$2" 50 101
	render "$1" left.ppm scene.pov $size +SC1 +EC77
	render "$1" right.ppm scene.pov $size +SC78 +EC150
	check "$2, columns" "$compare" sum whole.ppm left.ppm right.ppm
	render "$1" corner.ppm scene.pov $size +SR51 +ER101 +SC78 +EC150
	render "$1" bottom-left.ppm scene.pov $size +SR51 +ER101 +SC1 +EC77
	check "$2, quarters" "$compare" sum whole.ppm top.ppm bottom-left.ppm corner.ppm
}

case $case in
plain)
	scene "$lens" "$blur" ""
	threads_and_strips "$ours" "tilt and blur"
	grep 'Samples/Pixel:   min 16 .* max 128 ' whole.ppm.log || fail "the number of samples does not adapt: nothing shown"
	;;
near)
	# What shadowed a light last is asked first, and shadows from 0.0001 on, others from 0.001: a scene in metres of things of millimetres.
	# Seen through its thread's last shadow a pixel would be another.
	printf '%s\n' '#declare Oracle_Placement = transform { scale 0.002 };' '#include "oracle-scene.inc"' "camera { tilt_lens { focal_plane_tilt 60 tilt_direction 30 focal_distance 0.016 aperture_diameter 0.0008 }
		location <0, 0.0052, -0.007> right x * 4 / 3 up y direction z * 1.5 look_at <0, 0.0024, 0.012> $blur }" > scene.pov
	threads_and_strips "$ours" "surfaces that nearly touch"
	# So through a lens without an opening that moves rays, and in the preview of focus.
	for words in 'distortion 0.05' 'show plane aperture_diameter 0.0008'; do
		sed "s/tilt_lens {/tilt_lens { $words/; s/aperture_diameter 0.0008 }/}/" scene.pov > one-ray.pov
		cp one-ray.pov scene.pov
		threads_and_strips "$ours" "surfaces that nearly touch, $words"
	done
	;;
few)
	# Pixels of one sample, which are judged by their neighbours'.
	for least in 1 2; do
		scene "$lens" "blur_samples $least, 64 variance 1/1000" ""
		threads_and_strips "$ours" "tilt and blur from $least on"
		grep "Samples/Pixel:   min $least .* max 64 " whole.ppm.log || fail "no pixel has $least: nothing shown"
	done
	;;
aberrations)
	# With what else moves or withholds rays.
	scene 'tilt_lens { lens_tilt 12 tilt_direction 30 focal_distance 8 aperture_diameter 0.4 aberrations { spherical -2 coma 8 astigmatism 20 distortion 20
		fifth_order { 0.5, 0, 0, 1, 0, 0, 0, 0, 0, 0 } } blades 7 vignetting optical 0.3, 0.5, 0.28, -0.6 chromatic lateral 0.002, -0.003 }' "$blur" ""
	threads_and_strips "$ours" "aberrations"
	grep 'Samples/Pixel:   min 16 .* max 128 ' whole.ppm.log || fail "the number of samples does not adapt: nothing shown"
	;;
denoise)
	scene "$(echo "$lens" | sed 's/tilt_lens *{/tilt_lens { denoise/')" "$blur" ""
	threads_and_strips "$ours" "tilt, blur and denoise"
	grep 'before denoise' whole.ppm.log || fail "not denoised: nothing shown"
	# An interrupted one begins anew, and ends the same: killed at several times, some of them in the second pass, which begins when all is traced and
	# shows the pixels. None of these may be taken for final.
	scene "$(echo "$lens" | sed 's/tilt_lens *{/tilt_lens { denoise/')" "blur_samples 2" ""
	size="+W640 +H480"
	render "$ours" whole.ppm scene.pov $size
	for moment in 40 90 100 '100 shown'; do
		kill_traced $moment
		render "$ours" killed.ppm scene.pov $size +C
		grep -q 'Continued trace......On' killed.ppm.log || fail "not continued"
		check "killed at $moment %, continued" "$compare" same whole.ppm killed.ppm
	done
	;;
area_light)
	scene "$lens" "$blur" "$area"
	threads_and_strips "$ours" "tilt, blur and area light"
	;;
random)
	# What draws random numbers. Under tilt_lens each pixel's begin with the pixel.
	random='light_source { <6, 9, -4> rgb <0.5, 0.4, 0.3> area_light <3, 0, 0>, <0, 0, 3>, 4, 4 jitter }
		sphere { <1.2, 1, 2>, 0.7 pigment { rgb 0.8 } finish { crand 0.4 } }
		sphere { <-1.4, 1.2, 3>, 1 hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.4 } samples 3 jitter 1 } } }
		sphere { <0, 0.6, 1>, 0.5 pigment { rgb <0.9, 0.6, 0.5> } finish { subsurface { translucency 0.3 } } interior { ior 1.3 } }'
	size="+W75 +H51"
	scene "$lens" 'blur_samples 4, 16 variance 1/1000' "global_settings { subsurface { samples 4, 4 } } $random"
	threads_and_rows "$ours" "random numbers" 20 51
	cp whole.ppm seed0.ppm
	# They are random: each kind's absence shows, beside the grain of the lens.
	sed 's/tilt_lens {/tilt_lens { seed 1/' scene.pov > seeded.pov
	render "$ours" seed1.ppm seeded.pov $size
	check "another seed" "$compare" differ 0.005 seed0.ppm seed1.ppm
	for word in 4,.4.jitter crand.0.4 jitter.1; do
		sed "s/\($(echo "$word" | sed 's/4,.4.jitter/4, 4\\) jitter/; s/crand.0.4/\\) crand 0.4/; s/jitter.1/samples 3\\) jitter 1/')/\1/" scene.pov > without.pov
		cmp -s scene.pov without.pov && fail "the scene has no $word"
		render "$ours" without.ppm without.pov $size
		check "$word matters" "$compare" differ 0.0005 seed0.ppm without.ppm
	done
	# Without an opening, where the lens moves rays.
	scene 'tilt_lens { focal_distance 8 distortion -0.05 }' '' "$random"
	threads_and_rows "$ours" "random numbers of a pinhole" 20 51
	# Its rays are the same for all seeds: what differs is their random numbers.
	cp whole.ppm seed0.ppm
	sed 's/tilt_lens {/tilt_lens { seed 1/' scene.pov > seeded.pov
	render "$ours" seed1.ppm seeded.pov $size
	check "another seed of a pinhole" "$compare" differ 0.005 seed0.ppm seed1.ppm
	# And nothing differs where nothing draws any.
	scene 'tilt_lens { focal_distance 8 distortion -0.05 }' '' ''
	render "$ours" still0.ppm scene.pov $size
	sed 's/tilt_lens {/tilt_lens { seed 1/' scene.pov > seeded.pov
	render "$ours" still1.ppm seeded.pov $size
	check "another seed where nothing is random" "$compare" same still0.ppm still1.ppm
	;;
stock)
	scene perspective "aperture 0.8 focal_point <0, 1.42, 4.5> blur_samples 37 variance 1/4000 confidence 0.9" "$area"
	threads_and_strips "$stock" "stock's blur, area light"
	sed 's/adaptive 1/jitter adaptive 1/' scene.pov > jitter.pov
	render "$stock" whole.ppm jitter.pov $size
	render "$stock" threads.ppm jitter.pov $size +WT4
	echo "stock with jitter, 4 threads: $("$compare" same whole.ppm threads.ppm)"
	;;
continued)
	# Killed midway, three times, each time at another place; then left to finish.
	scene "$lens" 'blur_samples 64, 256 variance 1/50000 confidence 0.9' "$area"
	render "$ours" whole.ppm scene.pov $size
	for at in 30000 90000 200000; do
		kill_at $at
	done
	render "$ours" killed.ppm scene.pov $size +WT2 +C
	check "continued" "$compare" same whole.ppm killed.ppm
	# What continues is what was left, not the whole.
	grep -q 'Continued trace......On' killed.ppm.log || fail "not continued"
	before=$(sed -n 's/^Rays: *\([0-9]*\).*/\1/p' whole.ppm.log) after=$(sed -n 's/^Rays: *\([0-9]*\).*/\1/p' killed.ppm.log)
	[ "$after" -lt "$before" ] || fail "continued with $after rays, the whole takes $before"
	# What a picture to be denoised needs is not in the file that a render without left: it begins anew, and knows its error.
	rm -f killed.ppm killed.pov-state
	kill_at 90000
	scene "$(echo "$lens" | sed 's/tilt_lens *{/tilt_lens { denoise/')" "blur_samples 4" "$area"
	render "$ours" whole.ppm scene.pov $size
	render "$ours" killed.ppm scene.pov $size +C
	check "denoised after one that was not" "$compare" same whole.ppm killed.ppm
	[ "$(grep Estimated whole.ppm.log)" = "$(grep Estimated killed.ppm.log)" ] || fail "its error: $(grep Estimated whole.ppm.log killed.ppm.log)"
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
