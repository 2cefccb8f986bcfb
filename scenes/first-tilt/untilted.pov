// The same scene and aperture without tilt: one ball is sharp.
//
//   povray untilted.pov +W960 +H540 +Ountilted.png
#version 3.7;
global_settings { assumed_gamma 1 }
#include "balls.inc"

camera {
	tilt_lens { aperture_diameter 0.5 }
	location <0, 2, -8>
	look_at <0, 1, 0>
	angle 50
	right 16/9*x
	focal_point <-1, 0.6, 1>
	blur_samples 16, 256
	variance 0.00002
}
