// How far the heads lie from the three planes of focus, how wide the lens blurs them and at which pixel they are, in lines
// of text: b = w d |1 - q.P|/z, with w in pixels of a picture 800 wide. The tips of nose and horn are the head's extremes.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Without_Dragons = 1;
#include "dragons.inc"

#declare Axis = vnormalize(Aim - Eye);
#declare Right = vnormalize(vcross(y, Axis));
#declare Up = vcross(Axis, Right);
#declare W = 400/tan(radians(View_Angle/2));
#declare Names = array[3] { "near", "middle", "far" };
#declare Parts = array[3] { "eyes", "nose", "horn" };
#declare Points = array[3] { Head_Point, <0, 0.02, -0.79>, <0.215, 0.60, 0.72> };

#macro Report(Title, Plane)
	#debug concat(Title, ", distance and blur\n")
	#local N = vnormalize(Plane[1]);
	#for (I, 0, 2)
		#local V = Head[I] - Eye;
		#local V = V/vdot(V, Axis);
		#debug concat("  ", Names[I], " at ", str(400 + W*vdot(V, Right), 0, 0), ",", str(225 - W*vdot(V, Up), 0, 0))
		#for (K, 0, 2)
			#local P = Head_World(I, Points[K]);
			#local Off = vdot(P - Plane[0], N);
			#local B = W*Aperture*abs(1 - vdot(P - Eye, N)/vdot(Plane[0] - Eye, N))/vdot(P - Eye, Axis);
			#debug concat("  ", Parts[K], " ", str(Off, 0, 3), " ", str(B, 0, 1))
		#end
		#debug "\n"
	#end
#end
Report("untilted", Upright_Plane)
Report("tilted", Heads_Plane)
Report("oblique", Oblique_Plane)

camera { location Eye look_at Aim }
