// A city that looks like a model: the plane of focus is tilted against the ground, so only a slice of it is sharp.
// Declare=Pinhole=1 shows the same view with everything sharp.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "city.inc"

camera {
	tilt_lens {
		#ifndef (Pinhole)
			focal_plane_tilt -62          // the ground recedes upwards in the picture, this plane downwards
			focal_distance 196
			aperture_diameter 7
			denoise
		#end
	}
	location <-80, 118, -152>
	right 16/9*x
	angle 35
	look_at <4, 0, -4>
	blur_samples 16, 64
	variance 0.0002
}
