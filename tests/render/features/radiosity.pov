// Radiosity: its pretrace goes through the camera too.
#include "view.inc"
#include "oracle-scene.inc"
global_settings { radiosity { pretrace_start 0.08 pretrace_end 0.02 count 40 error_bound 0.8 recursion_limit 1 } }
camera { View() }
