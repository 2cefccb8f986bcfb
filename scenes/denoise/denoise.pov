// What denoise makes of eight samples a pixel: render with Declare=Denoise=0 and Declare=Denoise=1.
//
//   povray denoise.pov +L../first-tilt +W720 +H405 Declare=Denoise=1 +Odenoise.png
#version 3.7;
global_settings { assumed_gamma 1 }
#include "balls.inc"
#ifndef (Denoise) #declare Denoise = 1; #end
#ifndef (Samples) #declare Samples = 8; #end
#ifndef (Seed) #declare Seed = 0; #end

camera {
	tilt_lens {
		focal_distance 10.5
		aperture_diameter 0.5
		seed Seed
		#if (Denoise) denoise #end
	}
	location <0, 2, -8>
	look_at <0, 1, 0>
	angle 50
	right 16/9*x
	blur_samples Samples
	variance 0
}
