// (c) The same aperture, and a plane of focus so oblique that it runs away from the rays of the picture's left: their focus
// is nowhere, or behind the lens, and what they see is blurred strongly.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "dragons.inc"

camera {
	tilt_lens {
		focal_plane Oblique_Plane[0], Oblique_Plane[1]
		aperture_diameter Aperture
		#if (Denoise) denoise #end
	}
	location Eye
	right 16/9*x
	angle View_Angle
	look_at Aim
	blur_samples 16, 64   // wide blur needs more
	variance 0.0003
}
