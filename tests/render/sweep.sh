#!/bin/sh
# An animation in which the plane of focus goes from in front of the lens through infinity to behind it, in equal
# steps of the inverse focus vector q (common.sh).
#
# q is what moves the lens rays: by -S dq.v for a step dq, whatever q is. So the step from picture to picture changes
# more than the scene's details do that the blur meets: at 256 samples, the same ones in every frame, neighbouring steps
# differ by up to 5 %, and a tenth is the limit. A frame whose plane is missed or a seam at kappa = 0 is a step of
# several times the size: the last check has one.
. "$(dirname "$0")/common.sh"

case $case in
	# 1/U from 0.2 to -0.2, where all of the picture changes from case (5) to case (6) at once, between frames 12 and 13.
	infinity) plane='focal_distance 1 / (0.2 - 0.4 * clock) focal_plane_tilt 0' ;;
	# The plane turns about the line <-8, y, 0> beside the lens: kappa = 0 wanders over the picture from the left to
	# the right. q = (-1/8, 0, 0.12 - 0.24 clock), N along q, P = q/|q|^2.
	turn)
		plane='focal_plane <0, 2.6, -3.5> + Q / vdot(Q, Q), Q'
		;;
	*) fail "no case '$case'"; finish ;;
esac

cat > sweep.pov <<EOF
#include "oracle-scene.inc"
#declare Q = <-1/8, 0, 0.12 - 0.24 * clock>;
camera {
	tilt_lens { $plane image_distance 1.5 aperture_diameter 0.4 }
	location <0, 2.6, -3.5> right x * 4 / 3 up y look_at <0, 2.6, 6>
	blur_samples 256 variance 0
}
EOF
frames=24
render "$ours" frame.exr sweep.pov +W96 +H72 +KFI1 +KFF$frames
check "$frames frames" "$compare" series 1.1 frame*.exr
grep 'Pixels in Focus' frame.exr.log | sed -n "1p;$((frames / 2))p;\$p"

# The test can fail: a frame of which the plane is on the other side.
middle=$((frames / 2))
mkdir broken
cp frame*.exr broken
cp frame$(printf %02d $((frames - middle / 2))).exr broken/frame$middle.exr
"$compare" series 1.1 broken/frame*.exr > /dev/null && fail "a wrong frame goes unnoticed"
finish
