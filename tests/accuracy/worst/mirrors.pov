// SPDX-License-Identifier: AGPL-3.0-or-later
// A mirror in focus that shows what is far out of it, one out of focus that shows what is sharp, and mirrors in mirrors.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
#declare Race_Location = <0, 1.6, -5>;
#declare Race_Look_At = <0, 0.8, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.4;
#declare Race_Focal_Distance = 5;
#include "race_camera.inc"
light_source { <-6, 8, -8> rgb 0.9 }
#declare F = finish { ambient 0.1 diffuse 0.7 }
#declare Mirror = texture { pigment { rgb 0.03 } finish { ambient 0 diffuse 0.2 reflection 0.9 specular 0.5 roughness 0.005 } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.8, 0.75, 0.65>] [0.5 rgb <0.25, 0.4, 0.7>] } } }
plane { y, 0 pigment { checker rgb 0.85 rgb <0.15, 0.1, 0.2> scale 0.3 } finish { F reflection 0.2 } }
// A pane in focus with a frame; its picture is metres behind it.
box { <-1.9, 0, 0>, <-0.5, 1.7, 0.02> texture { Mirror } rotate y * 12 }
#for (I, 0, 6) box { <-1.9 + 0.22 * I, 0, -0.02>, <-1.88 + 0.22 * I, 1.7, 0> pigment { rgb 0.1 } finish { F } rotate y * 12 } #end
sphere { <0.35, 0.5, 0.2>, 0.5 texture { Mirror } }
sphere { <1.3, 0.3, -1.6>, 0.3 texture { Mirror } }
sphere { <1.5, 0.8, 1.8>, 0.8 texture { Mirror } normal { bumps 0.15 scale 0.1 } }
#declare R = seed(8);
#for (I, 0, 29)
	cylinder { 0, y * (0.4 + rand(R)), 0.05 translate <-4 + 8 * rand(R), 0, -4 + 9 * rand(R)> pigment { rgb <rand(R), rand(R), rand(R)> } finish { F } }
#end
