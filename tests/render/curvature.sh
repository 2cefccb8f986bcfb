#!/bin/sh
# field_curvature against stock POV-Ray (common.sh).
#
# The oracle is stock's mesh_camera, which sends rays from the centres of triangles along their normals: curvature.inc
# places one small triangle per pixel and lens sample. Its scene language works the rays out from the definition, a
# focus point on the bowl for every pixel (the paper's P_f - S), and shares no code and no formula with the camera.
. "$(dirname "$0")/common.sh"

# Without the first row, whose pixels have no triangles: stock's viewing window lies one row lower than the picture.
size="+W40 +H30 +SR2 +ER30"
# 160 lens samples: 192,000 triangles. Of another 160 the picture of the bowl differs by 0.0034 RMS, so that its own error is 0.0024.
oracle() {
	printf '%s\n' "$2" '#include "curvature.inc"' > "$1.pov"
	render "$stock" "$1.exr" "$1.pov" $size
}
camera() {
	printf '%s\n' '#include "curvature-scene.inc"' "camera { tilt_lens { image_distance 1.5 aperture_diameter 0.6 $2 } location <0, 2.6, -3.5>
		right x * 4 / 3 up y blur_samples 4096 variance 0 }" > "$1.pov"
	render "$ours" "$1.exr" "$1.pov" $size
}

case $case in
untilted)
	words='focal_distance 5'
	oracle truth '#declare Tilt = 0; #declare Direction = 0; #declare U = 5; #declare C = 0.9;'
	camera bowl "$words field_curvature 0.9"
	camera plane "$words"
	camera zero "$words field_curvature 0"
	check "0 is none" "$compare" same plane.exr zero.exr
	;;
tilted)
	# The plane of focus rises 45 degrees towards the upper right; the bowl bends away from the lens.
	words='focal_plane_tilt 45 tilt_direction 30 focal_distance 5'
	oracle truth '#declare Tilt = 45; #declare Direction = 30; #declare U = 5; #declare C = -0.6;'
	camera bowl "$words field_curvature -0.6"
	camera plane "$words"
	# With distortion it goes through another instance of the tracer.
	camera bowl_distortion "$words field_curvature -0.6 distortion 1e-9"
	check "no distortion to speak of" "$compare" rms 1e-4 bowl.exr bowl_distortion.exr
	;;
*)
	fail "no case '$case'"
	;;
esac
# Leaving the bowl out costs more than ten times what is left of it: twice the oracle's own error at most.
check "is not the plane" "$compare" differ 0.06 truth.exr plane.exr
check "the bowl" "$compare" rms 0.005 truth.exr bowl.exr
finish
