// The calibration board as a calibrated camera saw it in one of its own photographs.
//
//   povray board.pov +L<folder of tiltcal calibrate --out> Declare=State=1 Declare=Photo=3 +W1800 +H1200
//
// State: 0 untilted, 1 plus5, 2 minus5. Photo: 1, 2, ... in the order of that state's files.
// TiltCal_Blur_Samples, TiltCal_Denoise and TiltCal_Distortion are the camera file's own switches; Declare works for them too.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "board.inc"

#ifndef (State) #declare State = 0; #end
#ifndef (Photo) #declare Photo = 1; #end

#switch (State)
	#case (0) #include "camera-untilted.inc" TiltCal_untilted_Pose(Photo) #break
	#case (1) #include "camera-plus5.inc" TiltCal_plus5_Pose(Photo) #break
	#case (2) #include "camera-minus5.inc" TiltCal_minus5_Pose(Photo) #break
	#else #error "State must be 0 (untilted), 1 (plus5) or 2 (minus5).\n"
#end

background { Board_Background }
