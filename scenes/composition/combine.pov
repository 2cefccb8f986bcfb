// The photograph with the dragon in it: where the dragon is, its light; elsewhere the photograph, darkened by its
// shadow as the matte world is. Every pixel by itself: out = Exposure dragon + photo (with - dragon) / without.
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Exposure) #declare Exposure = 0.944; #end   // of the photograph: `tiltcal profile --match gain` finds it
#include "photo.inc"   // Photo_File, which composition.cmake writes
#declare Photo = function { pigment { image_map { jpeg Photo_File once } } }
#declare Without = function { pigment { image_map { exr "pass0.exr" once } } }
#declare With = function { pigment { image_map { exr "pass1.exr" once } } }
#declare Dragon = function { pigment { image_map { exr "pass2.exr" once } } }
// Of the photograph's light that is left; all where the lens lets none of the few samples of a dark corner through.
#declare Share = function(x, y) { select(y - 1e-4, 1, max(0, x)/max(1e-4, y)) }
#declare Red = function { min(0.9999, Exposure*Dragon(x,y,z).red + Photo(x,y,z).red*Share(With(x,y,z).red - Dragon(x,y,z).red, Without(x,y,z).red)) }
#declare Green = function { min(0.9999, Exposure*Dragon(x,y,z).green + Photo(x,y,z).green*Share(With(x,y,z).green - Dragon(x,y,z).green, Without(x,y,z).green)) }
#declare Blue = function { min(0.9999, Exposure*Dragon(x,y,z).blue + Photo(x,y,z).blue*Share(With(x,y,z).blue - Dragon(x,y,z).blue, Without(x,y,z).blue)) }
box {
	0, <1, 1, 0.01>
	pigment {
		average
		pigment_map {
			[1 function { Red(x, y, 0) } color_map { [0 rgb 0] [1 rgb <3, 0, 0>] }]
			[1 function { Green(x, y, 0) } color_map { [0 rgb 0] [1 rgb <0, 3, 0>] }]
			[1 function { Blue(x, y, 0) } color_map { [0 rgb 0] [1 rgb <0, 0, 3>] }]
		}
	}
	finish { emission 1 diffuse 0 ambient 0 }
}
camera { orthographic location <0.5, 0.5, -1> direction z right x up y }
