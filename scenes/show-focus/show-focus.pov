// Placing a plane of focus without paying for blur: one ray per pixel. In colour
// where the blur is under one pixel; contours at 2, 4, 8, ... pixels with their
// numbers, blue nearer than the plane of focus, orange beyond it. Pixels are those
// of the final picture, 1920 wide.
//
//   povray show-focus.pov +L../first-tilt +W960 +H540 +Oshow-focus.png
#version 3.7;
global_settings { assumed_gamma 1 }
#include "balls.inc"

camera {
	tilt_lens {
		focal_points <-3, 0.6, -4>, <3, 0.6, 11>, <0, 2, 3.5>
		aperture_diameter 0.05
		show focus 1920
	}
	location <0, 2, -8>
	look_at <0, 1, 0>
	angle 50
	right 16/9*x
}
