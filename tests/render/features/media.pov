// A lit cloud between camera and posts.
#include "view.inc"
#include "oracle-scene.inc"
camera { View() }
sphere {
	0, 1.5 hollow pigment { rgbt 1 }
	interior { media { scattering { 1, 0.25 } absorption 0.1 emission 0.1 method 3 intervals 1 samples 8 } }
	translate <0.5, 1.6, 3>
}
