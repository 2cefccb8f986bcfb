// SPDX-License-Identifier: AGPL-3.0-or-later
// Title: Cheap rays
// Shows: a few stones on sand: rays that cost almost nothing, smooth blur; what a sample costs beside its ray counts most here
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Race_Location = <0, 1.4, -4>;
#declare Race_Look_At = <0, 0.5, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.3;
#declare Race_Focal_Distance = 4;
#include "race_camera.inc"
light_source { <-10, 12, -8> rgb 0.9 }
#declare F = finish { ambient 0.15 diffuse 0.7 }
background { rgb <0.55, 0.65, 0.75> }
plane { y, 0 pigment { rgb <0.75, 0.66, 0.5> } finish { F } }
sphere { <0, 0.5, 0>, 0.5 pigment { rgb <0.35, 0.35, 0.38> } finish { F } }
sphere { <-0.9, 0.3, -1.2>, 0.3 pigment { rgb <0.6, 0.3, 0.2> } finish { F } }
sphere { <1.2, 0.35, 1>, 0.35 pigment { rgb <0.8, 0.8, 0.78> } finish { F } }
sphere { <0.55, 0.15, -2>, 0.15 pigment { rgb <0.2, 0.25, 0.3> } finish { F } }
sphere { <-1.6, 0.6, 2.6>, 0.6 pigment { rgb <0.5, 0.45, 0.4> } finish { F } }
