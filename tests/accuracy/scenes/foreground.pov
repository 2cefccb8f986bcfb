// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Large foreground blur
// Shows: a sharp meadow gate seen past grass and a fence post close to the lens
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1.2, -6>;
#declare Race_Look_At = <0, 1.1, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.3;
#declare Race_Focal_Distance = 6;
#include "race_camera.inc"
light_source { <-30, 40, -25> rgb <1, 0.95, 0.85> }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.8, 0.82, 0.8>] [0.4 rgb <0.35, 0.5, 0.75>] } } }
#declare F = finish { ambient <0.13, 0.15, 0.19> diffuse 0.75 }
plane { y, 0 pigment { bozo color_map { [0 rgb <0.2, 0.32, 0.1>] [1 rgb <0.45, 0.5, 0.2>] } scale 0.25 } finish { F } }
// The gate.
#for (I, 0, 4)
	box { <-1.7, 0.3 + 0.3 * I, -0.04>, <1.7, 0.42 + 0.3 * I, 0.04> pigment { rgb <0.75, 0.7, 0.6> } finish { F } }
#end
box { <-1.9, 0, -0.1>, <-1.65, 1.9, 0.1> pigment { rgb <0.4, 0.28, 0.18> } finish { F } }
box { <1.65, 0, -0.1>, <1.9, 1.9, 0.1> pigment { rgb <0.4, 0.28, 0.18> } finish { F } }
box { <-1.65, -0.06, -0.05>, <2.1, 0.06, 0.05> rotate z * 20 translate y * 0.98 pigment { rgb <0.7, 0.64, 0.55> } finish { F } }
// Trees behind.
#declare R = seed(11);
#for (I, 0, 13)
	#local P = <-9 + 1.5 * I + rand(R), 0, 8 + 5 * rand(R)>;
	cylinder { P, P + y * 2, 0.15 pigment { rgb <0.3, 0.2, 0.12> } finish { F } }
	sphere { P + y * 2.4, 1 + 0.5 * rand(R) scale <1, 1.1, 1> pigment { bozo color_map { [0 rgb <0.08, 0.2, 0.06>] [1 rgb <0.3, 0.45, 0.12>] } scale 0.3 } finish { F } }
#end
// Grass and a post near the lens.
#for (I, 0, 27)
	#local P = <-1.4 + 2.8 * rand(R), 0.2, -4.6 + 1.6 * rand(R)>;
	#local L = 0.5 + 0.75 * rand(R);
	cone { P, 0.05, P + <0.5 * rand(R) - 0.25, L, 0.2 * rand(R)>, 0 pigment { rgb <0.35 + 0.4 * rand(R), 0.55, 0.15> } finish { F } }
#end
cylinder { <0.62, 0, -4.4>, <0.7, 2.2, -4.4>, 0.08 pigment { bozo color_map { [0 rgb <0.35, 0.25, 0.17>] [1 rgb <0.6, 0.5, 0.4>] } scale <0.03, 0.3, 0.03> } finish { F } }
sphere { <-0.45, 1.15, -4.5>, 0.16 pigment { rgb <0.9, 0.25, 0.15> } finish { F } }
cylinder { <-0.42, 0.2, -4.5>, <-0.45, 1.2, -4.5>, 0.015 pigment { rgb <0.3, 0.5, 0.15> } finish { F } }
