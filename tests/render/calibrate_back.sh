#!/bin/sh
# Round trip: boards rendered through a known tilt_lens camera, and tiltcal's answer from the pictures (common.sh).
# 900 x 600 pixels of 0.04 mm, four poses a state; the states' tilts are oblique on purpose.
. "$(dirname "$0")/common.sh"

tiltcal=$(dirname "$ours")/tiltcal
scenes=$here/../../scenes/board

board='union { #include "board.inc"'

# photographs STATE TILT DIRECTION CURVATURE [RIMS]
photographs() {
	state=$1 n=0 rims=${5:+vignetting optical $5}
	for pose in "35 0 0 630" "-36 3 2 600" "2 36 0 640" "-3 -37 -4 625"; do
		n=$((n + 1))
		printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } background { rgb 0.35 }' "camera { tilt_lens {
			lens_tilt $2 tilt_direction $3 focal_length 44.6 image_distance 48 aperture_diameter 16 field_curvature $4 $rims }
			location 0 right 36*x up 24*y blur_samples 64 variance 0 }" \
			"$board translate <-125, 87.5, 0>" \
			"$(echo "$pose" | awk '{ print "rotate x*" $1, "rotate y*" $2, "rotate z*" $3, "translate z*" $4 }') }" > "$state-$n.pov"
		render "$ours" "$state-$n.png" "$state-$n.pov" +W900 +H600 +WT2 "+L$scenes" +FN16 File_Gamma=srgb
	done
}

# number NAME [STATE]: of calibration.json, the first from its top or from a state's name on.
number() {
	sed -n "${2:+/\"name\": \"$2\"/,\$}p" result/calibration.json | sed -n "s/^[[:space:]]*\"$1\": \(.*[^,]\),*\$/\1/p" | head -1
}

# tilt STATE TILT DIRECTION LIMIT: the tilt as a vector, degrees.
tilt() {
	error=$(echo "$(number lens_tilt_deg "$1") $(number tilt_direction_deg "$1") $2 $3" | awk '{ r = atan2(0, -1) / 180
		printf "%.4f", sqrt(($1 * sin($2 * r) - $3 * sin($4 * r)) ^ 2 + ($1 * cos($2 * r) - $3 * cos($4 * r)) ^ 2) }')
	if awk "BEGIN { exit !($error < $4) }"; then echo "$1: $error degrees off"; else fail "$1: $error degrees off, more than $4"; fi
}

# within NAME SIGMA TRUTH: a number is told within 3 of its sigmas, as a right one is in 997 of 1000 draws.
within() {
	echo "$(number "$1") $(number "$2") $3" | awk -v name="$1" '{ print name, $1, "+-", $2 ", true " $3; off = ($1 - $3) / $2 } END { exit !(NF == 3 && off < 3 && off > -3) }' || fail "$1: beyond 3 sigma"
}

calibrate() {
	"$tiltcal" calibrate --board 12x9 --square 25 --pitch 0.04 --untilted 'untilted-*.png' --tilted a='a-*.png' --out result > calibrate.log 2>&1 ||
		fail "tiltcal: $(tail -3 calibrate.log)"
}

# told_rightly: the camera that photographed, within what is told of it, and nothing said against the photographs, in which nothing is wrong.
told_rightly() {
	within aperture_diameter_mm aperture_diameter_sigma_mm 16
	within image_distance_mm image_distance_sigma_mm 48
	within focus_distance_mm focus_distance_sigma_mm 629.647   # 1 / (1/44.6 - 1/48)
	within focal_length_mm focal_length_sigma_mm 44.6
	# Two terms or none, and no distortion.
	[ "$(number distortion_terms)" = 0 ] || { within k1 k1_sigma 0; within k2 k2_sigma 0; }
	[ "$(number grade)" = '"good"' ] || fail "the verdict is $(number grade): $(grep '"text"' result/calibration.json)"
}

case $case in
plane)
	# The board that tiltcal itself makes.
	"$tiltcal" target --board 12x9 --square 25 --out target.inc > target.log 2>&1 || fail "tiltcal target: $(cat target.log)"
	board='#include "target.inc" object { TiltCal_Target'
	photographs untilted 0 0 0
	photographs a 8 130 0
	calibrate
	# The best that the source paper has for its lens is 0.030 degrees. By n/f = q + e_z/w that much turns the blur at the sides, 18 mm from the axis,
	# by 18 * d / f * 0.030 degrees = 0.0034 mm, 0.08 of these pixels; the edges are 5 to 20 wide.
	tilt a 8 130 0.030
	[ "$(number model)" = '"plane"' ] || fail "took the model $(number model)"
	told_rightly
	;;
bowl)
	photographs untilted 0 0 -0.001
	photographs a 5 60 -0.001
	calibrate
	tilt a 5 60 0.030
	[ "$(number model)" = '"curved"' ] || fail "took the model $(number model)"
	told_rightly
	number field_curvature_per_mm | awk '{ print "field curvature", $1; n++; C = $1 } END { exit !(n == 1 && C > -0.00102 && C < -0.00098) }' || fail "not -0.001 within 2 %"
	;;
rims)
	# A rim before the lens and one behind it, each of which cuts a fifth of the light at the sides: a blur that is cut looks smaller than the whole lens's.
	photographs untilted 0 0 -0.0006 "12, 18, 8.7, -14.4"
	photographs a 5 60 -0.0006 "12, 18, 8.7, -14.4"
	calibrate
	tilt a 5 60 0.030
	within field_curvature_per_mm field_curvature_sigma_per_mm -0.0006
	told_rightly
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
