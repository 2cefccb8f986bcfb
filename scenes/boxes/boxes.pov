// The table-top scene through a camera that tiltcal calibrated from photographs of a board.
//
//   povray boxes.pov +L<folder of tiltcal calibrate --out> Declare=State=1 +W1800 +H1200 +FE +Oplus5.exr
//
// State: 0 untilted, 1 plus5, 2 minus5. Any size of the photographs' 3:2 will do.
// Placed: 1 where the untilted photograph says (pose.inc, by `tiltcal pose`; README.md), 0 where scene.json says.
// TiltCal_Blur_Samples, TiltCal_Denoise and TiltCal_Distortion are the camera file's own switches; Declare works for them too.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "boxes.inc"

#ifndef (State) #declare State = 0; #end

#ifndef (Placed) #declare Placed = 1; #end

#if (Placed)
	#declare TiltCal_Pose_Camera = 0;   // its place alone: on a tripod, only the lens tilts
	#include "pose.inc"
	#declare Boxes_Camera_Location = TiltCal_Pose_Location;
	#declare Boxes_Look_At = TiltCal_Pose_Look_At;
	#declare Boxes_Camera_Sky = TiltCal_Pose_Sky;
#else
	#declare Boxes_Look_At = Boxes_Camera_Location + 600 * Boxes_Camera_Direction;
#end
#switch (State)
	#case (0) #include "camera-untilted.inc" TiltCal_untilted_Body(Boxes_Camera_Location, Boxes_Look_At, Boxes_Camera_Sky) #break
	#case (1) #include "camera-plus5.inc" TiltCal_plus5_Body(Boxes_Camera_Location, Boxes_Look_At, Boxes_Camera_Sky) #break
	#case (2) #include "camera-minus5.inc" TiltCal_minus5_Body(Boxes_Camera_Location, Boxes_Look_At, Boxes_Camera_Sky) #break
	#else #error "State must be 0 (untilted), 1 (plus5) or 2 (minus5).\n"
#end

background { Boxes_Background }
