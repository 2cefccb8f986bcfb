// SPDX-License-Identifier: AGPL-3.0-or-later
// Squares of a pixel of 128 x 80: a wall across the view on which they run out of step with the pixels, and a floor on which they shrink.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1, -6>;
#declare Race_Look_At = <0, 1, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.25;
#declare Race_Focal_Distance = 6;
#include "race_camera.inc"
light_source { <-5, 9, -9> rgb 0.9 }
#declare F = finish { ambient 0.3 diffuse 0.6 }
#declare Pixel = 2 * 6 * tan(radians(20)) / 128;
plane { z, 0 pigment { checker rgb 0.9 rgb 0.1 scale Pixel * 1.03 rotate z * 2 } finish { F } clipped_by { plane { x, 0 } } }
plane { z, 0 pigment { cells color_map { [0.5 rgb <0.9, 0.3, 0.1>] [0.5 rgb <0.1, 0.3, 0.6>] } scale Pixel } finish { F } clipped_by { plane { -x, 0 } } }
plane { y, 0.1 pigment { checker rgb 0.85 rgb 0.2 scale 2 * Pixel } finish { F } }
