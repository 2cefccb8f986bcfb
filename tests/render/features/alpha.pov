// Rendered with +UA: the background is transparent, and a pane is half so.
#include "view.inc"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { View() }
light_source { <6, 9, -4> rgb 1 }
sphere { <-1.5, 1.6, 2>, 1.2 pigment { checker rgb <0.9, 0.4, 0.2>, rgb 0.7 scale 0.3 } }
sphere { <1.5, 2, 8>, 2.2 pigment { rgb <0.2, 0.5, 0.8> } }
box { <-0.6, 0.4, 1>, <1.2, 2.8, 1.02> pigment { rgbt <0.9, 0.5, 0.2, 0.5> } }
