// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a number, a vector or a word of a camera block should not be, and sometimes is.

#ifndef FUZZ_NASTY_WORDS_H
#define FUZZ_NASTY_WORDS_H

const char* const NastyNumbers[] = {
	"0", "-0", "1", "-1", "1e-310", "-1e-310", "5e-324", "1e-300", "1e-160", "-1e-160", "1e-16", "1e-7", "1e7", "-1e7", "1e16",
	"1e30", "-1e30", "1e155", "-1e155", "1e300", "1e308", "-1e308", "1e400", "-1e400", "89.99999999999999", "90", "-90", "180", "360",
	"(1e308*1e308)", "(-1e308*1e308)", "((1e308*1e308)-(1e308*1e308))", "(1e-308*1e-308)", "Infinite", "-Infinite", "NotANumber",
	"Tiny", "Huge", "sqrt(-1)", "ln(0)", "(1/0)", "(0/0)", "pow(0,-1)", "acos(2)", "tan(pi/2)", "exp(1000)", "mod(1,0)", "1/3", "clock",
	"vlength(<1e200,1e200,0>)", "vdot(<Infinite,0,0>,<0,1,0>)", "(Vector.x)", "exp(-740)" };

const char* const NastyVectors[] = {
	"0", "1", "x", "y", "z", "-z", "x+y", "1e-310*z", "1e308*(x+y+z)", "Vector", "-Vector", "Infinite*y", "NotANumber*z",
	"<NotANumber,0,1>", "<Infinite,0,1>", "<0,0,-Infinite>", "vnormalize(<0,0,0>)", "vcross(x,x)", "vrotate(x,<0,0,1e300>)",
	"<1e155,1e155,1e155>", "<1e-170,1e-170,1e-170>", "<5e-324,0,0>", "<1,2>", "<1,2,3,4,5>", "<1 2 3>", "<1,2,3", "<,>", "Tiny*x" };

const char* const NotNumbers[] = {
	"\"text\"", "<1,2,3>", "x", "rgb", "{", "}", "-", "+", "on", "Undeclared", "Other", "#declare", "," };

const char* const Strays[] = {
	"{", "}", "{", "}", ",", "<", ">", "(", ")", "-", ";", "tilt_lens", "tilt_lens {}", "camera", "camera {", "focal_length", "focal_points",
	"show", "show plane", "focus", "denoise", "area_light_grid", "channels", "seed", "shift", "distortion", "lens_tilt", "location", "look_at", "angle", "aperture", "sphere", "pigment",
	"perspective", "orthographic", "fisheye", "normal", "Other", "NoCamera", "Vector", "42", "\"", "//", "/*", "\"text\"",
	"#if (0)", "#end", "#declare", "#local A = 1;", "#undef Vector", "#macro M()", "blades", "bokeh", "vignetting", "natural", "optical", "chromatic", "lateral", "axial", "pupil_magnification", "aberrations", "aberrations {", "coma", "fifth_order", "rotation", "curvature", "default", "@", "\xff" };

const char* const OtherTypes[] = {
	"perspective", "orthographic", "fisheye", "ultra_wide_angle", "omnimax", "panoramic", "cylinder 1", "cylinder 3", "cylinder 9",
	"spherical", "mesh_camera { 1 0 }" };

#endif
