// The camera inside a transparent object with an interior, and in that a second one whose surface cuts through the
// lens (a disc of diameter 0.4 at <0, 2.6, -3.5>): part of the lens is inside of it, part outside.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() }
#declare Tinted = material {
	texture { pigment { rgbt <0.8, 0.9, 1, 1> } finish { ambient 0 diffuse 0 } }
	interior { media { absorption <0.06, 0.03, 0.01> method 3 samples 3 } }
}
sphere { <0, 2, 5>, 18 hollow material { Tinted } }
box { <-1, 2.65, -5>, <1, 4, -2> hollow material { Tinted } interior { media { absorption <0.1, 0.4, 0.6> } } }
