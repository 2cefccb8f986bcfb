#!/bin/sh
# What tiltcal writes for POV-Ray, rendered (common.sh): targets, and cameras placed by points.
. "$(dirname "$0")/common.sh"

tiltcal=$(dirname "$ours")/tiltcal
markers=$(dirname "$compare")/pose_markers
run() { "$@" > run.txt 2>&1 || { fail "$*: $(tail -3 run.txt)"; finish; } }

case $case in
target)
	# A checkerboard, turned, before a plain pinhole of 900 x 600 pixels, f 48 mm and pixels of 0.04 mm.
	run "$tiltcal" target --board 12x9 --square 25 --out board.inc
	printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } background { rgb 0.35 } #include "board.inc"' \
		'camera { perspective location 0 right 36*x up 24*y direction 48*z }' \
		'object { TiltCal_Target translate <-125, 87.5, 0> rotate x*30 rotate y*15 translate z*800 }' > board.pov
	render "$stock" board.png board.pov +W900 +H600 +FN16 File_Gamma=srgb +A0.0 +AM2 +R4 -J
	run "$tiltcal" detect --board 12x9 board.png --csv board.csv
	# Where the projection puts each corner. 4 x 4 samples a pixel leave a row of an edge uncertain by 0.25 / sqrt(12) = 0.072 px; a corner, which
	# averages rows, must not be worse than one of them.
	awk -F, 'NR > 1 { r = atan2(0, -1) / 180; a = 30 * r; b = 15 * r
			x = $2 * 25 - 125; y = -$3 * 25 + 87.5; z = y * sin(a); y = y * cos(a)
			depth = -x * sin(b) + z * cos(b) + 800; x = x * cos(b) + z * sin(b)
			sum += ($4 - 449.5 - 1200 * x / depth) ^ 2 + ($5 - 299.5 + 1200 * y / depth) ^ 2; n++ }
		END { rms = sqrt(sum / n); print n, "corners,", rms, "px RMS"; exit !(n == 88 && rms < 0.072) }' board.csv || fail "corners of the rendered target"
	# Radiance 0 and 0.8 as declared, whatever the lights.
	run "$tiltcal" target --board 7x6 --kind circles --square 20 --out circles.inc
	printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 ambient_light 3 } #include "circles.inc" light_source { <0, 0, -500> rgb 2 }' \
		'camera { orthographic location z*-100 direction z right 8*x up 6*y } object { TiltCal_Target translate x*WHERE }' > circles.pov
	for where in 0 -10; do
		sed "s/WHERE/$where/" circles.pov > circle.pov
		render "$stock" circle.ppm circle.pov +W4 +H3 +FP8 File_Gamma=1
		tail -c 36 circle.ppm | od -An -v -tu1 | tr -s ' \n' '\n\n' | grep . | sort -u | tr '\n' ' ' > light.txt
		echo "radiance at $where mm: $(cat light.txt)"
		case $where in 0) [ "$(cat light.txt)" = "0 " ] ;; *) [ "$(cat light.txt)" = "204 " ] ;; esac || fail "radiance at $where mm: $(cat light.txt)"
	done
	;;
pose)
	# OpenCV's camera in, a camera block out, in a scene of centimetres; OpenCV says where the markers are.
	run "$markers" make
	run "$tiltcal" import camera.yml --pitch 0.04 --out camera.json
	run "$tiltcal" pose --calibration camera.json --points points.csv --unit-mm 10 --out camera.inc
	grep -q '^reprojection 0.000 px' run.txt || fail "$(tail -2 run.txt)"
	printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } #include "camera.inc"' '#include "markers.inc"' > markers.pov
	render "$ours" markers.png markers.pov +W900 +H600 +FN16 File_Gamma=1 +A0.0 +AM2 +R4 -J
	check "markers" "$markers" check markers.png 0.1 # 16 samples a pixel, of 50 pixels a marker
	;;
denoise)
	# The switch of written cameras: off where nothing is declared; on, the picture is nearer to that of many samples.
	run "$tiltcal" lens "$here/../../scenes/boxes/double-gauss.txt" --focal-length 45 --f-number 2.8 --focus 618 --state plus5:tilt=5 --out lens
	printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } #include "lens/camera-plus5.inc" TiltCal_plus5(0, z, y)' \
		'plane { z, 1500 pigment { checker rgb 0.2 rgb 0.8 scale 100 } finish { ambient 1 diffuse 0 } }' > far.pov
	render "$ours" many.exr far.pov Declare=TiltCal_Blur_Samples=512
	render "$ours" grain.exr far.pov Declare=TiltCal_Blur_Samples=8
	render "$ours" off.exr far.pov Declare=TiltCal_Blur_Samples=8 Declare=TiltCal_Denoise=0
	render "$ours" on.exr far.pov Declare=TiltCal_Blur_Samples=8 Declare=TiltCal_Denoise=1
	check "off" "$compare" rms 0 grain.exr off.exr
	grain=$("$compare" rms 1 many.exr grain.exr | awk '{ print $3 }')
	echo "grain: $grain"
	check "on" "$compare" rms "$grain" many.exr on.exr
	"$compare" rms 0 grain.exr on.exr > /dev/null 2>&1 && fail "TiltCal_Denoise = 1 changes nothing"
	;;
*) fail "no case '$case'" ;;
esac
finish
