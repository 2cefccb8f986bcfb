// A camera with a normal: rough glass before the lens.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() normal { bumps 0.03 scale 0.3 } }
