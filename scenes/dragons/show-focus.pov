// The preview of (b): in colour where the blur is below a pixel, contours of its width elsewhere. One ray a pixel.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "dragons.inc"

camera {
	tilt_lens {
		focal_points Head[Near], Head[Middle], Head[Far]
		aperture_diameter Aperture
		show focus
	}
	location Eye
	right 16/9*x
	angle View_Angle
	look_at Aim
}
