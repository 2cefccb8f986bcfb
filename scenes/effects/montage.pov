// The contact sheet: six frames of effects.pov, effect1.png to effect6.png, three across.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Files = array[6] { "effect1.png", "effect2.png", "effect3.png", "effect4.png", "effect5.png", "effect6.png" };
#declare Words = array[6] { "no effect", "blades 6 rotation 15", "bokeh pigment", "vignetting natural", "vignetting optical", "chromatic" };
background { rgb 0.02 }
#for (I, 0, 5)
	union {
		box {
			0, <1, 1, 0.01>
			pigment { image_map { png Files[I] once interpolate 2 } }
			finish { ambient 1 diffuse 0 }
			scale <16, 12, 1>
		}
		text { ttf "cyrvetic.ttf" Words[I] 0.01, 0 scale 1.1 translate <0.4, 0.45, -0.5> pigment { rgb 1 } finish { ambient 1 diffuse 0 } }
		translate <16.2*mod(I, 3), -12.2*int(I/3), 0>
	}
#end
camera { orthographic location <24.2, -0.1, -10> direction z right 48.8*x up 24.6*y }
