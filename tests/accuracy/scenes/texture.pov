// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Fine texture
// Shows: woven cloth, gravel and print, near and far from the plane of focus
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 2.4, -4>;
#declare Race_Look_At = <0, 0.5, 0.3>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.28;
#declare Race_Focal_Distance = 4.4;
#include "race_camera.inc"
light_source { <-6, 9, -5> rgb 0.95 }
light_source { <6, 6, -8> rgb 0.15 shadowless }
background { rgb <0.3, 0.3, 0.32> }
#declare F = finish { ambient 0.1 diffuse 0.8 }
// The cloth: threads of two colours.
plane { y, 0
	pigment { checker pigment { gradient x triangle_wave color_map { [0 rgb <0.08, 0.1, 0.25>] [1 rgb <0.3, 0.35, 0.6>] } scale 0.5 }
		pigment { gradient z triangle_wave color_map { [0 rgb <0.45, 0.4, 0.3>] [1 rgb <0.9, 0.87, 0.8>] } scale 0.5 } scale 0.06 rotate y * 27 }
	finish { F } }
// An open book with lines of print.
#for (I, -1, 1, 2)
	box { <0, 0, 0>, <1.05, 0.07, 1.4> pigment { rgb 0.95 } finish { F }
		#if (I < 0) scale <-1, 1, 1> #end rotate z * 4 * I translate <-0.1, 0.03, -0.3> rotate y * -15 }
	#for (L, 0, 17)
		box { <0.1, 0.05, 0.12 + 0.066 * L>, <0.95, 0.0712, 0.145 + 0.066 * L>
			pigment { cells color_map { [0.3 rgb 0.08] [0.3 rgb 0.9] } scale <0.035, 1, 1> translate <0.013, -0.5, 0.4 + L> } finish { F }
			#if (I < 0) scale <-1, 1, 1> #end rotate z * 4 * I translate <-0.1, 0.03, -0.3> rotate y * -15 }
	#end
#end
// A flower pot with gravel, and pencils.
cone { <1.3, 0, 1.6>, 0.4, <1.3, 0.8, 1.6>, 0.55 pigment { granite color_map { [0 rgb <0.5, 0.22, 0.12>] [1 rgb <0.8, 0.5, 0.35>] } scale 0.4 } finish { F } }
sphere { <1.3, 0.8, 1.6>, 0.5 scale <1, 1, 1> pigment { crackle color_map { [0 rgb 0.1] [0.25 rgb <0.6, 0.58, 0.5>] [1 rgb 0.9] } scale 0.09 } finish { F } }
#for (I, 0, 4)
	cylinder { <-1.7 + 0.22 * I, 0.06, -1.1 + 0.05 * I>, <-1.2 + 0.2 * I, 0.06, -0.2 + 0.04 * I>, 0.05
		pigment { gradient x color_map { [0.5 rgb <0.9, 0.7, 0.1>] [0.5 rgb <0.1, 0.1, 0.1>] } scale 0.03 rotate y * 30 } finish { F } }
#end
box { <-2.2, 0, 1.4>, <-0.9, 0.9, 2.3> pigment { wood color_map { [0 rgb <0.5, 0.33, 0.18>] [1 rgb <0.78, 0.6, 0.4>] } scale 0.05 rotate x * 4 turbulence 0.05 } finish { F } rotate y * 8 }
