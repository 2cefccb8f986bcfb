// The same aperture without tilt, focused on the path at seven metres.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "meadow.inc"

camera {
	tilt_lens {
		aperture_diameter 0.15
		shift <0, -0.16>         // the camera stays level, the picture slides down: trunks stay upright
		denoise
	}
	location <0, 1.55, 0>
	direction z
	right 1.28*x
	up 0.72*y
	look_at <0, 1.55, 10>
	focal_point <0, 1.0, 7>
	blur_samples 8, 32
	variance 0.0003
}
