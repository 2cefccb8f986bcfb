// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Foliage against the sky
// Shows: the worst case we know: hundreds of small leaves, all out of focus, black against bright; every pixel is an edge
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1.5, -5>;
#declare Race_Look_At = <0, 2, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.35;
#declare Race_Focal_Distance = 5.5;
#include "race_camera.inc"
light_source { <-10, 20, 15> rgb 0.8 }
#declare F = finish { ambient 0.1 diffuse 0.6 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.95, 0.9, 0.8>] [0.6 rgb <0.55, 0.7, 0.95>] } } }
plane { y, 0 pigment { bozo color_map { [0 rgb <0.1, 0.14, 0.05>] [1 rgb <0.3, 0.3, 0.12>] } scale 0.2 } finish { F } }
#declare R = seed(17);
#for (I, 0, 899)
	#local P = <-3.4 + 6.8 * rand(R), 0.4 + 4 * rand(R), -2.6 + 7 * rand(R)>;
	disc { 0, <rand(R) - 0.5, rand(R) - 0.5, rand(R) - 0.5> + 0.001, 0.06 + 0.05 * rand(R) translate P
		pigment { rgb <0.05 + 0.25 * rand(R), 0.1 + 0.3 * rand(R), 0.03> } finish { F } }
#end
#for (I, 0, 11)
	#local P = <-3 + 6 * rand(R), 0, -1.5 + 5 * rand(R)>;
	cone { P, 0.07, P + <rand(R) - 0.5, 4.5, rand(R) - 0.5>, 0.02 pigment { rgb <0.15, 0.1, 0.07> } finish { F } }
#end
