// What the macros of tilt_lens.inc find, for include_file_numbers: into numbers.txt, one line a case: "number NAME: inputs = outputs".
// Cases are drawn by POV-Ray's rand: cameras and planes of all directions, lenses, two units.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "tilt_lens.inc"
#declare R = seed(7);
#fopen Out "numbers.txt" write
#macro Between(Low, High) (Low + (High - Low)*rand(R)) #end
#macro Anywhere(Size) (Size*(<rand(R), rand(R), rand(R)> - 0.5)) #end
#macro Many(Vector) vstr(3, Vector, " ", 0, 17) #end
#for (I, 1, 100)
   #declare TL_mm = (I > 50 ? 0.001 : 1);
   #local F = Between(15, 150);
   #local N = Between(1, 16);
   #local C = Between(0.005, 0.1);
   #local Distance = F*TL_mm*Between(3, 500);
   #write (Out, "number depth: ", vstr(5, <TL_mm, F, N, C, Distance>, " ", 0, 17), " = ",
      vstr(3, <TL_Hyperfocal(F, N, C), TL_Near(Distance, F, N, C), TL_Far(Distance, F, N, C)>, " ", 0, 17), "\n")
   // At most 72 degrees from the sensor (asin of 1.1*sqrt(3)/2), 20 F away: the hinge lies 20 F/tan 72 or more from the lens, beyond F.
   #local Location = Anywhere(100*TL_mm);
   #local Axis = vnormalize(Anywhere(1));
   #local Normal = vnormalize(Axis + 1.1*Anywhere(1));
   #local Point = Location + Between(20, 60)*F*TL_mm*Axis + Anywhere(F*TL_mm);
   #local Look_At = Location + 37*TL_mm*Axis;
   #write (Out, "number plane: ", vstr(4, <TL_mm, F, N, C>, " ", 0, 17), " ", Many(Location), " ", Many(Axis), " ", Many(Point), " ", Many(Normal), " = ",
      vstr(2, <TL_Lens_Tilt(Location, Look_At, Point, Normal, F), TL_Image_Distance(Location, Look_At, Point, Normal, F)>, " ", 0, 17), " ",
      Many(TL_Wedge(Location, Look_At, Point, Normal, F, N, C)), " ", Many(TL_Wedge(Location, Look_At, Point, Normal, F, N, -C)), "\n")
   // The objects: a point on each side of each plane.
   #local Near = TL_Near_Plane(Location, Look_At, Point, Normal, F, N, C)
   #local Q = TL_Wedge(Location, Look_At, Point, Normal, F, N, C);
   #local On = Location + Q/vdot(Q, Q);
   #if ((inside(Near, Location + 0.999*(On - Location)) = 0) | (inside(Near, Location + 1.001*(On - Location)) != 0))
      #error "TL_Near_Plane is not where TL_Wedge says.\n"
   #end
#end
#fclose Out
camera { perspective }
