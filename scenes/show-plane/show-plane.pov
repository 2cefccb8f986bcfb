// The plane of focus as a sheet of coloured glass, and its trace where it cuts the
// scene, as a line. One ray per pixel.
//
//   povray show-plane.pov +L../first-tilt +W960 +H540 +Oshow-plane.png
#version 3.7;
global_settings { assumed_gamma 1 }
#include "balls.inc"

camera {
	tilt_lens {
		focal_points <-3, 0.6, -4>, <3, 0.6, 11>, <0, 2, 3.5>
		aperture_diameter 0.1
		show plane
	}
	location <0, 2, -8>
	look_at <0, 1, 0>
	angle 50
	right 16/9*x
}
