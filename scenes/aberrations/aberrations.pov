// What aberrations do, one at a time: a figure before lights at night, or before leaves, or the lights themselves.
// Frame 1 to 6 of an animation, or Declare=Effect=1..6: the ideal lens; over-corrected and under-corrected spherical aberration behind the
// figure, and on it; coma at night; the swirl of astigmatism and narrow rims.
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Effect) #declare Effect = max(1, frame_number); #end
#ifndef (Samples) #declare Samples = 256; #end

camera {
	tilt_lens {
		aperture_diameter 0.8
		focal_distance (Effect = 5 ? 40 : 6)
		denoise
		#switch (Effect)
			#case (2) aberrations { f_stop 1.6  spherical 1.1 } #break
			#case (3) aberrations { f_stop 1.6  spherical -1.6 } #break
			#case (4) aberrations { f_stop 1.6  spherical -3 } #break
			#case (5) aberrations { f_stop 1.6  coma -12 } #break
			#case (6) aberrations { f_stop 1.6  astigmatism 40 curvature -5 }  vignetting optical 0.5, 0.9, 0.38, -0.7 #break
		#end
	}
	location <0, 1.5, -6>
	right x*image_width/image_height
	look_at <0, 1.5, 0>
	angle 46
	blur_samples 64, Samples
	variance 1e-5
}

#macro Light(Where, Radius, Colour, Power)
	sphere { Where, Radius pigment { rgb Colour } finish { emission Power diffuse 0 ambient 0 } no_shadow }
#end
#declare R = seed(5);

#if (Effect <= 4)
	// Windows, lamps and cars, far out of focus.
	#for (I, 1, 60)
		#local Depth = 14 + 16*rand(R);
		#local Tone = rand(R);
		Light(<(rand(R) - 0.5)*1.05*Depth, 1.5 + (rand(R) - 0.42)*0.8*Depth, Depth>, 0.009*Depth,
			(Tone < 0.45 ? <1, 0.62, 0.25> : (Tone < 0.6 ? <1, 0.2, 0.12> : (Tone < 0.75 ? <0.35, 0.75, 1> : <1, 0.9, 0.75>))), 11*(0.5 + rand(R)))
	#end
	plane { -z, -60 pigment { rgb <0.03, 0.035, 0.06> } finish { emission 1 diffuse 0 } }
#end

#if (Effect = 5)
	// The lights themselves, in focus all over the picture: a far shore, and stars.
	#for (I, 1, 45)
		#local Tone = rand(R);
		Light(<(rand(R) - 0.5)*50, 1.5 + (rand(R)*1.0 + 0.03)*14, 40>, 0.06, (Tone < 0.5 ? <0.8, 0.9, 1> : <1, 0.9, 0.75>), 6 + 22*pow(rand(R), 3))
	#end
	#for (I, 1, 40)
		#local Tone = rand(R);
		#local Where = <(rand(R) - 0.5)*48, 0.9 - 9*pow(rand(R), 2), 40>;
		Light(Where, 0.07, (Tone < 0.6 ? <1, 0.62, 0.25> : (Tone < 0.75 ? <1, 0.25, 0.15> : <0.8, 1, 0.9>)), 22)
	#end
	plane { -z, -60 pigment { gradient y color_map { [0 rgb <0.03, 0.03, 0.05>] [1 rgb <0.006, 0.008, 0.02>] } scale 40 translate -2*y } finish { emission 1 diffuse 0 } }
	// The shore, darker than the sky.
	#for (I, -20, 20)
		box { <I*1.4, -30, 41>, <I*1.4 + 1.4, 1.6 - 1.4*rand(R), 42> pigment { rgb <0.012, 0.012, 0.02> } finish { emission 1 diffuse 0 } }
	#end
#end

#if (Effect = 6)
	// Leaves with the sun behind them.
	#for (I, 1, 900)
		#local Depth = 17 + 9*rand(R);
		#local Bright = pow(rand(R), 5);
		sphere {
			<(rand(R) - 0.5)*1.0*Depth, 1.5 + (rand(R) - 0.5)*0.8*Depth, Depth>, (0.012 + 0.012*rand(R))*Depth
			pigment { rgb <0.16 + 0.25*rand(R), 0.34 + 0.2*rand(R), 0.06> } finish { emission 0.35 + 3.2*Bright diffuse 0 }
		}
	#end
	plane { -z, -40 pigment { rgb <0.04, 0.09, 0.03> } finish { emission 1 diffuse 0 } }
#end

#if (Effect != 5)
	// The figure, in focus.
	light_source { <-5, 7, -9> rgb 0.9 }
	light_source { <6, 4, 2> rgb <1, 0.75, 0.5>*(Effect = 6 ? 0.7 : 1) }
	union {
		lathe { cubic_spline 9 <0, -0.1>, <0.62, 0>, <0.66, 0.12>, <0.42, 0.3>, <0.26, 0.75>, <0.2, 1.15>, <0.34, 1.27>, <0.1, 1.36>, <0, 1.4> }
		sphere { <0, 1.62, 0>, 0.3 }
		texture { pigment { rgb <0.85, 0.8, 0.7> } finish { diffuse 0.75 specular 0.5 roughness 0.01 reflection { 0.02, 0.1 fresnel on } } }
		interior { ior 1.5 }
		translate 0.55*y
		scale 1.1
	}
	box { <-9, -4, -0.9>, <9, 0.6, 0.9> pigment { bozo color_map { [0 rgb <0.16, 0.13, 0.11>] [1 rgb <0.26, 0.21, 0.17>] } scale 0.15 } finish { diffuse 0.7 } }
#end
