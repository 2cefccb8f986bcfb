// Area lights without jitter. With jitter stock's shadows depend on how many rays a thread has traced before.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() }
light_source { <6, 9, -4> rgb <0.5, 0.4, 0.3> area_light <3, 0, 0>, <0, 0, 3>, 5, 5 adaptive 1 circular orient }
