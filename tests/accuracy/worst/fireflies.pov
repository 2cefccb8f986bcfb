// SPDX-License-Identifier: AGPL-3.0-or-later
// Bright specks on a flat wall that runs from near the focus to far from it: points, and discs of many sizes; glints on rough metal.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1, -6>;
#declare Race_Look_At = <0, 1, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.5;
#declare Race_Focal_Distance = 6;
#include "race_camera.inc"
light_source { <-2, 6, -7> rgb 0.8 }
plane { <0.6, 0, 1>, 0 pigment { rgb 0.4 } finish { ambient 1 diffuse 0 } }
#declare R = seed(12);
#for (I, 0, 219)
	#local X = -3.4 + 7.2 * rand(R);
	sphere { <X, -0.6 + 3.2 * rand(R), -0.6 * X - 0.03>, 0.006 + 0.02 * rand(R)
		pigment { rgb 1 } finish { ambient (I < 160 ? 8 : 20 + 30 * rand(R)) diffuse 0 } }
#end
box { <-1, -0.4, -1.2>, <1, -0.1, -0.6> pigment { rgb 0.3 } finish { ambient 0.1 diffuse 0.3 specular 8 roughness 0.0006 metallic } normal { granite 0.5 scale 0.05 } }
