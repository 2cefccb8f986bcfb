#!/bin/sh
# Options and ways of writing scenes that concern every camera (common.sh).
. "$(dirname "$0")/common.sh"

# scene NAME CAMERA [BEFORE]: the oracle's scene.
scene() {
	printf '%s\n' '#include "oracle-scene.inc"' "$3" "$2" > "$1.pov"
}
pinhole='tilt_lens { focal_plane_tilt 60 focal_distance 8 }'
blur='blur_samples 32 variance 0'

case $case in
antialiasing)
	# Without blur: stock's anti-aliasing, ray for ray.
	scene stock "camera { perspective $view }"
	scene ours "camera { $pinhole $view }"
	render "$ours" jagged.ppm ours.pov
	for how in "+A0.1 +AM1 +R3 -J" "+A0.05 +AM2 +R2 -J" "+A0.1 +AM2 +R2 +J"; do
		render "$stock" stock.ppm stock.pov $how
		render "$ours" ours.ppm ours.pov $how
		check "$how" "$compare" same stock.ppm ours.ppm
		check "$how does something" "$compare" differ 0.01 jagged.ppm ours.ppm
	done
	;;
antialiasing_blur)
	# With blur: said once, and not done.
	scene ours "camera { $tilted $view $blur }"
	render "$ours" plain.ppm ours.pov
	grep -q 'anti-alias' plain.ppm.log && fail "warns without +A"
	for how in "+A0.1 +AM1 +R3" "+A0.05 +AM2 +R2"; do
		render "$ours" with.ppm ours.pov $how +WT2
		check "$how" "$compare" same plain.ppm with.ppm
		warnings=$(tr -s '\n ' ' ' < with.ppm.log | grep -o 'anti-alias already' | wc -l)
		[ "$warnings" -eq 1 ] || fail "$how: $warnings warnings, one expected"
		same_rays=$(cat plain.ppm.log with.ppm.log | grep '^Rays:' | sort -u | wc -l)
		[ "$same_rays" -eq 1 ] || fail "$how costs more rays"
	done
	;;
mosaic)
	# The preview in coarse blocks first leaves the picture as it is; a pinhole's, too.
	scene blurred "camera { $tilted $view blur_samples 16, 64 variance 1/4000 confidence 0.9 }"
	scene sharp "camera { $pinhole $view }"
	for name in blurred sharp; do
		render "$ours" plain.ppm $name.pov
		for how in "+SP16 +EP1" "+SP16 +EP4" "+SP8 +EP2"; do
			render "$ours" mosaic.ppm $name.pov $how +WT2
			grep -q 'Mosaic preview.......On' mosaic.ppm.log || fail "$how is no mosaic preview"
			check "$name, $how" "$compare" same plain.ppm mosaic.ppm
		done
	done
	;;
declared)
	# A declared camera, taken over and moved, is the camera written out; so it is in stock.
	of="aperture 0.8 focal_point <0, 1.4210526315789473, 4.5>"
	move='rotate y * 8 translate <0.4, 0.2, -0.3>'
	scene other "camera { Other $move }" "#declare Other = camera { tilt_lens { focal_plane_tilt 40 tilt_direction 70 } $view $of $blur }"
	scene whole "camera { tilt_lens { focal_plane_tilt 40 tilt_direction 70 } $view $of $blur $move }"
	render "$ours" other.ppm other.pov
	render "$ours" whole.ppm whole.pov
	check "written out" "$compare" same whole.ppm other.ppm
	# Pinholes and upright planes agree with stock's.
	scene stock "camera { Other $move }" "#declare Other = camera { perspective $view }"
	scene ours "camera { Other $move }" "#declare Other = camera { $pinhole $view }"
	render "$stock" stock.ppm stock.pov
	render "$ours" ours.ppm ours.pov
	check "pinhole" "$compare" same stock.ppm ours.ppm
	scene stock "camera { Other $move }" "#declare Other = camera { perspective $view $of blur_samples 256 variance 0 }"
	scene ours "camera { Other $move }" "#declare Other = camera { tilt_lens { } $view $of blur_samples 256 variance 0 }"
	render "$stock" stock.exr stock.pov
	render "$ours" ours.exr ours.pov
	check "focal_point moves along" "$compare" rms 0.006 stock.exr ours.exr # as in render.peer.aperture
	# Points in the block are the world's: moving the camera leaves the plane where it is. Once more by hand, with
	# a distance that follows from the move: the floor stays the floor.
	scene other "camera { Other translate <0, 0.5, 0> }" "#declare Other = camera { tilt_lens { focal_plane <1, 0, 2>, y aperture_diameter 0.4 } location <0, 2.6, -3.5> right x * 4 / 3 up y direction z * 1.5 look_at <0, 2.6, 6> $blur }"
	scene whole "camera { tilt_lens { focal_plane <-7, 0, 5>, -2 * y aperture_diameter 0.4 } location <0, 3.1, -3.5> right x * 4 / 3 up y direction z * 1.5 look_at <0, 3.1, 6> $blur }"
	render "$ours" other.exr other.pov
	render "$ours" whole.exr whole.pov
	# The same lens to rounding, which may turn single samples at edges.
	check "the plane stays in the world" "$compare" rms 0.0005 whole.exr other.exr
	# Declared where that plane passes through the lens: it is moved before it takes a picture. Where it is not, that is refused.
	sed 's/location <0, 2.6, -3.5>/location <0, 0, -3.5>/; s/look_at <0, 2.6, 6>/look_at <0, 0, 6>/; s/translate <0, 0.5, 0>/translate <0, 3.1, 0>/' other.pov > at-floor.pov
	render "$ours" other.exr at-floor.pov
	check "declared on its plane" "$compare" rms 0.0005 whole.exr other.exr
	sed 's/translate <0, 3.1, 0>//' at-floor.pov > stays.pov
	povray_to "$ours" stays.exr stays.pov && fail "a lens on its plane of focus is no error"
	grep -q 'passes through the lens centre' stays.exr.log || fail "no word of the lens centre"
	# The default camera's lens is no second block of the next.
	scene default "camera { tilt_lens { focal_plane_tilt 40 tilt_direction 70 } $view $of $blur $move }" "#default { camera { tilt_lens { lens_tilt 5 } } }"
	render "$ours" default.ppm default.pov
	check "after a default" "$compare" same other.ppm default.ppm
	;;
restated)
	# A declared camera with another lens: what stands around the block is kept, the block is the new one alone.
	# restated NAME OF BEFORE AFTER [MOVE] [WHOLE]: declared as `tilt_lens { BEFORE } ... OF`, taken over with tilt_lens { AFTER }, is as if
	# written so at once; WHOLE is OF without what AFTER overrides.
	restated() {
		scene other "camera { Other tilt_lens { $4 } $5 }" "#declare Other = camera { tilt_lens { $3 } $2 $view $blur }"
		scene whole "camera { tilt_lens { $4 } ${6-$2} $view $blur $5 }"
		scene before "camera { Other $5 }" "#declare Other = camera { tilt_lens { $3 } $2 $view $blur }"
		render "$ours" other.ppm other.pov +A0.1
		render "$ours" whole.ppm whole.pov +A0.1
		render "$ours" before.ppm before.pov +A0.1
		check "$1" "$compare" same whole.ppm other.ppm
		check "$1 is seen" "$compare" differ 0.002 before.ppm other.ppm
	}
	move='rotate y * 8 translate <0.4, 0.2, -0.3>'
	restated "plane and aperture" "" "focal_plane_tilt 60 focal_distance 8 aperture_diameter 0.4" "lens_tilt -10 focal_distance 6 aperture_diameter 0.2" "$move"
	restated "effects go" "" "focal_distance 8 aperture_diameter 0.4 distortion -0.2 vignetting natural shift <0.1, 0.1> blades 5 denoise seed 3" "focal_distance 8 aperture_diameter 0.4"
	restated "effects come" "" "focal_distance 8 aperture_diameter 0.4" "focal_distance 8 aperture_diameter 0.4 vignetting natural blades 5 denoise seed 3"
	restated "aperture and focal_point stay" "aperture 0.8 focal_point <0, 1.4, 4.5>" "" "focal_plane_tilt 40" "$move"
	restated "aperture and focal_point yield" "aperture 0.8 focal_point <0, 1.4, 4.5>" "focal_plane_tilt 20" "focal_plane <0, 0, 0>, y aperture_diameter 0.2" "$move" ""
	restated "to a pinhole" "" "focal_distance 8 aperture_diameter 0.4" ""
	restated "a preview" "" "focal_distance 8 aperture_diameter 0.4" "focal_distance 8 aperture_diameter 0.4 show focus"
	# angle stays, and with it what focal_length means; a bokeh outside the block stays too.
	view="angle 50 $view bokeh { pigment { gradient x color_map { [0.5 rgb <1, 0.2, 0.1>] [0.5 rgb <0.2, 1, 0.1>] } } }"
	restated "angle and bokeh stay" "" "focal_distance 8 aperture_diameter 0.4" "focal_distance 8 focal_length 1 f_stop 3"
	# Between its transformations, and declared once more.
	scene other "camera { Third translate <0.4, 0.2, -0.3> }" "#declare Other = camera { tilt_lens { focal_distance 8 aperture_diameter 0.4 } $view $blur }
		#declare Third = camera { Other rotate y * 8 tilt_lens { focal_distance 5 aperture_diameter 0.3 } }"
	scene whole "camera { tilt_lens { focal_distance 5 aperture_diameter 0.3 } $view $blur $move }"
	render "$ours" other.ppm other.pov
	render "$ours" whole.ppm whole.pov
	check "declared once more" "$compare" same whole.ppm other.ppm
	# Refused: a camera without a lens, and two lenses.
	scene other "camera { Other tilt_lens { } }" "#declare Other = camera { perspective $view }"
	povray_to "$ours" other.ppm other.pov && fail "a lens is put on a perspective camera"
	tr -s '\n ' ' ' < other.ppm.log | grep -q "The declared camera is no tilt_lens camera, and has no lens" || fail "no word about the perspective camera: $(grep -A3 Error other.ppm.log)"
	scene other "camera { Other tilt_lens { focal_distance 5 } tilt_lens { } }" "#declare Other = camera { tilt_lens { } $view }"
	povray_to "$ours" other.ppm other.pov && fail "two lenses are accepted"
	grep -q "only one tilt_lens block" other.ppm.log || fail "no word about the second lens: $(grep -A3 Error other.ppm.log)"
	;;
macro)
	# A macro that writes the camera, and one that writes the block.
	scene ours "camera { tilt_lens { lens_tilt 5 tilt_direction 20 focal_distance 8 f_stop 2 } $view $blur }"
	scene macro "View_Camera(5, 8)" "#macro Lens(Tilt, Distance) lens_tilt Tilt tilt_direction 20 #local U = Distance; focal_distance U f_stop 2 #end
		#macro View_Camera(Tilt, Distance) camera { tilt_lens { Lens(Tilt, Distance) } $view $blur } #end"
	render "$ours" ours.ppm ours.pov
	render "$ours" macro.ppm macro.pov
	check "macro" "$compare" same ours.ppm macro.ppm
	# In a file of its own, with #version and in a branch.
	printf '%s\n' '#version 3.7;' '#if (frame_number = 0)' "camera { tilt_lens { lens_tilt 5 tilt_direction 20 focal_distance 8 f_stop 2 } $view $blur }" '#end' > camera.inc
	scene include '#include "camera.inc"'
	render "$ours" include.ppm include.pov
	check "include" "$compare" same ours.ppm include.ppm
	;;
clock)
	scene clock "camera { tilt_lens { focal_plane_tilt 60 * clock tilt_direction 30 focal_distance 8 aperture_diameter 0.4 } $view $blur }"
	scene still "camera { $tilted $view $blur }"
	scene untilted "camera { tilt_lens { focal_distance 8 aperture_diameter 0.4 } $view $blur }"
	render "$ours" frame.ppm clock.pov +KFI1 +KFF3
	render "$ours" still.ppm still.pov
	render "$ours" untilted.ppm untilted.pov
	check "first frame" "$compare" same untilted.ppm frame1.ppm
	check "last frame" "$compare" same still.ppm frame3.ppm
	check "the tilt is seen" "$compare" differ 0.01 frame1.ppm frame3.ppm
	;;
identifiers)
	# The words of the block are names like any other to the scene, before it, after it, and inside as values.
	scene words "#declare P = <0, 1, 9>; camera { tilt_lens { focal_plane_tilt Tilt * 2 tilt_direction Turn shift <Offset, Offset> focal_distance Distance * 2 image_distance 1.5 aperture_diameter 0.4 } $view $blur }
		sphere { <-0.6, 1.2, 1.5>, 0.4 pigment { rgb <0.7, 0.2, 0.5> } }" \
		"#declare Tilt = 30; #declare Turn = 30; #declare Offset = 0.02; #declare Distance = 4;"
	scene names "#declare P = <0, 1, 9>; camera { tilt_lens { focal_plane_tilt lens_tilt * 2 tilt_direction tilt_direction shift <shift, shift> focal_distance focal_length * 2 image_distance image_distance aperture_diameter aperture_diameter } $view $blur }
		#declare focal_points = array[1] { <-0.6, 1.2, 1.5> } #declare focal_plane = 0.4; #declare show = pigment { rgb <0.7, 0.2, 0.5> }
		#macro f_stop(focus, distortion) sphere { focus, distortion pigment { show } } #end
		f_stop(focal_points[0], focal_plane)" \
		"#declare lens_tilt = 30; #declare tilt_direction = 30; #declare shift = 0.02; #declare focal_length = 4;
		#declare image_distance = 1.5; #declare aperture_diameter = 0.4; #declare focal_distance = 3; #declare focal_plane_tilt = <1, 2, 3>;"
	render "$ours" words.ppm words.pov
	render "$ours" names.ppm names.pov
	check "names" "$compare" same words.ppm names.ppm
	# Stock takes the same names.
	sed 's/tilt_lens { .* } location/perspective location/' names.pov > stock.pov
	render "$stock" stock.ppm stock.pov
	render "$ours" ours.ppm stock.pov
	check "names without tilt_lens" "$compare" same stock.ppm ours.ppm
	# Of another kind than the word's value: an array, a macro's name, a pigment.
	scene kinds "camera { tilt_lens { focal_plane <1, 0, 2>, y aperture_diameter 0.4 } $view $blur }" \
		"#declare focal_plane = pigment { rgb 1 }; #declare aperture_diameter = array[2] { 1, 2 };"
	scene plain "camera { tilt_lens { focal_plane <1, 0, 2>, y aperture_diameter 0.4 } $view $blur }"
	render "$ours" kinds.ppm kinds.pov
	render "$ours" plain.ppm plain.pov
	check "names of pigments and arrays" "$compare" same plain.ppm kinds.ppm
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
