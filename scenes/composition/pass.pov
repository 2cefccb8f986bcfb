// One pass through the camera that `tiltcal pose` placed (out/composition/pose.inc).
#include "set.inc"
#include "pose.inc"
