// Seen in the mirror ball and by shadows alone.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() }
union {
	sphere { <0.5, 2, 4>, 1 }
	box { <-2, 0, 1>, <-1, 2, 2> }
	pigment { rgb <0.8, 0.7, 0.2> }
	no_image
}
