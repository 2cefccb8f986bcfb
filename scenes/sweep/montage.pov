// The contact sheet: six frames of sweep.pov, frame1.png to frame6.png, three across.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Names = array[6] { "frame1.png", "frame2.png", "frame3.png", "frame4.png", "frame5.png", "frame6.png" };
background { rgb 0.02 }
#for (I, 0, 5)
	#declare Door = 62 + 66*I/5;               // as in sweep.pov
	union {
		box {
			0, <1, 1, 0.01>
			pigment { image_map { png Names[I] once interpolate 2 } }
			finish { ambient 1 diffuse 0 }
			scale <16, 9, 1>
		}
		text {
			ttf "cyrvetic.ttf" concat(str(Door, 0, 0), " deg") 0.01, 0
			scale 1.2 translate <0.5, 7.7, -0.5> pigment { rgb 1 } finish { ambient 1 diffuse 0 }
		}
		translate <16.3*mod(I, 3), -9.3*int(I/3), 0>
	}
#end
camera {
	orthographic
	location <24.3, -0.15, -10>
	direction z
	right 49.2*x
	up 18.9*y
}
