// (a) No tilt: the plane of focus stands upright through the middle dragon's head. Near and far are blurred.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "dragons.inc"

camera {
	tilt_lens {
		aperture_diameter Aperture
		#if (Denoise) denoise #end
	}
	location Eye
	right 16/9*x
	angle View_Angle
	look_at Aim
	focal_point Head[Middle]
	blur_samples 8, 32
	variance 0.0003
}
