# scenes/composition, small: with nothing put in the photograph comes back as it was, with the dragon it does not.
#
#   cmake -DTILTCAL= -DPOVRAY= -DCOMPARE=<compare_pictures> -DSCENES= -DCALIBRATION= -DWORK= -P composition.cmake
cmake_minimum_required(VERSION 3.25)
include("${SCENES}/cmake/script.cmake")
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(width 150)
set(height 100)

# photograph(STATE): the photograph alone, at the places of the same pixels.
function(photograph state)
	file(WRITE "${WORK}/${state}.pov" "#version 3.7; global_settings { assumed_gamma 1 }
box { 0, <1, 1, 0.01> pigment { image_map { jpeg \"${state}.jpg\" once } } finish { emission 1 diffuse 0 ambient 0 } }
camera { orthographic location <0.5, 0.5, -1> direction z right x up y }\n")
	run(COMMAND "${POVRAY}" "+I${WORK}/${state}.pov" "+L${SCENES}/boxes/photos/scene" -D -A +W${width} +H${height} +FE "+O${WORK}/${state}.exr")
endfunction()

# composed(STATE PUT_IN): OUT/composed.exr.
function(composed state put_in)
	execute_process(
		COMMAND "${CMAKE_COMMAND}" "-DTILTCAL=${TILTCAL}" "-DPOVRAY=${POVRAY}" "-DSCENES=${SCENES}" "-DCALIBRATION=${CALIBRATION}"
			"-DOUT=${WORK}/${state}-${put_in}" -DSTATE=${state} -DWIDTH=${width} -DSAMPLES=8 -DPUT_IN=${put_in} -DPICTURE=composed.exr
			-P "${SCENES}/composition/composition.cmake"
		COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(state plus5 minus5)
	photograph(${state})
	composed(${state} 0)
	# Half floats hold eleven bits, twice: 0.0004 RMS.
	execute_process(COMMAND "${COMPARE}" rms 0.0008 "${WORK}/${state}.exr" "${WORK}/${state}-0/composed.exr" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# The dragon and its shadow cover a twentieth of the picture.
composed(plus5 1)
execute_process(COMMAND "${COMPARE}" differ 0.03 "${WORK}/plus5.exr" "${WORK}/plus5-1/composed.exr" COMMAND_ERROR_IS_FATAL ANY)
