// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Tilted floor
// Shows: a tiled floor with a model railway; the tilted plane of focus lies in the floor
// Tilted: yes
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 2.2, -4.5>;
#declare Race_Look_At = <0, 0.3, 1.2>;
#declare Race_Angle = 44;
#declare Race_Aperture = 0.4;
#declare Race_Focal_Distance = 5.6;
#declare Race_Plane_Point = <0, 0.02, 0>;
#declare Race_Plane_Normal = <0, 1, 0>;
#include "race_camera.inc"
light_source { <-9, 14, -8> rgb 0.95 }
#declare F = finish { ambient <0.13, 0.14, 0.17> diffuse 0.75 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.75, 0.78, 0.8>] [0.5 rgb <0.4, 0.5, 0.65>] } } }
plane { y, 0 pigment { checker rgb <0.72, 0.68, 0.6>, rgb <0.35, 0.4, 0.42> scale 0.75 } finish { F } }
// Rails on sleepers.
#for (I, -4, 30)
	box { <-0.45, 0, -0.07>, <0.45, 0.05, 0.07> translate z * I * 0.4 rotate y * 12 pigment { rgb <0.3, 0.2, 0.13> } finish { F } }
#end
#for (I, -1, 1, 2)
	box { <0.27 * I - 0.02, 0.05, -2>, <0.27 * I + 0.02, 0.1, 12> rotate y * 12 pigment { rgb <0.55, 0.5, 0.5> } finish { F } }
#end
// The engine and wagons.
#declare Wagon = union {
	box { <-0.32, 0.2, -0.55>, <0.32, 0.7, 0.55> }
	cylinder { <0, 0.55, -0.55>, <0, 0.55, 0.55>, 0.33 }
	#for (J, -1, 1, 2) #for (I, -1, 1, 2) cylinder { <0.3 * I - 0.03, 0.2, 0.32 * J>, <0.3 * I + 0.03, 0.2, 0.32 * J>, 0.11 pigment { rgb 0.1 } finish { F } } #end #end
	finish { F }
}
#for (I, 0, 4)
	object { Wagon translate z * (0.6 + 1.3 * I) rotate y * 12 pigment { rgb #if (mod(I, 3) = 0) <0.7, 0.15, 0.1> #else #if (mod(I, 3) = 1) <0.15, 0.35, 0.25> #else <0.8, 0.65, 0.2> #end #end } }
#end
// Houses and trees.
#declare R = seed(21);
#for (I, 0, 9)
	#local P = <-2.4 - 1.5 * rand(R) + 5.4 * mod(I, 2), 0, -1 + 1.4 * I>;
	#if (mod(I, 3))
		cone { P + y * 0.2, 0.45, P + y * (1.3 + 0.5 * rand(R)), 0 pigment { bozo color_map { [0 rgb <0.08, 0.2, 0.1>] [1 rgb <0.25, 0.42, 0.18>] } scale 0.1 } finish { F } }
		cylinder { P, P + y * 0.25, 0.08 pigment { rgb <0.3, 0.2, 0.1> } finish { F } }
	#else
		box { P - <0.5, 0, 0.5>, P + <0.5, 0.8, 0.5> pigment { brick rgb 0.75, rgb <0.55, 0.25, 0.18> brick_size <0.2, 0.08, 0.2> mortar 0.015 } finish { F } }
		cone { P + y * 0.8, 0.8, P + y * 1.3, 0 pigment { rgb <0.3, 0.22, 0.22> } finish { F } }
	#end
#end
