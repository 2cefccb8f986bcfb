// SPDX-License-Identifier: AGPL-3.0-or-later
// Print seen through balls and panes of glass, which focus it elsewhere than the lens does.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
#declare Race_Location = <0, 1.2, -5>;
#declare Race_Look_At = <0, 0.8, 0>;
#declare Race_Angle = 36;
#declare Race_Aperture = 0.35;
#declare Race_Focal_Distance = 5;
#include "race_camera.inc"
light_source { <-5, 8, -6> rgb 0.9 }
#declare F = finish { ambient 0.2 diffuse 0.7 }
background { rgb <0.5, 0.55, 0.6> }
plane { y, 0 pigment { checker rgb 0.8 rgb 0.3 scale 0.25 } finish { F } }
plane { z, 2 pigment { cells color_map { [0.4 rgb 0.08] [0.4 rgb 0.92] } scale <0.12, 0.07, 1> } finish { F } clipped_by { plane { y, 2.2 } } }
#declare Glass = material { texture { pigment { rgbf <0.97, 0.99, 0.98, 0.96> } finish { ambient 0 diffuse 0.02 reflection 0.06 specular 0.6 roughness 0.005 } } interior { ior 1.5 } }
#for (I, 0, 4) sphere { <-1.3 + 0.65 * I, 0.35 + 0.25 * mod(I, 2), 0.3 * I - 0.4>, 0.33 material { Glass } } #end
box { <-1.6, 0, -0.05>, <1.6, 1.6, 0.05> rotate y * 25 translate z * 0.9 material { Glass } normal { ripples 0.12 scale 0.3 } }
cylinder { <0.9, 0, -1.2>, <0.9, 0.9, -1.2>, 0.2 material { Glass } }
