// Every camera type that POV-Ray has, one for each value of Camera: for stock_scenes.sh.
#version 3.7;
#include "oracle-scene.inc"
#declare At = transform { translate <0, 2.6, -3.5> };
#switch (Camera)
	#case (0) camera { perspective location <0, 2.6, -3.5> look_at <0, 1.2, 6> } #break
	#case (1) camera { orthographic location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 60 } #break
	#case (2) camera { fisheye location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 170 } #break
	#case (3) camera { ultra_wide_angle location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 120 } #break
	#case (4) camera { omnimax location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 160 } #break
	#case (5) camera { panoramic location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 150 } #break
	#case (6) camera { spherical location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 300 150 } #break
	#case (7) camera { cylinder 1 location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 120 } #break
	#case (8) camera { cylinder 2 location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 120 } #break
	#case (9) camera { cylinder 3 location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 120 } #break
	#case (10) camera { cylinder 4 location <0, 2.6, -3.5> look_at <0, 1.2, 6> angle 120 } #break
	#case (11)
		camera {
			mesh_camera {
				1 0
				mesh {
					#for (I, 0, 79)
						#for (J, 0, 59)
							triangle {
								<I / 10 - 4, 4 - J / 15, -3>, <I / 10 - 3.9, 4 - J / 15, -3>, <I / 10 - 4, 3.93 - J / 15, -3>
							}
						#end
					#end
				}
			}
			location <0, 0, -0.01>
		}
		#break
	#case (12) camera { location <0, 2.6, -3.5> look_at <0, 1.2, 6> aperture 0.8 focal_point <0, 1.42, 4.5> blur_samples 19 } #break
#end
