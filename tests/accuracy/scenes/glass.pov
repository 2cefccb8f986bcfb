// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Reflection and refraction
// Shows: glass, chrome and a wet table top
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }
#declare Race_Location = <0, 1.7, -4.5>;
#declare Race_Look_At = <0, 0.65, 0>;
#declare Race_Angle = 36;
#declare Race_Aperture = 0.3;
#declare Race_Focal_Distance = 4.3;
#include "race_camera.inc"
light_source { <-5, 7, -4> rgb 0.9 }
#declare F = finish { ambient 0.12 diffuse 0.7 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.7, 0.68, 0.62>] [0.6 rgb <0.25, 0.35, 0.5>] [1 rgb <0.6, 0.65, 0.7>] } } }
box { <-5, -0.2, -3>, <5, 0, 4> pigment { checker rgb <0.75, 0.72, 0.66>, rgb <0.18, 0.12, 0.1> scale 0.5 } finish { F reflection 0.18 } }
box { <-5, 0, 3.9>, <5, 2.2, 4> pigment { gradient x color_map { [0.5 rgb <0.55, 0.2, 0.15>] [0.5 rgb <0.75, 0.7, 0.55>] } scale 0.4 } finish { F } }
#declare Glass = material { texture { pigment { rgbf <0.97, 0.99, 0.98, 0.94> } finish { ambient 0 diffuse 0.02 reflection 0.08 specular 0.3 roughness 0.02 } } interior { ior 1.5 } }
sphere { <-0.75, 0.55, 0.1>, 0.55 material { Glass } }
sphere { <0.55, 0.5, 0.7>, 0.5 pigment { rgb 0.08 } finish { ambient 0 diffuse 0.2 reflection 0.75 specular 0.3 roughness 0.02 } }
cylinder { <0.55, 0, -0.75>, <0.55, 0.75, -0.75>, 0.24 material { Glass } }
cylinder { <0.55, 0.02, -0.75>, <0.55, 0.45, -0.75>, 0.2 material { texture { pigment { rgbf <0.95, 0.5, 0.2, 0.85> } finish { ambient 0 diffuse 0.1 } } interior { ior 1.33 } } }
torus { 0.35, 0.1 translate <-1.3, 0.1, -1.4> pigment { rgb <0.5, 0.35, 0.1> } finish { ambient 0.05 diffuse 0.3 reflection 0.45 } }
sphere { <1.6, 0.3, -0.2>, 0.3 pigment { rgb <0.15, 0.4, 0.25> } finish { F reflection 0.1 phong 0.5 } }
