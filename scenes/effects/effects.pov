// A street at night behind a lantern: what each effect of the lens does to lights out of focus. Frame 1 to 6 of an
// animation, or Declare=Effect=1..6: round, blades, bokeh pigment, natural vignetting, a second rim, chromatic.
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Effect) #declare Effect = max(1, frame_number); #end
#ifndef (Samples) #declare Samples = 1024; #end

#declare Opening = pigment {
	// A heart; lights beyond the focus show the opening as it is, nearer ones turn it upside down.
	function { select(pow(pow(2.4*(x - 0.5), 2) + pow(2.4*(y - 0.45), 2) - 1, 3) - pow(2.4*(x - 0.5), 2)*pow(2.4*(y - 0.45), 3), 1, 0) }
	color_map { [0.5 rgb 0] [0.5 rgb 1] }
}

camera {
	tilt_lens {
		aperture_diameter 1
		denoise
		#switch (Effect)
			#case (2) blades 6 rotation 15 #break
			#case (4) vignetting natural #break
			#case (5) vignetting optical 0.85, 1.6 #break
			#case (6) chromatic lateral 0.006, -0.008 axial -0.012, 0.02 #break
		#end
	}
	location <0, 1.5, -6>
	right x*image_width/image_height
	look_at <0, 1.5, 0>
	angle 46
	#if (Effect = 3) bokeh { pigment { Opening } } #end
	blur_samples 64, Samples
	variance 1e-5
}

// Lights of windows, lamps and cars, far out of focus.
#declare R = seed(11);
#for (I, 1, 46)
	#declare Depth = 14 + 22*rand(R);
	#declare Tone = rand(R);
	sphere {
		<(rand(R) - 0.5)*1.05*Depth, 1.5 + (rand(R) - 0.42)*0.8*Depth, Depth>, 0.011*Depth
		pigment { rgb (Tone < 0.4 ? <1, 0.62, 0.25> : (Tone < 0.6 ? <1, 0.2, 0.12> : (Tone < 0.75 ? <0.35, 0.75, 1> : <1, 0.9, 0.75>))) }
		finish { emission 9*(0.5 + rand(R)) diffuse 0 }
	}
#end
plane { -z, -60 pigment { gradient y color_map { [0 rgb <0.10, 0.08, 0.10>] [1 rgb <0.02, 0.03, 0.07>] } scale 60 translate -20*y } finish { emission 1 diffuse 0 } }

// The lantern in focus, and the wall that it hangs on.
light_source { <0, 1.55, -0.3> rgb <1.2, 0.8, 0.45> fade_distance 1 fade_power 2 }
light_source { <-6, 8, -9> rgb 0.35 }
#declare Iron = texture { pigment { rgb 0.06 } finish { diffuse 0.7 specular 0.4 roughness 0.02 } }
union {
	#for (I, 0, 5)
		cylinder { <0.42, 0.75, 0>, <0.52, 2.15, 0>, 0.035 rotate y*60*I }
	#end
	torus { 0.44, 0.05 translate 0.75*y }
	torus { 0.54, 0.05 translate 2.15*y }
	cone { 2.18*y, 0.62, 2.65*y, 0.08 }
	cylinder { 0.6*y, 0.76*y, 0.46 }
	sphere { 2.72*y, 0.09 }
	cylinder { 2.7*y, 6*y, 0.02 }
	texture { Iron }
}
cone { 0.8*y, 0.38, 2.1*y, 0.48 pigment { rgb <1, 0.72, 0.38> } finish { emission 0.85 diffuse 0.1 } }
