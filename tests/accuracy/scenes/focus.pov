// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: In focus everywhere
// Shows: a harbour wall of painted houses through a small aperture: the blur is under a pixel, what is left is anti-aliasing
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 2.2, -14>;
#declare Race_Look_At = <0, 2.6, 0>;
#declare Race_Angle = 42;
#declare Race_Aperture = 0.01;
#declare Race_Focal_Distance = 14;
#include "race_camera.inc"
light_source { <-30, 40, -40> rgb 0.95 }
light_source { <20, 10, -30> rgb <0.12, 0.15, 0.2> shadowless }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.75, 0.8, 0.85>] [0.5 rgb <0.25, 0.42, 0.7>] } } }
#declare F = finish { ambient 0.12 diffuse 0.75 }
#declare R = seed(7);
#for (I, 0, 8)
	#local W = 1.3;
	#local X = (I - 4) * W;
	#local H = 3.2 + 1.6 * rand(R);
	#local Z = 0.6 * rand(R);
	#local C = <0.55 + 0.4 * rand(R), 0.45 + 0.35 * rand(R), 0.25 + 0.4 * rand(R)>;
	box { <X - W / 2, 0, Z>, <X + W / 2, H, 4> pigment { bozo color_map { [0 rgb C] [1 rgb C * 0.8] } scale 0.4 } finish { F } }
	prism { linear_sweep linear_spline Z - 0.1, 4, 4, <X - W / 2 - 0.06, -H>, <X + W / 2 + 0.06, -H>, <X, -H - 0.9>, <X - W / 2 - 0.06, -H>
		matrix <1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0>
		pigment { rgb <0.45, 0.16, 0.1> } finish { F } }
	#for (K, 0, 2)
		#for (J, 0, 1)
			#local P = <X - 0.32 + 0.64 * J, 0.75 + 1.05 * K, Z>;
			box { P - <0.17, 0.3, 0.03>, P + <0.17, 0.3, 0.03> pigment { rgb 0.9 } finish { F } }
			box { P - <0.12, 0.25, 0.04>, P + <0.12, -0.02, 0.04> pigment { rgb <0.1, 0.13, 0.2> } finish { F } }
			box { P - <0.12, -0.02, 0.04>, P + <0.12, 0.25, 0.04> pigment { rgb <0.1, 0.13, 0.2> } finish { F } }
		#end
	#end
#end
// The quay and the water.
box { <-20, -0.3, -3>, <20, 0, 4> pigment { brick rgb 0.35, rgb <0.6, 0.57, 0.5> brick_size <0.8, 0.3, 0.5> mortar 0.04 } finish { F } }
plane { y, -0.6 pigment { gradient z color_map { [0 rgb <0.12, 0.2, 0.24>] [0.5 rgb <0.3, 0.42, 0.46>] [1 rgb <0.12, 0.2, 0.24>] } scale 0.7 warp { turbulence 0.4 } } finish { F } }
#for (I, -6, 6)
	cylinder { <I * 1.1, -0.6, -3.1>, <I * 1.1, 0.45, -3.1>, 0.06 pigment { rgb <0.3, 0.22, 0.15> } finish { F } }
#end
cylinder { <-12, 0.35, -3.1>, <12, 0.35, -3.1>, 0.02 pigment { rgb <0.75, 0.7, 0.6> } finish { F } }
