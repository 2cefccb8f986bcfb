// SPDX-License-Identifier: AGPL-3.0-or-later
// Thin blades right before the lens, some in focus beside them, before a sharp wall of small pattern.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1, -6>;
#declare Race_Look_At = <0, 1, 0>;
#declare Race_Angle = 38;
#declare Race_Aperture = 0.4;
#declare Race_Focal_Distance = 6;
#include "race_camera.inc"
light_source { <-10, 20, -20> rgb 0.9 }
#declare F = finish { ambient 0.15 diffuse 0.7 }
background { rgb <0.6, 0.7, 0.9> }
plane { z, 0.2 pigment { checker rgb 0.75 rgb <0.25, 0.2, 0.15> scale 0.22 } finish { F } clipped_by { plane { y, 2 } } }
#declare R = seed(23);
#for (I, 0, 89)
	#local P = <-1.6 + 3.2 * rand(R), -0.6, -4.6 + 1.2 * rand(R)>;
	#local Q = P + <1.2 * rand(R) - 0.6, 2.4 + rand(R), 0.5 * rand(R)>;
	cone { P, 0.008, Q, 0.001 pigment { rgb <0.2 + 0.6 * rand(R), 0.5 + 0.4 * rand(R), 0.1> } finish { F } }
#end
#for (I, 0, 39)
	#local P = <-2 + 4 * rand(R), -0.4, -0.3 * rand(R)>;
	cone { P, 0.02, P + <0.8 * rand(R) - 0.4, 1.4 + rand(R), 0>, 0.003 pigment { rgb <0.1, 0.35 + 0.3 * rand(R), 0.1> } finish { F } }
#end
