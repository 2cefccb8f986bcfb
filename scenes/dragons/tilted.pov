// (b) The same aperture, and one plane of focus through the three heads: all are sharp.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "dragons.inc"

camera {
	tilt_lens {
		focal_points Head[Near], Head[Middle], Head[Far]
		aperture_diameter Aperture
		#if (Denoise) denoise #end
	}
	location Eye
	right 16/9*x
	angle View_Angle
	look_at Aim
	blur_samples 8, 32
	variance 0.0003
}
