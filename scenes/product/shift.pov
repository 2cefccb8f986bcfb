// Shift and tilt: the camera stays level and its lens slides down, so upright edges stay upright; the plane of focus lies
// along the fronts of the tins, so every label can be read.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "tins.inc"

camera {
	tilt_lens {
		focal_points Front_A, Front_B, Front_C
		shift <0, -0.725>
		aperture_diameter 3.2
		denoise
	}
	location <-1.5, 30, -62>
	direction 2*z
	right 16/9*0.86*x
	up 0.86*y
	look_at <-1.5, 30, 0>
	blur_samples 8, 32
	variance 0.0002
}
