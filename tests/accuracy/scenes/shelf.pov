// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Tilted shelf
// Shows: a wall of books that recedes to the right; the tilted plane of focus lies along their spines
// Tilted: yes
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <-0.6, 1.5, -3>;
#declare Race_Look_At = <0.9, 1.2, 0>;
#declare Race_Angle = 50;
#declare Race_Aperture = 0.3;
#declare Race_Focal_Distance = 2.9;
#declare Race_Plane_Point = <0, 1, -0.5>;
#declare Race_Plane_Normal = <0.62, 0, -0.78>;
#include "race_camera.inc"
light_source { <-4, 6, -7> rgb <0.9, 0.85, 0.75> }
#declare F = finish { ambient 0.12 diffuse 0.75 }
background { rgb 0.25 }
plane { y, -0.2 pigment { wood color_map { [0 rgb <0.5, 0.35, 0.2>] [1 rgb <0.35, 0.22, 0.12>] } scale 0.2 rotate y * 90 } finish { F } }
#declare R = seed(31);
union {
	#for (S, 0, 3)
		box { <-1.5, 0.75 * S - 0.06, 0>, <7, 0.75 * S, 0.5> pigment { rgb <0.4, 0.27, 0.16> } finish { F } }
		#local X = -1.4;
		#while (X < 6.8)
			#local W = 0.05 + 0.1 * rand(R);
			#local H = 0.4 + 0.25 * rand(R);
			#local C = <rand(R), rand(R), rand(R)> * 0.6 + 0.15;
			box { <X, 0.75 * S, 0.02 + 0.08 * rand(R)>, <X + W, 0.75 * S + H, 0.45>
				pigment { gradient y color_map { [0.15 rgb C] [0.15 rgb C * 0.4 + 0.5] [0.3 rgb C * 0.4 + 0.5] [0.3 rgb C] } scale 0.35 translate y * 0.75 * S } finish { F } }
			#local X = X + W + 0.01;
		#end
	#end
	box { <-1.6, -0.2, 0.45>, <7, 3, 0.5> pigment { rgb <0.3, 0.2, 0.12> } finish { F } }
	rotate y * -38.5 translate <0, 0, -0.5>
}
// A lamp and a chair back nearer than the plane.
cylinder { <1.5, 0, -1.2>, <1.5, 1.5, -1.2>, 0.03 pigment { rgb 0.15 } finish { F } }
cone { <1.5, 1.4, -1.2>, 0.3, <1.5, 1.8, -1.2>, 0.15 pigment { rgb <0.85, 0.8, 0.65> } finish { F ambient 0.5 } }
#for (I, 0, 3) box { <0.1 + 0.18 * I, 0, -1.75>, <0.2 + 0.18 * I, 0.85, -1.72> pigment { rgb <0.6, 0.4, 0.2> } finish { F } } #end
box { <0.08, 0.8, -1.76>, <0.76, 0.92, -1.71> pigment { rgb <0.6, 0.4, 0.2> } finish { F } }
