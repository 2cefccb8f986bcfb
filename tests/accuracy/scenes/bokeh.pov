// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Bokeh highlights
// Shows: a glass on a bar in front of a street at night, whose lamps are small, bright and far out of focus
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1.4, -3.2>;
#declare Race_Look_At = <0, 1.3, 0>;
#declare Race_Angle = 38;
#declare Race_Aperture = 0.3;
#declare Race_Focal_Distance = 3.2;
#include "race_camera.inc"
light_source { <-3, 5, -5> rgb <0.8, 0.65, 0.5> }
#declare F = finish { ambient 0.08 diffuse 0.7 }
background { rgb <0.01, 0.012, 0.03> }
// The bar, with a bottle and a cup.
box { <-4, 0.4, -1>, <4, 0.6, 0.7> pigment { wood turbulence 0.1 color_map { [0 rgb <0.35, 0.2, 0.1>] [1 rgb <0.2, 0.1, 0.05>] } scale 0.15 rotate y * 90 } finish { F } }
#declare Bottle = union {
	cylinder { 0, y * 0.75, 0.17 }
	cone { y * 0.75, 0.17, y * 0.98, 0.06 }
	cylinder { y * 0.98, y * 1.25, 0.06 }
}
object { Bottle translate <-0.55, 0.6, 0> pigment { rgb <0.1, 0.25, 0.12> } finish { F phong 0.8 phong_size 60 } }
cylinder { <-0.55, 0.75, 0>, <-0.55, 1.15, 0>, 0.172 pigment { gradient y color_map { [0.5 rgb <0.85, 0.8, 0.65>] [0.5 rgb <0.6, 0.1, 0.1>] } scale 0.2 } finish { F } }
difference { cylinder { <0.45, 0.6, 0.1>, <0.45, 1, 0.1>, 0.22 } cylinder { <0.45, 0.65, 0.1>, <0.45, 1.1, 0.1>, 0.19 } pigment { rgb <0.75, 0.75, 0.7> } finish { F } }
torus { 0.13, 0.03 rotate x * 90 translate <0.75, 0.82, 0.1> pigment { rgb <0.75, 0.75, 0.7> } finish { F } }
// The street: dark houses, lamps, windows.
#declare R = seed(3);
box { <-60, -3, 5>, <60, -2, 90> pigment { rgb <0.05, 0.05, 0.06> } finish { ambient 0.4 diffuse 0.3 } }
#for (I, 0, 9)
	#local X = -24 + 5 * I + rand(R);
	box { <X, -2, 40>, <X + 4.4, 6 + 9 * rand(R), 44> pigment { rgb <0.06, 0.05, 0.07> } finish { ambient 1 diffuse 0.2 } }
#end
#for (I, 0, 44)
	#local B = 3 + 9 * pow(rand(R), 2);
	#local C = <1, 0.55 + 0.35 * rand(R), 0.15 + 0.5 * rand(R)>;
	sphere { <-14 + 28 * rand(R), -1 + 9 * rand(R), 14 + 24 * rand(R)>, 0.16 + 0.14 * rand(R) no_shadow pigment { rgb C } finish { ambient B diffuse 0 } }
#end
#for (I, 0, 7)
	#local P = <-9 + 2.6 * I, -1.4, 16 + 9 * rand(R)>;
	sphere { P, 0.2 no_shadow pigment { rgb <1, 0.1, 0.05> } finish { ambient 5 diffuse 0 } }
#end
