#!/bin/sh
# Cameras that no lens can be, and pixels that no ray reaches (common.sh). The rest of the hard cases, which have a
# picture, are compared with the oracle (oracle_cases.cpp).
. "$(dirname "$0")/common.sh"

# refused NAME BLOCK OUTSIDE TEXT...: a parse error that names the scene, line 3 of it, where the camera ends, and says every TEXT.
# misread: the same for what is wrong by itself, which is said at once, on line 2.
where='line 3: Parse Error: tilt_lens:'
misread() {
	where='line 2: Parse Error:'
	refused "$@"
	where='line 3: Parse Error: tilt_lens:'
}
refused() {
	name=$1 block=$2 outside=$3
	shift 3
	printf '%s\n' '// The camera ends on line 3.' "camera { tilt_lens { $block aperture_diameter 0.4 }" \
		"$outside }" 'sphere { z * 9, 2 pigment { rgb 1 } }' > "$name.pov"
	povray_to "$ours" "$name.exr" "$name.pov" && { fail "$name is accepted"; return; }
	# The console breaks lines; one space each makes the text searchable.
	said=$(sed -n '/Error:/,$p' "$name.exr.log" | tr -s '\n ' ' ')
	for text in "File '$name.pov' $where" "$@"; do
		case $said in
			*"$text"*) ;;
			*) fail "$name does not say '$text' but: $said" ;;
		esac
	done
	echo "$name: $said"
}

at_origin='location 0 direction z * 1.5 look_at <0, 0, 9>'
case $case in
refusals)
	refused through_lens "focal_plane <1, 0, 0>, y" "$at_origin" "plane of focus of focal_plane passes through the lens centre"
	refused points_through_lens "focal_points <1, 0, 0>, <0, 0, 5>, <2, 0, 7>" "$at_origin" "of focal_points passes through the lens centre"
	refused point_beside "focal_plane_tilt 45" "location 0 direction z look_at z focal_point <0, 3, 3>" "through focal_point passes through the lens centre"
	refused zero_distance "focal_distance 0" "$at_origin" "focal_distance must not be 0" "through the lens centre"
	# q = -e_z/w
	refused on_sensor "focal_distance -1.5 image_distance 1.5" "$at_origin" "lies on the sensor (1.5 behind the lens); no lens normal"
	# The hinge is U / tan A away: 8 / tan 60 = 4.6188.
	refused hinge "focal_plane_tilt 60 focal_distance 8 focal_length 45" "$at_origin" "hinge lies 4.6188 from the lens, nearer than focal_length 45" "below 4.6188"
	# 1/w = 1/f - 1/U = 1/2 - 1 = -0.5; for a tilted lens cos(10)/2 - 1 = -0.507596.
	refused behind_lens "focal_distance 1 focal_length 2" "$at_origin" "passes 1 from the lens centre, no farther than focal_length 2" "would be -0.5, which must be greater than 0" "below 1."
	# 100 along the axis, but 100 cos 65.3 = 41.787 from the plane; the hinge is 46 away.
	refused behind_tilted "focal_plane_tilt 65.3 focal_distance 100 focal_length 45" "$at_origin" "passes 41.7867 from the lens centre, no farther than focal_length 45"
	refused at_focus "focal_distance 2 focal_length 2" "$at_origin" "which must be greater than 0"
	refused tilted_behind "lens_tilt 10 focal_distance 1 focal_length 2" "$at_origin" "would be -0.507596, which must be greater than 0" "Move the focus away (along the axis beyond 2.03085)"
	refused right_angle "focal_plane_tilt 90" "$at_origin" "must lie between -90 and 90 degrees, but is 90"
	refused line_of_points "focal_points <0, 0, 5>, <1, 0, 6>, <2, 0, 7>" "$at_origin" "lie on one line"
	refused blades_few "blades 2" "$at_origin" "blades must be a whole number from 3 to 64, but is 2"
	refused blades_bent "blades 5 rotation 10 curvature 1.5" "$at_origin" "curvature of blades must lie between 0 (straight) and 1 (a circle), but is 1.5"
	refused rim_closed "vignetting natural optical 10, 3, 0, -1" "$at_origin" "a rim of vignetting optical must have a radius greater than 0 and a finite distance before the lens, but has 0 and -1"
	refused rim_beyond "vignetting natural optical 10, -3" "$at_origin" "lies 3 behind the lens, beyond the sensor, which is 1.5 behind it"
	misread rims_many "vignetting optical 1, 1, 1, 1, 1, 1, 1, 1, 1, 1" "$at_origin" "vignetting optical takes at most 4 rims"
	misread rims_twice "vignetting optical 1, 1 optical 1, 2" "$at_origin" "give another rim behind a comma"
	misread rim_alone "vignetting optical 1, 1, 2" "$at_origin" "Expected 'numeric expression'"
	refused colours "chromatic lateral 0.7, 0" "$at_origin" "chromatic lateral must lie between -0.5 and 0.5"
	refused no_pupil "pupil_magnification 0" "$at_origin" "pupil_magnification must lie between 0.01 and 100"
	refused black_bokeh "focal_distance 9" "$at_origin bokeh { pigment { rgb 0 } }" "the bokeh pigment is black all over the lens"
	refused folds "aberrations { distortion 3000 }" "$at_origin" "the aberrations fold inside the frame: at" "Use smaller numbers"
	refused pupil_of_none "aberrations { spherical 1e7 }" "$at_origin" "spherical of aberrations must lie between -1e6 and 1e6"
	refused stop_of_none "aberrations { f_stop 0 coma 1 }" "$at_origin" "f_stop of aberrations must be greater than 0, but is 0"
	misread rotation_twice "blades 5 rotation 1 curvature 0.1 rotation 2" "$at_origin" "tilt_lens: rotation of blades is given twice"
	misread axial_twice "chromatic axial 0, 1 lateral 0, 0 axial 0, 1" "$at_origin" "tilt_lens: chromatic axial is given twice"
	misread aberration_typo "aberrations { sperical 1 }" "$at_origin" "Unknown word 'sperical' in aberrations; did you mean 'spherical'?"
	misread aberration_twice "aberrations { spherical 1 spherical 2 }" "$at_origin" "tilt_lens: spherical of aberrations is given twice"
	misread etendue_twice "aberrations { etendue etendue }" "$at_origin" "tilt_lens: etendue of aberrations is given twice"
	misread etendue_valued "aberrations { etendue 1 }" "$at_origin" "one of the words of aberrations"
	misread aberrations_twice "aberrations { coma 1 } aberrations { coma 2 }" "$at_origin" "tilt_lens: aberrations is given twice"
	misread aberration_outside "coma 1" "$at_origin" "'coma' follows the word aberrations, as in 'aberrations { coma'"
	misread aberration_reserved "spherical 1" "$at_origin" "'spherical' follows the word aberrations, as in 'aberrations { spherical'"
	misread aberration_sphere "aberrations { sphere 1 }" "$at_origin" "'}' or one of the words of aberrations"
	misread aberrations_open "aberrations coma 1" "$at_origin" "Missing { "
	misread aberrations_unclosed "aberrations { coma 1 blades 5" "$at_origin" "'blades' is no word of aberrations; is their '}' missing before it?"
	misread fifth_few "aberrations { fifth_order { 1, 2, 3 } }" "$at_origin" "fifth_order takes 10 numbers, with commas between, but has 3"
	misread fifth_many "aberrations { fifth_order { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 } }" "$at_origin" "fifth_order takes 10 numbers, and has more"
	# Slips of writing: what was meant, or where it belongs, not the list of all words.
	misread typo "focal_distence 5" "$at_origin" "tilt_lens: Unknown word 'focal_distence' in the tilt_lens block; did you mean 'focal_distance'?"
	misread semicolon "focal_distance 5;" "$at_origin" "tilt_lens: no ';' stands between the words of the block"
	misread comma "focal_distance 5," "$at_origin" "tilt_lens: one value too many, or a ',' between words"
	misread inside "location 0" "$at_origin" "'location' belongs outside the tilt_lens block, behind its '}'; is that missing?"
	misread option "natural" "$at_origin" "'natural' follows the word vignetting"
	misread unknown "banana 3" "$at_origin" "the words are focal_plane_tilt, lens_tilt"
	misread scalar "shift 3" "$at_origin" "tilt_lens: shift takes a vector such as <0, 1>, but 3 is a number"
	misread flat_shift "shift <1, 2, 3>" "$at_origin" "tilt_lens: shift takes a vector such as <0, 1>, but this one has 3 terms"
	misread scalar_point "focal_plane 3, y" "$at_origin" "tilt_lens: focal_plane takes vectors such as <0, 1, 5>, but 3 is a number"
	misread scalar_points "focal_points <0, 0, 5>, 3, <2, 0, 7>" "$at_origin" "tilt_lens: focal_points takes vectors"
	refused not_a_number "focal_distance 1e308 * 10 - 1e308 * 10" "$at_origin" "focal_distance is not a number"
	where='line 3: Parse Error:'
	refused many_samples "" "$at_origin blur_samples 4, 1e12" "Illegal number of focal blur samples: 1e+12. With tilt_lens it must lie between 1 and 1073741824"
	refused no_samples "" "$at_origin blur_samples 0" "Illegal number of focal blur samples: 0"
	refused samples_swapped "" "$at_origin blur_samples 64, 16" "minimum must not be larger than maximum"
	where='line 3: Parse Error: tilt_lens:'
	# Braces.
	sed 's/tilt_lens {/tilt_lens/' typo.pov > open.pov
	sed -i 's/distence/distance/' open.pov
	povray_to "$ours" open.exr open.pov && fail "a missing { is accepted"
	tr -s '\n ' ' ' < open.exr.log | grep -o "line 2: Parse Error: tilt_lens: the { of its block is missing before 'focal_distance'" || fail "a missing {: $(tail -4 open.exr.log)"
	printf '%s\n' 'camera { tilt_lens { focal_distance 5' 'location 0 look_at z }' > close.pov
	povray_to "$ours" close.exr close.pov && fail "a missing } is accepted"
	tr -s '\n ' ' ' < close.exr.log | grep -o "line 2: Parse Error: tilt_lens: 'location' belongs outside .* is that missing?" || fail "a missing }: $(tail -4 close.exr.log)"
	# 0 is the origin, as everywhere in POV-Ray.
	printf '%s\n' 'camera { tilt_lens { focal_plane 0, y shift 0 aperture_diameter 0.1 } location y look_at z }' > zero.pov
	render "$ours" zero.exr zero.pov +W4 +H3
	refused two_planes "lens_tilt 3 focal_plane_tilt 3" "$at_origin" "each state the plane of focus; give one of them"
	;;
warnings)
	# warned NAME BLOCK OUTSIDE OPTIONS TEXT...: renders, and the messages have every text; no text: no warning.
	warned() {
		name=$1 block=$2 outside=$3 options=$4
		shift 4
		printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 }' "camera { tilt_lens { $block } $at_origin $outside }" 'sphere { z * 9, 2 pigment { rgb 1 } }' > "$name.pov"
		# $options: words.
		render "$ours" "$name.exr" "$name.pov" +W4 +H3 $options
		said=$(tr -s '\n ' ' ' < "$name.exr.log")
		[ $# -gt 0 ] || { grep -q 'Warning:' "$name.exr.log" && fail "$name: $(grep -A2 Warning: "$name.exr.log")"; }
		for text in "$@"; do
			case $said in
				*"Warning: $text"*) echo "$name: $text" ;;
				*) fail "$name does not warn '$text'" ;;
			esac
		done
	}
	idle='tilt_lens: without an aperture everything is sharp, and this does nothing:'
	warned focus 'show focus' '' '' "$idle show focus."
	warned smooth 'denoise area_light_grid' '' '' "$idle denoise, area_light_grid."
	warned effects 'blades 5 field_curvature 0.1 chromatic axial 0.1, 0.1' 'bokeh { pigment { rgb 1 } }' '' "$idle field_curvature, blades, bokeh, chromatic axial."
	warned glass 'aberrations { f_stop 4 spherical 1 coma 2 }' '' '' "$idle aberrations."
	warned opening 'denoise blades 5 field_curvature 0.1 aperture_diameter 0.1' 'bokeh { pigment { rgb 1 } }' ''
	warned at_work 'show plane field_curvature 0.1 chromatic lateral 0.1, 0.1 vignetting natural distortion 0.01 shift <0, 0.1> pupil_magnification 1.1 aberrations { f_stop 4 distortion 1 }' '' ''
	# Colours apart from their alpha: only where alpha is written, and not as it is in OpenEXR.
	fringes='tilt_lens: colours that part at the edge of what is transparent are brighter than their alpha,'
	warned fringes 'chromatic lateral 0.1, 0.1' '' '+UA +FN' "$fringes"
	warned exr 'chromatic lateral 0.1, 0.1' '' '+UA +FE'
	warned opaque 'chromatic lateral 0.1, 0.1' '' '+FN'
	# A grey bokeh pigment parts no colours, nor does one that is of one colour everywhere.
	warned coloured 'aperture_diameter 0.1' 'bokeh { pigment { gradient x color_map { [0 rgb <1, 0, 0>] [1 rgb <0, 0, 1>] } } }' '+UA +FN' "$fringes"
	warned grey 'aperture_diameter 0.1' 'bokeh { pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } } }' '+UA +FN'
	warned red 'aperture_diameter 0.1' 'bokeh { pigment { rgb <1, 0.5, 0.25> } }' '+UA +FN'
	warned single 'denoise aperture_diameter 0.1' 'blur_samples 1' '' "tilt_lens: denoise compares the halves of a pixel's samples, and blur_samples 1 has none: it does nothing."
	grep -q 'Estimated Error: unknown' single.exr.log || fail "one sample a pixel: $(grep 'Estimated Error' single.exr.log)"
	# A second camera.
	warned two 'aperture_diameter 0.1' '} camera { location 0 look_at z' '' 'More than one camera in scene. Ignoring previous camera(s).' 'The tilt_lens of the camera before is ignored with it.'
	printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 } camera { location 0 } camera { tilt_lens { } location 0 look_at z }' > second.pov
	render "$ours" second.exr second.pov +W4 +H3
	grep -q 'More than one camera' second.exr.log || fail "stock's own warning is gone"
	grep -q 'tilt_lens of the camera before' second.exr.log && fail "the first camera had no tilt_lens"
	;;
empty)
	# The lens plane cuts the picture at y = 1/tan 75 = 0.26795, the window ends at 0.5/1.5 and has 90 rows: rows that
	# look beyond: 90 (0.5 - 0.26795 * 1.5) = 8.83. The statistics ask a pixel's centre and count 9 of 90 rows; the
	# alpha of 8 is 0, and that of the ninth in between.
	cat > empty.pov <<-EOF
		#include "oracle-scene.inc"
		camera { tilt_lens { lens_tilt 75 focal_distance 8 image_distance 1.5 aperture_diameter 0.2 } $view blur_samples 64 variance 0 }
	EOF
	render "$ours" alpha.exr empty.pov +UA
	render "$ours" black.exr empty.pov
	grep 'Pixels in Focus' alpha.exr.log
	grep -q 'empty 10.00%' alpha.exr.log || fail "the statistics count other than 9 of 90 rows"
	[ "$("$compare" empty alpha.exr)" = "8.89 1.11" ] || fail "alpha: 8 rows empty and one partly expected: $("$compare" empty alpha.exr)"
	# A pinhole with vignetting has no light there either.
	sed 's/aperture_diameter 0.2/vignetting natural/' empty.pov > pinhole.pov
	render "$ours" pinhole.exr pinhole.pov +UA
	grep -q 'empty 10.00%' pinhole.exr.log || fail "the statistics of a pinhole with vignetting count other than 9 of 90 rows"
	# Without +UA the same light, on black.
	[ "$("$compare" empty black.exr)" = "0.00 0.00" ] || fail "transparent without +UA"
	check "without +UA" "$compare" rms 0 alpha.exr black.exr
	# All of the picture behind the lens plane.
	sed 's/lens_tilt 75/lens_tilt 89 shift <0, 0.8>/' empty.pov > all.pov
	render "$ours" all.exr all.pov +UA
	grep 'Pixels in Focus' all.exr.log
	grep -q 'empty 100.00%' all.exr.log || fail "not all of the picture is empty"
	[ "$("$compare" empty all.exr)" = "100.00 0.00" ] || fail "alpha is not 0 everywhere"
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
