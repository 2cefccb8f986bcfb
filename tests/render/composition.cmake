# scenes/composition, small: with nothing put in the photograph comes back as it was, with the dragon it does not.
#
#   cmake -DTILTCAL= -DPOVRAY= -DCOMPARE=<compare_pictures> -DSCENES= -DCALIBRATION= -DWORK= -P composition.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(width 150)
set(height 100)

# The photograph alone, at the places of the same pixels.
file(WRITE "${WORK}/photo.pov" "#version 3.7; global_settings { assumed_gamma 1 }
box { 0, <1, 1, 0.01> pigment { image_map { jpeg \"plus5.jpg\" once } } finish { emission 1 diffuse 0 ambient 0 } }
camera { orthographic location <0.5, 0.5, -1> direction z right x up y }\n")
execute_process(
	COMMAND "${POVRAY}" "+I${WORK}/photo.pov" "+L${SCENES}/boxes/photos/scene" -D -A +W${width} +H${height} +FE "+O${WORK}/photo.exr"
	OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE failed)
if(failed)
	message(FATAL_ERROR "${log}")
endif()

foreach(put_in 0 1)
	execute_process(
		COMMAND "${CMAKE_COMMAND}" "-DTILTCAL=${TILTCAL}" "-DPOVRAY=${POVRAY}" "-DSCENES=${SCENES}" "-DCALIBRATION=${CALIBRATION}"
			"-DOUT=${WORK}/put-in-${put_in}" -DWIDTH=${width} -DSAMPLES=8 -DPUT_IN=${put_in} -DPICTURE=composed.exr
			-P "${SCENES}/composition/composition.cmake"
		COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# Half floats hold eleven bits, twice: 0.0004 RMS. The dragon and its shadow cover a twentieth of the picture.
execute_process(COMMAND "${COMPARE}" rms 0.0008 "${WORK}/photo.exr" "${WORK}/put-in-0/composed.exr" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${COMPARE}" differ 0.03 "${WORK}/photo.exr" "${WORK}/put-in-1/composed.exr" COMMAND_ERROR_IS_FATAL ANY)
