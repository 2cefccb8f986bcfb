// The plans of the three pictures, as the paper's Fig. 8 has them: Declare=Case=1 untilted, 2 tilted, 3 oblique.
// Seen from above, the scene's depth to the right. The lines are the traces of the planes at the height of the lens, so the
// planes of sensor, lens and focus meet in one point (Scheimpflug); lens and sensor are in their true places.
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Case) #declare Case = 2; #end
#declare Paper = 1;
#include "dragons.inc"

#switch (Case)
	#case (1) #declare P = Upright_Plane[0]; #declare N = Upright_Plane[1]; #declare Title = "(a) untilted"; #break
	#case (2) #declare P = Heads_Plane[0]; #declare N = Heads_Plane[1]; #declare Title = "(b) tilted"; #break
	#case (3) #declare P = Oblique_Plane[0]; #declare N = Oblique_Plane[1]; #declare Title = "(c) oblique"; #break
#end

// The optics, in the world: q . (X - Eye) = 1 is the plane of focus, n/f = q + axis/w.
#declare Axis = vnormalize(Aim - Eye);
#declare Right = vnormalize(vcross(y, Axis));
#declare Slope = tan(radians(View_Angle/2));      // of the picture's edge
#declare W = 0.5*16/9/Slope;                      // image distance: the window is 16/9 wide
#declare Q = N/vdot(N, P - Eye);
#declare Lens_Normal = vnormalize(Q + Axis/W);

#macro Flat(V) (V*(x + z)) #end
#declare Level = 8;
#macro Stroke(A, B, Width, Colour)
	cylinder { Flat(A) + Level*y, Flat(B) + Level*y, Width/2 pigment { Colour } finish { ambient 1 diffuse 0 } no_shadow }
#end
#macro Dashes(A, B, Width, Colour)
	#local L = vlength(Flat(B - A));
	#for (I, 0, L/0.5)
		Stroke(A + (B - A)*0.5*I/L, A + (B - A)*min(0.5*I + 0.26, L)/L, Width, Colour)
	#end
#end
#macro Label(Text, Place, Size, Colour)   // level with the page, its start at Place
	text {
		ttf "cyrvetic.ttf" Text 0.01, 0
		rotate 90*x rotate -90*y scale Size translate Flat(Place) + (Level + 0.5)*y
		scale <1, 1, 1>
		pigment { Colour } finish { ambient 1 diffuse 0 } no_shadow
	}
#end
// Where the trace of a plane through Through with normal Normal crosses the depth Z, at the lens's height.
#macro Trace_At(Through, Normal, Z)
	<Through.x - (Normal.y*(Eye.y - Through.y) + Normal.z*(Z - Through.z))/Normal.x, Eye.y, Z>
#end
#macro Wedge(V0, V1, Colour)              // the directions between two slopes of the middle row
	triangle {
		Flat(Eye) + 0.02*y, Flat(Eye + 36*(Axis + V0*Right)) + 0.02*y, Flat(Eye + 36*(Axis + V1*Right)) + 0.02*y
		pigment { Colour } finish { ambient 0.9 diffuse 0 } no_shadow
	}
#end

#declare Ink = rgb <0.04, 0.05, 0.08>;
#declare Focus_Ink = rgb <0.80, 0.05, 0.10>;
#declare Lens_Ink = rgb <0.02, 0.25, 0.70>;
#declare Front_Ink = rgb <0.72, 0.86, 0.74>;
#declare Behind_Ink = rgb <0.93, 0.72, 0.66>;
plane { y, 0 pigment { rgb <0.86, 0.84, 0.79> } finish { ambient 0.95 diffuse 0 } }

// Frustum, and its part whose focus is behind the lens: kappa = q . v along the middle row, zero at Critical.
#declare Kappa_Left = vdot(Q, Axis - Slope*Right);
#declare Kappa_Right = vdot(Q, Axis + Slope*Right);
#if (Kappa_Left*Kappa_Right < 0)
	#declare Critical = -vdot(Q, Axis)/vdot(Q, Right);
	Wedge(-Slope, Critical, Behind_Ink)
	Wedge(Critical, Slope, Front_Ink)
	Dashes(Eye, Eye + 36*(Axis + Critical*Right), 0.07, Ink)
	Label("focus behind the lens", <-3.5, 0, -0.4>, 0.85, Focus_Ink)
	Label("focus in front", <2.3, 0, -7.6>, 0.85, rgb <0.05, 0.30, 0.10>)
#else
	Wedge(-Slope, Slope, Front_Ink)
#end
#for (Sign, -1, 1, 2)
	Stroke(Eye, Eye + 36*(Axis + Sign*Slope*Right), 0.08, Ink)
	Stroke(Eye, Eye - W*(Axis + Sign*Slope*Right), 0.08, Ink)
#end
Dashes(Eye - W*Axis, Eye + 36*Axis, 0.07, Ink)

// Sensor, lens, plane of focus.
#declare Sensor = Eye - W*Axis;
Stroke(Sensor - W*Slope*Right, Sensor + W*Slope*Right, 0.22, Ink)
#declare Lens_Line = vnormalize(vcross(y, Lens_Normal));
sphere { 0, 1 scale <1.1, 0.3, 0.24> rotate degrees(atan2(-Lens_Line.z, Lens_Line.x))*y translate Flat(Eye) + Level*y
	pigment { Lens_Ink } finish { ambient 1 diffuse 0 } no_shadow }
#if (Case = 1)
	Stroke(<-11, 0, P.z>, <11, 0, P.z>, 0.14, Focus_Ink)
	Label("plane of focus", <-9.4, 0, P.z + 0.4>, 0.85, Focus_Ink)
#else
	Stroke(Trace_At(P, N, -26), Trace_At(P, N, 20), 0.14, Focus_Ink)
	// Where the planes of sensor and lens meet, at this height.
	#declare A = Axis;
	#declare B = Lens_Normal;
	#declare Ka = vdot(A, Sensor) - A.y*Eye.y;
	#declare Kb = vdot(B, Eye) - B.y*Eye.y;
	#declare D = A.x*B.z - A.z*B.x;
	#declare Meet = <(Ka*B.z - A.z*Kb)/D, 0, (A.x*Kb - Ka*B.x)/D>;
	Dashes(Sensor, Meet, 0.08, Ink)
	Dashes(Eye, Meet, 0.08, Lens_Ink)
	sphere { Flat(Meet) + Level*y, 0.16 pigment { Focus_Ink } finish { ambient 1 diffuse 0 } no_shadow }
	#if (Case = 2)
		Label("plane of focus", <-8.3, 0, -12.2>, 0.85, Focus_Ink)
	#else
		Label("plane of focus", <7.9, 0, -10.5>, 0.85, Focus_Ink)
	#end
#end
Label("sensor", Sensor + <0.25, 0, -3.3>, 0.85, Ink)
Label("lens", Eye + <2.1, 0, 0.1>, 0.85, Lens_Ink)
Label(Title, <9.6, 0, 3.2>, 1.0, Ink)
#for (I, 0, 2)
	torus { 0.34, 0.07 translate Flat(Head[I]) + Level*y pigment { Focus_Ink } finish { ambient 1 diffuse 0 } no_shadow }
#end

camera {
	orthographic
	location <0, 40, -4.4>
	direction -y
	right 44*z
	up -24.75*x
}
