// The camera's word sky, and a sky sphere that many lens rays end in.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() sky <0.3, 1, 0> look_at <0, 1.2, 6> }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.7, 0.5, 0.4>] [0.6 rgb <0.2, 0.3, 0.7>] } } }
