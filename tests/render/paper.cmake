# scenes/paper, every step of it, with few samples, nine photographs of the board and few edges of each.
#
#   cmake -DTILTCAL= -DPOVRAY= -DEXR2PNG= -DREPORT=<paper_report> -DCHECK=<paper_check> -DSCENES= -DWORK= -P paper.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")

# Three photographs a state are what a calibration needs to compare models; as a folder of the user's they prove -DPHOTOS too.
file(GLOB photos "${SCENES}/boxes/photos/target/*-[246].jpg")
file(COPY ${photos} DESTINATION "${WORK}/photos/target")
file(COPY "${SCENES}/boxes/photos/scene/" DESTINATION "${WORK}/photos/scene")
# paper.cmake calibrates eleven times; all edges of a photograph take longer and say no more of the script. Forty of them are too few
# here: the principal point is then off by several pixels.
file(WRITE "${WORK}/tiltcal" "#!/bin/sh
case $1 in
	calibrate) exec '${TILTCAL}' \"$@\" --edges-per-photo 60 ;;
	*) exec '${TILTCAL}' \"$@\" ;;
esac
")
file(CHMOD "${WORK}/tiltcal" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)

execute_process(
	COMMAND "${CMAKE_COMMAND}" "-DTILTCAL=${WORK}/tiltcal" "-DPOVRAY=${POVRAY}" "-DEXR2PNG=${EXR2PNG}" "-DREPORT=${REPORT}" "-DSCENES=${SCENES}"
		"-DOUT=${WORK}/out" "-DPHOTOS=${WORK}/photos" -DSAMPLES=32 -DBOARD_SAMPLES=32 -DEFFECT_SAMPLES=8 -DCURVE=4,16
		-P "${SCENES}/paper/paper.cmake"
	COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CHECK}" "${WORK}/out" COMMAND_ERROR_IS_FATAL ANY)
