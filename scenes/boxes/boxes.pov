// The table-top scene through a camera that tiltcal calibrated from photographs of a board.
//
//   povray boxes.pov +L<folder of tiltcal calibrate --out> Declare=State=1 +W1800 +H1200 +FE +Oplus5.exr
//
// State: 0 untilted, 1 plus5, 2 minus5.  Samples: the most lens samples of a pixel.  Variance: 0 takes them all.
// Keep the picture at the photographs' 3:2, or the calibrated principal point no longer fits.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "boxes.inc"

#ifndef (State) #declare State = 0; #end
#ifndef (Samples) #declare Samples = 128; #end
#ifndef (Variance) #declare Variance = 0; #end

#declare Location = Boxes_Camera_Location;
#declare Look_At = Location + 600 * Boxes_Camera_Direction;
#declare Sky = Boxes_Camera_Sky;

#switch (State)
	#case (0) #include "camera-untilted.inc" #declare Photographer = TiltCal_untilted(Location, Look_At, Sky) #break
	#case (1) #include "camera-plus5.inc" #declare Photographer = TiltCal_plus5(Location, Look_At, Sky) #break
	#case (2) #include "camera-minus5.inc" #declare Photographer = TiltCal_minus5(Location, Look_At, Sky) #break
	#else #error "State must be 0 (untilted), 1 (plus5) or 2 (minus5).\n"
#end

camera { Photographer blur_samples Samples variance Variance }
background { Boxes_Background }
