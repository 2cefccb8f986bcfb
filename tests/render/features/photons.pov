// Photons through a glass ball, shot before the camera is asked.
#include "view.inc"
#include "oracle-scene.inc"
global_settings { photons { spacing 0.03 } }
camera { View() }
sphere {
	<-0.6, 1.2, 1.5>, 0.6
	pigment { rgbt <0.95, 0.97, 1, 0.95> }
	finish { ambient 0 diffuse 0.1 reflection 0.05 }
	interior { ior 1.5 }
	photons { target refraction on reflection off }
}
