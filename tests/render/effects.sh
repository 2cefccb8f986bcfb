#!/bin/sh
# Effects by pictures that stock POV-Ray makes of their definition, or that must be the same (common.sh). Blades, the
# rim of vignetting optical and chromatic aberration through an opening are in oracle_cases.cpp.
. "$(dirname "$0")/common.sh"

# camera NAME BLOCK OUTSIDE [SCENE]: with tilt_lens.
world='#include "oracle-scene.inc"'
tilted_camera() {
	printf '%s\n' "$world" "camera { tilt_lens { $2 } $view $3 }" > "$1.pov"
}
picture() {
	name=$1
	shift
	tilted_camera "$name" "$1" "$2"
	shift 2
	render "$ours" "$name.exr" "$name.pov" "$@"
}

case $case in
natural)
	# An even background: what is left is the fall-off. Stock draws it as a pigment on a wall at depth 1000: the angles
	# to the sensor's normal and to the lens's, which leans by 20 degrees, from the directions themselves.
	cat > truth.pov <<- END
		#version 3.7;
		global_settings { assumed_gamma 1 }
		#declare NY = -sin(radians(20)); #declare NZ = cos(radians(20));
		#declare Sensor = function(X, Y) { cos(atan2(sqrt(X * X + Y * Y), 1)) }
		#declare Lens = function(X, Y) { cos(acos((Y * NY + NZ) / sqrt(X * X + Y * Y + 1))) }
		#declare Falloff = function(X, Y) { Lens(X, Y) * pow(Sensor(X, Y) / NZ, 3) }
		plane { -z, -1000 pigment { function { 0.5 * Falloff(x / 1000, y / 1000) } color_map { [0 rgb 0] [1 rgb 1] } } finish { emission 1 ambient 0 diffuse 0 } }
		camera { perspective right x * 4 / 3 up y direction z * 0.9 }
	END
	render "$stock" truth.exr truth.pov
	for aperture in 0 0.2; do
		printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } background { rgb 0.5 }' "camera { tilt_lens { lens_tilt 20 focal_distance 5
			image_distance 0.9 aperture_diameter $aperture vignetting natural } right x * 4 / 3 up y direction z * 0.9 blur_samples 64 variance 0 }" > natural.pov
		render "$ours" natural.exr natural.pov
		# Half floats hold eleven bits: 0.00012 RMS at 0.5.
		check "aperture $aperture" "$compare" rms 0.0004 truth.exr natural.exr
	done
	# Which the fourth power of the cosine to the lens axis is not.
	sed 's/#declare Falloff.*/#declare Falloff = function(X, Y) { pow(Lens(X, Y), 4) }/' truth.pov > fourth.pov
	render "$stock" fourth.exr fourth.pov
	check "is not cos^4 to the lens axis" "$compare" differ 0.01 fourth.exr natural.exr
	;;
rim)
	# The rim as a thing of the scene, before the same lens: the same samples, so the same pixels.
	words='lens_tilt 12 tilt_direction 40 focal_distance 8 aperture_diameter 0.4'
	picture rim "$words vignetting optical 0.25, 0.7" 'blur_samples 64 variance 0'
	# n = (-sin 40 sin 12, -cos 40 sin 12, cos 12) in the camera frame, which look_at turns about x by 8.38 degrees.
	cat > real.pov <<- END
		#include "oracle-scene.inc"
		#declare View = transform { rotate x * degrees(atan2(2.6 - 1.2, 9.5)) translate <0, 2.6, -3.5> }
		#declare N = <-sin(radians(40)) * sin(radians(12)), -cos(radians(40)) * sin(radians(12)), cos(radians(12))>;
		disc { 0.7 * N, N, 50, 0.25 pigment { rgb 0 } finish { ambient 0 diffuse 0 } no_shadow no_reflection transform { View } }
		camera { tilt_lens { $words } $view blur_samples 64 variance 0 }
	END
	render "$ours" real.exr real.pov
	# Rays that just graze the rim may round either way: a few pixels by a sixty-fourth.
	check "a real rim" "$compare" rms 0.0004 real.exr rim.exr
	picture open "$words" 'blur_samples 64 variance 0'
	check "is seen" "$compare" differ 0.05 open.exr rim.exr
	# Rims that cut nothing change nothing; one at the lens itself is the same just behind it.
	picture wide "$words vignetting optical 0.25, 0.7, 1e30, -1, 1e30, 0, 1e30, 3" 'blur_samples 64 variance 0'
	check "wide rims" "$compare" rms 0 wide.exr rim.exr
	picture order "$words vignetting optical 0.3, -0.8, 0.25, 0.7" 'blur_samples 64 variance 0'
	picture other "$words vignetting optical 0.25, 0.7, 0.3, -0.8" 'blur_samples 64 variance 0'
	check "their order" "$compare" rms 0 order.exr other.exr
	check "the one behind is seen" "$compare" differ 0.02 rim.exr other.exr
	picture at_lens "$words vignetting optical 0.15, 0" 'blur_samples 64 variance 0'
	picture just_behind "$words vignetting optical 0.15, -1e-12" 'blur_samples 64 variance 0'
	check "a rim at the lens" "$compare" rms 0 at_lens.exr just_behind.exr
	check "is seen there" "$compare" differ 0.05 at_lens.exr open.exr
	# It is a smaller aperture's edge, and the light is less by its area: 0.45 of 0.6, 0.5625. Of 4096 samples this share is known to
	# sqrt(p (1 - p) / 4096) or better, of light 0.5: 0.0039; the smaller aperture's picture to 0.0015.
	waves='#version 3.7; global_settings { assumed_gamma 1 } plane { <-0.35, -0.45, 1>, 0 pigment { function { 0.5 + 0.22 * sin(10 * x) + 0.22 * sin(10 * y) }
		color_map { [0 rgb 0] [1 rgb 1] } } finish { ambient 0 diffuse 0 emission'
	oracle=$world words='lens_tilt 12 tilt_direction 40 focal_distance 9 aperture_diameter'
	world="$waves 1 } translate <0, 2.6, 1.8> }"
	picture at_lens "$words 1.2 vignetting optical 0.45, 0" 'blur_samples 4096 variance 0' +W40 +H30
	world="$waves 0.5625 } translate <0, 2.6, 1.8> }"
	picture smaller "$words 0.9" 'blur_samples 4096 variance 0' +W40 +H30
	picture as_large "$words 1.2" 'blur_samples 4096 variance 0' +W40 +H30
	check "is a smaller aperture" "$compare" rms 0.0042 at_lens.exr smaller.exr
	check "is not a darker one" "$compare" differ 0.0168 at_lens.exr as_large.exr
	world=$oracle
	# One at the sensor, 1.5 behind an untilted lens, is a disc of the picture, which is 4/3 x 1 there: its corners are 0.833 from the middle, its
	# sides 0.5. A pixel is 1/90; rays through an opening of 0.4 meet the sensor in the pixel alone.
	picture sensor 'focal_distance 8 aperture_diameter 0.4 vignetting optical 0.6, -1.5' 'blur_samples 16 variance 0'
	picture whole 'focal_distance 8 aperture_diameter 0.4' 'blur_samples 16 variance 0'
	check "a rim at the sensor" "$compare" differ 0.05 sensor.exr whole.exr
	black=0
	for row in $(seq 0 89); do
		# Left of the disc in this row, the pixel that its edge may cut left out; right of it as many.
		n=$(awk -v row=$row 'BEGIN { near = row < 45 ? (44 - row) / 90 : (row - 45) / 90; if (near < 0) near = 0
			at = near < 0.6 ? sqrt(0.36 - near * near) : 0; print int(60 - 90 * at) }')
		[ "$n" -gt 0 ] || continue
		"$compare" all 0,0,0 "0,$row,$((n - 1)),$row" sensor.exr > check.txt && "$compare" all 0,0,0 "$((120 - n)),$row,119,$row" sensor.exr > check.txt ||
			fail "not black beyond a rim at the sensor, row $row: $(cat check.txt)"
		black=$((black + 2 * n))
	done
	[ $black -gt 0 ] || fail "no pixel beyond a rim at the sensor: nothing shown"
	echo "a rim at the sensor: $black pixels beyond it are black"
	for window in '23 98 8 83' '13 108 23 68' '35 86 1 90'; do   # half widths and heights 0.42, 0.42; 0.53, 0.26; 0.29, 0.5: less than 0.6 from the middle
		set -- $window
		for name in sensor whole; do
			render "$ours" $name-part.exr $name.pov +SC$1 +EC$2 +SR$3 +ER$4
		done
		check "within a rim at the sensor, $window" "$compare" same sensor-part.exr whole-part.exr
	done
	picture all_of_it 'focal_distance 8 aperture_diameter 0.4 vignetting optical 0.84, -1.5' 'blur_samples 16 variance 0'
	check "beyond the corners" "$compare" rms 0 all_of_it.exr whole.exr
	;;
bokeh)
	# A round white pigment is the round opening: within twice what two sets of 2048 samples differ by (seeds 0 and 1: 0.0007 RMS). A square one is
	# four times as far from it at least.
	lens="focal_plane_tilt 30 focal_distance 8 aperture_diameter 0.8"
	round='bokeh { pigment { cylindrical scale 0.5 rotate 90 * x translate <0.5, 0.5, 0> color_map { [0.001 rgb 0] [0.001 rgb 1] } } }'
	picture disc "$lens" 'blur_samples 2048 variance 0'
	picture round "$lens" "blur_samples 2048 variance 0 $round"
	check "a round pigment is the disc, and its exposure" "$compare" rms 0.0014 disc.exr round.exr
	picture square "$lens" "blur_samples 2048 variance 0 bokeh { pigment { rgb 1 } }"
	picture white "$lens" "blur_samples 256 variance 0 bokeh { pigment { rgb 1 } }"
	picture grey "$lens" "blur_samples 256 variance 0 bokeh { pigment { rgb 0.3 } }"
	check "grey is no darker" "$compare" rms 2e-4 white.exr grey.exr
	check "a square is not a disc" "$compare" differ 0.0056 disc.exr square.exr
	# Off the centre the picture would move: the same pigment, half a lens to the side.
	picture aside "$lens" "blur_samples 512 variance 0 $(echo "$round" | sed 's/translate <0.5/translate <0.9/')"
	check "is centred" "$compare" differ 0.01 disc.exr aside.exr
	# Colours stay where the picture is sharp: a wall in focus, under a pigment of two colours, and a hue all over changes nothing. 32768 samples of
	# the pigment's two halves, of which digital nets take as many; what is left is the mean's 128 x 128 points.
	wall='#version 3.7; global_settings { assumed_gamma 1 } plane { z, 8 pigment { rgb <0.2, 0.4, 0.6> } finish { emission 1 diffuse 0 ambient 0 } }'
	for pigment in 'gradient x color_map { [0.5 rgb <1, 0.2, 0.1>] [0.5 rgb <0.2, 1, 0.1>] }' 'rgb <1, 0.5, 0.25>'; do
		printf '%s\n' "$wall" "camera { tilt_lens { focal_distance 8 aperture_diameter 0.4 } location 0 look_at z blur_samples 64 variance 0 bokeh { pigment { $pigment } } }" > wall.pov
		render "$ours" wall.ppm wall.pov
		check "in focus, $pigment" "$compare" all 0.2,0.4,0.6 0,0,119,89 wall.ppm
	done
	# Nor has a wall out of focus any grain, with few samples: light that is the same all over the lens is divided by the same weights
	# as it is multiplied with. Sixteen samples, adaptive ones too, and with wavelengths apart and a second rim.
	paint='pigment { gradient x color_map { [0 rgb <1, 0.2, 0.1>] [0.3 rgb <0.3, 0.05, 0.4>] [1 rgb <0.2, 1, 0.1>] } }'
	for words in 'focal_distance 3' 'focal_distance 3 blades 5' 'focal_distance 3 chromatic axial 0.02, -0.02'; do
		for samples in '16 variance 0' '8, 64 variance 1e-6'; do
			printf '%s\n' "$wall" "camera { tilt_lens { $words aperture_diameter 0.4 } location 0 look_at z blur_samples $samples bokeh { $paint } }" > flat.pov
			render "$ours" flat.ppm flat.pov
			# Rounding: of 16 bits in the file, of 24 in POV-Ray's colours.
			check "flat, $words, $samples" "$compare" flat 1.6e-5 flat.ppm
		done
		# The adaptive ones have nothing to do.
		grep -q 'Samples/Pixel: *min 8 *mean 8.00 ' flat.ppm.log || fail "$words: $(grep Samples/Pixel flat.ppm.log) where nothing varies"
	done
	# Openings that few samples meet: of four samples none in one pixel of 22 through the ellipse, and in nearly all of them through the spot.
	# No pixel is black for that, and where light is even over the lens the estimate has nothing to say.
	for opening in '<0.25, 0.5, 1>' '<0.07, 0.14, 1>'; do
		spot="pigment { cylindrical color_map { [0 rgb 0] [0.0001 rgb 1] } rotate 90*x scale $opening translate <0.5, 0.5, 0> }"
		printf '%s\n' "$wall" "camera { tilt_lens { focal_distance 3 aperture_diameter 0.4 } location 0 look_at z blur_samples 4, 64 variance 0.0001 bokeh { $spot } }" > spot.pov
		render "$ours" spot.ppm spot.pov
		check "even light through $opening" "$compare" flat 1.6e-5 spot.ppm
		grep -q 'Estimated Error: 0.00000 ' spot.ppm.log || fail "$opening: $(grep Estimated spot.ppm.log) where nothing varies"
		# Nothing there, through all of the opening: transparent, and certain of it.
		sed 's/^.*plane/#version 3.7; global_settings { assumed_gamma 1 } #declare None = plane/' spot.pov > none.pov
		render "$ours" none.png none.pov +UA
		grep -q 'Samples/Pixel: *min 4 .* Camera Rays: ' none.png.log || fail "$opening: $(grep Samples/Pixel none.png.log)"
		most=$(sed -n 's/.*Samples\/Pixel:.* mean \([0-9]*\).*/\1/p' spot.ppm.log)
		grep -q 'Estimated Error: 0.00000 ' none.png.log || fail "$opening: $(grep Estimated none.png.log) where nothing is"
		render "$ours" none.exr none.pov +UA
		[ "$("$compare" empty none.exr)" = "100.00 0.00" ] || fail "$opening: of nothing $("$compare" empty none.exr) % are empty"
		[ "$(sed -n 's/.*Samples\/Pixel:.* mean \([0-9]*\).*/\1/p' none.png.log)" -le "$most" ] || fail "$opening: empty pixels take more samples than even ones: $(grep Samples/Pixel none.png.log)"
	done
	# A colour that gets through nowhere is gone.
	sed 's/rgb <1, 0.5, 0.25>/rgb <1, 0, 0>/' wall.pov > red.pov
	render "$ours" red.ppm red.pov
	check "red alone" "$compare" all 0.2,0,0 0,0,119,89 red.ppm
	# What is blurred has the colours apart.
	picture halves "$lens" "blur_samples 256 variance 0 bokeh { pigment { gradient x color_map { [0.5 rgb <1, 0.2, 0.1>] [0.5 rgb <0.2, 1, 0.1>] } } }"
	# The samples are the same: what differs is colour.
	check "coloured discs" "$compare" differ 0.005 white.exr halves.exr
	# Blades cut the pigment's square: white all over is the blades alone, point by point.
	picture blades "$lens blades 6 rotation 10" 'blur_samples 64 variance 0'
	picture painted "$lens blades 6 rotation 10" 'blur_samples 64 variance 0 bokeh { pigment { rgb 1 } }'
	check "white blades" "$compare" rms 1e-4 blades.exr painted.exr
	# Options in any order.
	picture one_order "$lens blades 6 rotation 10 curvature 0.3 chromatic lateral 0.004, -0.006 axial 0.01, 0" 'blur_samples 16 variance 0'
	picture other_order "$lens chromatic axial 0.01, 0 lateral 0.004, -0.006 blades 6 curvature 0.3 rotation 10" 'blur_samples 16 variance 0'
	check "options in another order" "$compare" rms 0 one_order.exr other_order.exr
	grep -q 'Effects: *blades, bokeh' painted.exr.log || fail "the statistics do not name blades, bokeh"
	;;
chromatic)
	# Without an opening: three separate renders by stock, whose windows are 1 / (1 + C) as large, a colour of each.
	picture all 'chromatic lateral -0.02, 0.03' ''
	for colour in 'red 1/0.98' 'green 1' 'blue 1/1.03'; do
		set -- $colour
		printf '%s\n' "$world" "camera { perspective location <0, 2.6, -3.5> right x * 4 / 3 * $2 up y * $2 direction z * 1.5 look_at <0, 1.2, 6> }" > $1.pov
		render "$stock" $1.exr $1.pov
	done
	check "three renders, a colour of each" "$compare" channels 0.002 red.exr green.exr blue.exr all.exr
	check "colours part" "$compare" differ 0.02 green.exr all.exr
	;;
pupils)
	# Untilted, nothing of it is seen; tilted, it is a keystone: the same picture by stock, whose window is put through
	# the pupils by hand. w = 1.5, M = 1.3, lens normal N.
	lens='focal_distance 8 image_distance 1.5'
	picture none "$lens" ''
	picture upright "$lens pupil_magnification 1.3" ''
	check "untilted" "$compare" rms 0.0006 none.exr upright.exr
	picture tilted "$lens lens_tilt 12 pupil_magnification 1.3" ''
	cat > truth.pov <<- END
		#include "oracle-scene.inc"
		#declare N = <0, -sin(radians(12)), cos(radians(12))>;
		// A sensor's point seen from the exit pupil, 1.3 * 1.5 before it; the scene's side has 1.3 times its tangents to N.
		#macro Before(V) #local D = vdot(V, N); (1.3 * (V - D * N) + D * N) #end
		camera { perspective location 0 direction Before(<0, 0, 1.3 * 1.5>) right Before(x * 4 / 3) up Before(y)
			rotate x * degrees(atan2(2.6 - 1.2, 9.5)) translate <0, 2.6, -3.5> }
	END
	render "$stock" truth.exr truth.pov
	# Directions agree to rounding; at edges of the scene a pixel may fall either way.
	check "tilted" "$compare" rms 0.002 truth.exr tilted.exr
	check "is seen" "$compare" differ 0.02 none.exr tilted.exr
	;;
aberrations)
	# Curvature and distortion alone are what field_curvature and distortion are, to lowest order: with r = 0.02 and F = 1/(1/8 + 1/1.5), A = -C r^2 / 2 F
	# and A = -K1 r / F in thousandths. A small opening, so that what they do to the pupil is small.
	lens='focal_distance 8 aperture_diameter 0.04'
	picture bowl "$lens field_curvature -0.9" 'blur_samples 64 variance 0'
	picture curvature "$lens aberrations { curvature 0.1425 }" 'blur_samples 64 variance 0'
	picture flat "$lens" 'blur_samples 64 variance 0'
	# 2 c Q b moves rays by a fiftieth of a pixel at most; a wrong sign would differ by twice what is seen.
	check "curvature is field_curvature" "$compare" rms 0.001 bowl.exr curvature.exr
	check "and is seen" "$compare" differ 0.004 flat.exr bowl.exr
	picture barrel "$lens distortion -0.05" 'blur_samples 64 variance 0'
	picture distortion "$lens aberrations { distortion 0.79167 }" 'blur_samples 64 variance 0'
	# Fifth powers of the slope, 3 K1^2 t^5, are left: 0.0004 in the corners, t = 0.55, 0.1 of a pixel.
	check "distortion is distortion" "$compare" rms 0.003 barrel.exr distortion.exr
	check "and is seen" "$compare" differ 0.015 flat.exr barrel.exr
	# Numbers that belong to the glass: with f_stop 3 given, r is as large in any camera. At a fourth of the opening the slopes 8 N A q^3 / 1000
	# are a 64th, 0.15 pixels at the rim and a tenth of that for most rays; the samples are few. Zeros are no effect at all.
	words='focal_distance 8 focal_length 1.2'
	glass='aberrations { f_stop 3 spherical 3 }'
	for stop in 3 12; do
		picture ideal$stop "$words f_stop $stop" 'blur_samples 64 variance 0'
		picture glass$stop "$words f_stop $stop $glass" 'blur_samples 64 variance 0'
	done
	check "wide open" "$compare" differ 0.02 ideal3.exr glass3.exr
	check "stopped down it heals" "$compare" rms 0.005 ideal12.exr glass12.exr
	picture zeros "$words f_stop 3 aberrations { spherical 0 }" 'blur_samples 64 variance 0'
	check "zeros" "$compare" rms 0 ideal3.exr zeros.exr
	# The opening and alpha: what is blurred beyond all else keeps the mean of an even wall.
	world='#version 3.7; global_settings { assumed_gamma 1 } plane { z, 8 pigment { rgb <0.2, 0.4, 0.6> } finish { emission 1 diffuse 0 ambient 0 } }'
	view='location 0 look_at z'
	picture wall 'lens_tilt 5 focal_distance 6 aperture_diameter 0.5 aberrations { spherical 3 coma 5 astigmatism 20 curvature -10 distortion 30 pupil -40 } blades 6' 'blur_samples 16 variance 0'
	render "$ours" wall.ppm wall.pov
	check "an even wall stays even" "$compare" all 0.2,0.4,0.6 0,0,119,89 wall.ppm
	;;
alpha)
	# What vignetting keeps back is not taken from what stands behind the picture: alpha stays what it is.
	world='#version 3.7; global_settings { assumed_gamma 1 } box { <-1, -4, 7>, <9, 9, 8> pigment { rgb 0.7 } finish { emission 1 diffuse 0 } }'
	view='right x * 4 / 3 up y direction z * 0.9'
	lens='focal_distance 6 aperture_diameter 0.8'
	picture plain "$lens" 'blur_samples 1024 variance 0' +UA
	picture dark "$lens vignetting natural optical 0.6, 1" 'blur_samples 1024 variance 0' +UA
	check "vignetting darkens" "$compare" differ 0.05 plain.exr dark.exr
	# The box's blurred edge lies elsewhere in a lens that is half covered: 0.03 there; all else within rounding.
	check "alpha is not darkened" "$compare" alpha 0.01 plain.exr dark.exr
	picture pinhole 'vignetting natural' '' +UA
	picture sharp '' '' +UA
	check "nor by a pinhole's" "$compare" alpha 1e-6 sharp.exr pinhole.exr
	;;
statistics)
	picture all 'shift <0.05, 0.1> focal_distance 8 distortion -0.02 blades 7 field_curvature 0.02 vignetting natural optical 0.9, 0.5
		chromatic lateral 0.001, -0.001 axial 0.002, -0.001 pupil_magnification 1.1 aberrations { coma 1 }' 'aperture 0.4 blur_samples 16 variance 0'
	text=$(sed -n '/^Effects:/,/^[A-Z][a-z]*\/Pixel/p' all.exr.log | tr -s ' \n' '  ')
	wanted='Effects: shift, pupil_magnification, chromatic lateral, distortion, blades, field_curvature, chromatic axial, aberrations, vignetting natural, vignetting optical'
	case $text in
		"$wanted"*) echo "$text" ;;
		*) fail "the statistics say '$text'" ;;
	esac
	# All of them adapt, and give the same pixels whatever the threads.
	picture one 'focal_distance 8 distortion -0.02 blades 7 vignetting natural optical 0.9, 0.5 chromatic lateral 0.001, -0.001' \
		'aperture 0.4 blur_samples 16, 128 variance 1/4000' +WT1
	render "$ours" two.exr one.pov +WT2
	check "two threads" "$compare" same one.exr two.exr
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
