// SPDX-License-Identifier: AGPL-3.0-or-later
// Before nothing (+UA): black posts and letters that no light reaches, in and out of focus, beside things that have colours. What is transparent is all that the posts' edges show.
#version 3.7;
global_settings { assumed_gamma 1 ambient_light 0 }
#declare Race_Location = <0, 1.5, -8>;
#declare Race_Look_At = <0, 1.5, 0>;
#declare Race_Angle = 40;
#declare Race_Aperture = 0.6;
#declare Race_Focal_Distance = 8;
#include "race_camera.inc"
light_source { <0, 6, 9> rgb 1 }
plane { y, 0 pigment { checker rgb 0.3 rgb 0.9 } clipped_by { plane { z, 8 } } }
#for (I, -8, 8)
	cylinder { <I * 0.4, 0, I * 0.5>, <I * 0.4 + 0.2, 4, I * 0.5>, 0.05 pigment { rgb <0.5, 0.8, 0.3> } finish { ambient 0 } }
#end
sphere { <1.3, 1.2, 3>, 0.8 pigment { rgb <0.9, 0.4, 0.2> } finish { ambient 0 } }
text { ttf "timrom.ttf" "tilt" 0.1, 0 scale 0.8 translate <-1.9, 2, 0> pigment { rgb 0 } }
sphere { <-1.5, 0.9, -2>, 0.3 pigment { rgbt <0.8, 0.9, 1, 0.6> } finish { ambient 0 } }
