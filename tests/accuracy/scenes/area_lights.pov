// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Area lights
// Area lights: yes
// Shows: a still life under a large lamp and a window; soft shadows are noise of their own
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1.9, -4.2>;
#declare Race_Look_At = <0, 0.55, 0>;
#declare Race_Angle = 36;
#declare Race_Aperture = 0.26;
#declare Race_Focal_Distance = 4.1;
#include "race_camera.inc"
light_source { <-3, 4, -2.5> rgb <0.75, 0.68, 0.55> area_light <1.6, 0, 0>, <0, 0, 1.6>, 3, 3 #if (!Race_Every_Point) adaptive 0 #end jitter }
light_source { <4, 2.5, -1> rgb <0.22, 0.28, 0.36> area_light <0, 1.5, 0>, <0, 0, 1.5>, 3, 3 #if (!Race_Every_Point) adaptive 0 #end jitter }
#declare F = finish { ambient 0.07 diffuse 0.75 }
box { <-4, -0.1, -3>, <4, 0, 1.8> pigment { wood color_map { [0 rgb <0.55, 0.38, 0.22>] [1 rgb <0.4, 0.25, 0.13>] } scale 0.12 turbulence 0.08 rotate y * 90 } finish { F } }
plane { z, 2.6 pigment { gradient x triangle_wave color_map { [0.45 rgb <0.5, 0.53, 0.5>] [0.55 rgb <0.68, 0.7, 0.64>] } scale 0.5 } finish { F } }
// Apples and a jug.
#declare R = seed(5);
#for (I, 0, 5)
	#local P = <-1.1 + 0.42 * I + 0.1 * rand(R), 0.21, -0.9 + 0.5 * mod(I, 3)>;
	sphere { P, 0.21 pigment { bozo color_map { [0 rgb <0.75, 0.12, 0.08>] [0.6 rgb <0.8, 0.5, 0.1>] [1 rgb <0.6, 0.65, 0.2>] } scale 0.15 translate I } finish { F } }
	cylinder { P + y * 0.18, P + <0.03, 0.28, 0>, 0.012 pigment { rgb <0.25, 0.15, 0.08> } finish { F } }
#end
lathe { linear_spline 7, <0, 0>, <0.3, 0>, <0.42, 0.35>, <0.36, 0.7>, <0.2, 0.95>, <0.26, 1.15>, <0.24, 1.15> translate <0.85, 0, 0.6>
	pigment { gradient y color_map { [0.6 rgb <0.8, 0.78, 0.7>] [0.6 rgb <0.15, 0.25, 0.5>] [0.7 rgb <0.15, 0.25, 0.5>] [0.7 rgb <0.8, 0.78, 0.7>] } scale 1.1 } finish { F } }
cylinder { <1.25, 0.02, -1.2>, <0.4, 0.02, -1.6>, 0.02 pigment { rgb 0.7 } finish { F } }
box { <-1.7, 0, 0.7>, <-0.9, 1, 1.2> pigment { brick rgb <0.2, 0.15, 0.12>, rgb <0.35, 0.12, 0.1> brick_size <0.2, 1.2, 1> mortar 0.03 } finish { F } rotate y * -6 }
