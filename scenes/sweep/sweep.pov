// The plane of focus turns like a door about an upright hinge beside the lens: from across the view, along the row of
// pawns before the hinge (then it is parallel to the axis: no focal distance), to behind the lens. clock 0 .. 1.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "field.inc"

#declare Door = 62 + 66*clock;                 // degrees from the lens's own plane; 90 is parallel to the axis
#declare Hinge = <Row_X, 1.9, 0>;

camera {
	tilt_lens {
		focal_plane Hinge, <sin(radians(Door)), 0, -cos(radians(Door))>
		aperture_diameter 0.3
		shift <0, -0.30>
		seed frame_number
		denoise
	}
	location <0, 1.9, 0>
	direction 1.45*z
	right 16/9*x
	up y
	look_at <0, 1.9, 1>
	blur_samples 16, 64
	variance 0.0002
}
