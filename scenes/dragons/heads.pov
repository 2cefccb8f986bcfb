// How far the heads lie from the three planes of focus, and how wide the lens blurs them, as lines of text:
// b = w d |1 - q.P|/z, with w in pixels of a picture 800 wide. No dragon is built for it.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Without_Dragons = 1;
#include "dragons.inc"

#declare Axis = vnormalize(Aim - Eye);
#declare W = 400/tan(radians(View_Angle/2));
#declare Names = array[3] { "near", "middle", "far" };
#declare Parts = array[3] { "between the eyes", "tip of the nose", "tip of a horn" };
#declare Points = array[3] { Head_Point, <0, 0.02, -0.79>, <0.215, 0.60, 0.72> };

#macro Report(Title, Plane)
	#debug concat(Title, ": distance from the plane, blur in pixels\n")
	#local N = vnormalize(Plane[1]);
	#for (I, 0, 2)
		#debug concat("  ", Names[I])
		#for (K, 0, 2)
			#local P = Head_World(I, Points[K]);
			#local Off = vdot(P - Plane[0], N);
			#local B = W*Aperture*abs(1 - vdot(P - Eye, N)/vdot(Plane[0] - Eye, N))/vdot(P - Eye, Axis);
			#debug concat(" | ", Parts[K], " ", str(Off, 0, 4), ", ", str(B, 0, 2))
		#end
		#debug "\n"
	#end
#end
Report("untilted", Upright_Plane)
Report("tilted", Heads_Plane)
Report("oblique", Oblique_Plane)

camera { location Eye look_at Aim }
