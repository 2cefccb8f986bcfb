// The calibration board as a calibrated camera saw it in one of its own photographs.
//
// view.inc is two lines, written by whoever renders (here: state plus5, photograph 3), in a folder given with +L:
//   #include "camera-plus5.inc"
//   #declare View = TiltCal_plus5(TiltCal_plus5_Photo_3_Location, TiltCal_plus5_Photo_3_Look_At, TiltCal_plus5_Photo_3_Sky)
// POV-Ray 3.7 takes numbers only from the command line, and makes no macro name from a number.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "board.inc"
#include "view.inc"

#ifndef (Samples) #declare Samples = 64; #end
#ifndef (Variance) #declare Variance = 0; #end

camera { View blur_samples Samples variance Variance }
background { Board_Background }
