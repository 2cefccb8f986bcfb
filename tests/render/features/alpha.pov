// Rendered with +UA: the background is transparent, and a pane is half so.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() }
box { <-0.5, 2.2, 2>, <0.9, 3.6, 2.02> pigment { rgbt <0.9, 0.5, 0.2, 0.5> } }
