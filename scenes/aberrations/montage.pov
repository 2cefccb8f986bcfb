// The contact sheet: six frames of aberrations.pov, aberration1.png to aberration6.png, three across, each above its cause: rays from
// the lens to the sensor, or what one point becomes. The rays are drawn by the formulas of povray-patch/lens/MODEL.md, larger than life.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Files = array[6] { "aberration1.png", "aberration2.png", "aberration3.png", "aberration4.png", "aberration5.png", "aberration6.png" };
#declare Words = array[6] { "ideal lens", "spherical 1.1: bubbles", "spherical -1.6: soft behind", "spherical -3, in focus: glow", "coma -12: tails", "astigmatism 40, two rims: swirl" };
background { rgb 0.02 }

#macro Line(A, B, Colour)
	cylinder { A, B, 0.045 pigment { rgb Colour } finish { emission 1 diffuse 0 ambient 0 } }
#end
#macro Shade(T) (<0.25, 0.5, 1> + (<1, 0.5, 0.15> - <0.25, 0.5, 1>)*T) #end

// Rays of a light beyond the focus (Before = share of the way at which the middle meets) from points of the lens; the rim's, in orange, meet
// farther or nearer by the spherical aberration. The bar at the end is the sensor.
#macro Fan(S, Before)
	#for (I, -6, 6)
		#local Q = I/6;
		#local End = 11;
		Line(<0, 1.8*Q, 0>, <End, 1.8*(Q*(1 - 1/Before) + S*pow(Q, 3)), 0>, Shade(Q*Q))
	#end
	Line(<0, -2, -0.1>, <0, 2, -0.1>, 0.7)
	Line(<11, -2, -0.1>, <11, 2, -0.1>, 0.7)
#end

// What the zones of the opening make of one point: circles, larger and farther out by the square.
#macro Flare(S)
	#for (I, 1, 6)
		#local Rho = I/6;
		torus { 1.35*Rho*Rho, 0.045 rotate x*90 translate <3.2 + S*2.7*Rho*Rho, 0, 0> pigment { rgb Shade(Rho*Rho) } finish { emission 1 diffuse 0 ambient 0 } }
	#end
	sphere { <3.2, 0, 0>, 0.12 pigment { rgb 1 } finish { emission 1 diffuse 0 ambient 0 } }
#end

// The opening as the picture's corners see it: rims before and behind it leave a cat's eye, across the radius; astigmatism stretches it.
#macro Eyes()
	#for (K, 0, 11)
		intersection {
			cylinder { -z, z, 0.75 translate -0.3*x }
			cylinder { -2*z, 2*z, 0.75 translate 0.3*x }
			scale <0.45, 0.75, 0.01>
			rotate z*30*K
			translate <4*cos(radians(30*K)), 1.5*sin(radians(30*K)), 0>
			pigment { rgb <0.6, 0.9, 0.3> } finish { emission 0.8 diffuse 0 ambient 0 }
		}
	#end
	cylinder { -0.01*z, 0.01*z, 0.5 pigment { rgb <0.6, 0.9, 0.3> } finish { emission 0.8 diffuse 0 ambient 0 } }
#end

#for (I, 0, 5)
	union {
		box { 0, <1, 1, 0.01> pigment { image_map { png Files[I] once interpolate 2 } } finish { ambient 1 diffuse 0 } scale <16, 12, 1> }
		text { ttf "cyrvetic.ttf" Words[I] 0.01, 0 scale 0.95 translate <0.3, -0.95, -0.5> pigment { rgb 0.9 } finish { ambient 1 diffuse 0 } }
		union {
			#switch (I)
				#case (0) Fan(0, 0.7) #break
				#case (1) Fan(0.14, 0.7) #break
				#case (2) Fan(-0.3, 0.7) #break
				#case (3) Fan(-0.35, 1) #break
				#case (4) union { Flare(1) translate 2*x } #break
				#case (5) union { Eyes() translate 5.5*x } #break
			#end
			translate <2.5, -3.3, -0.5>
		}
		translate <16.4*mod(I, 3), -18.2*int(I/3), 0>
	}
#end
camera { orthographic location <24.4, -6.1, -10> direction z right 49.2*x up 36.6*y }
