// The same place and aperture with an ordinary camera: it is pitched to see the tins, so upright edges converge, and its
// plane of focus cuts the row at one tin.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "tins.inc"

camera {
	tilt_lens {
		aperture_diameter 3.2
		denoise
	}
	location <-1.5, 30, -62>
	direction 2*z
	right 16/9*0.86*x
	up 0.86*y
	look_at <-1.5, 8.6, 0>
	focal_point Row_Start + vrotate(15*x, Row_Angle*y) + 7*y
	blur_samples 8, 32
	variance 0.0002
}
