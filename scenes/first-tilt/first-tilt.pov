// A first tilted picture: seven balls in a row, sharp from the first to the last.
//
//   povray first-tilt.pov +W960 +H540 +Ofirst-tilt.png
#version 3.7;
global_settings { assumed_gamma 1 }
#include "balls.inc"

camera {
	tilt_lens {
		focal_points <-3, 0.6, -4>, <3, 0.6, 11>, <0, 2, 3.5>   // where it shall be sharp
		aperture_diameter 0.5
	}
	location <0, 2, -8>
	look_at <0, 1, 0>
	angle 50
	right 16/9*x
	blur_samples 16, 256
	variance 0.00002
}
