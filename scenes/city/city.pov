// A city that looks like a model: the plane of focus is tilted against the ground, so only a slice of it is sharp.
// Declare=Pinhole=1 shows the same view with everything sharp.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "city.inc"

camera {
	tilt_lens {
		#ifndef (Pinhole)
			focal_plane_tilt -62          // the ground recedes upwards in the picture, this plane downwards
			focal_distance 150
			aperture_diameter 4.5
			denoise
		#end
	}
	location <-62, 92, -118>
	right 16/9*x
	angle 34
	look_at <2, 0, -6>
	blur_samples 8, 32
	variance 0.0004
}
