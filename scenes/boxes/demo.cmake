# The whole chain on the photographs of photos/: calibrate, render, compare, summarise.
#
#   cmake -DTILTCAL= -DPOVRAY= -DEXR2PNG= -DSCENE=<this folder> -DOUT= [-DSAMPLES=64] -P demo.cmake
#
# OUT receives calibration/, render-<state>.exr and .png, side-by-side-<state>.png, profile-<state>.png and .csv
# and summary.md. Any step that fails ends the demo.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/summary.cmake")

foreach(name TILTCAL POVRAY EXR2PNG SCENE OUT)
	if(NOT DEFINED ${name})
		message(FATAL_ERROR "demo.cmake needs -D${name}=...")
	endif()
endforeach()
if(NOT DEFINED SAMPLES)
	set(SAMPLES 64)
endif()

set(STATES untilted plus5 minus5) # boxes.pov numbers them so
set(RED_LINE 0,660,1799,660)
set(GREEN_LINE 900,0,900,1199)
string(TIMESTAMP started "%s" UTC)

macro(step text)
	string(TIMESTAMP now "%s" UTC)
	math(EXPR seconds "${now} - ${started}")
	message("[demo ${seconds} s] ${text}")
endmacro()

file(MAKE_DIRECTORY "${OUT}/calibration")

step("calibrating from 18 photographs of the board")
execute_process(
	COMMAND "${TILTCAL}" calibrate --board 12x9 --square 25 --pitch 0.02
		--untilted "${SCENE}/photos/target/untilted-*.jpg"
		--tilted "plus5=${SCENE}/photos/target/plus5-*.jpg"
		--tilted "minus5=${SCENE}/photos/target/minus5-*.jpg"
		--out "${OUT}/calibration"
	COMMAND_ERROR_IS_FATAL ANY)

set(number 0)
foreach(state IN LISTS STATES)
	step("rendering the boxes, ${state}: 1800 x 1200, ${SAMPLES} lens samples per pixel")
	# +V alone on the console: POV-Ray's own progress. Statistics, with the Tilt lens block, go to a file.
	execute_process(
		COMMAND "${POVRAY}" "+I${SCENE}/boxes.pov" "+L${SCENE}" "+L${OUT}/calibration" +W1800 +H1200
			"Declare=State=${number}" "Declare=Samples=${SAMPLES}" -D -A +WT2 +V -GA +GF
			"+GS${OUT}/render-${state}.txt" +FE "+O${OUT}/render-${state}.exr"
		COMMAND_ERROR_IS_FATAL ANY)
	execute_process(COMMAND "${EXR2PNG}" "${OUT}/render-${state}.exr" "${OUT}/render-${state}.png" COMMAND_ERROR_IS_FATAL ANY)
	math(EXPR number "${number} + 1")
endforeach()

foreach(state IN LISTS STATES)
	step("comparing photograph and render, ${state}")
	foreach(match gain shading) # shading last: its picture and plot stay
		execute_process(
			COMMAND "${TILTCAL}" profile "${SCENE}/photos/scene/${state}.jpg" "${OUT}/render-${state}.exr"
				--line ${RED_LINE} --line ${GREEN_LINE} --match ${match}
				--json "${OUT}/profile-${state}-${match}.json" --out "${OUT}/profile-${state}-${match}"
			OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
	endforeach()
endforeach()

step("summary")
write_summary("${OUT}" "${STATES}")
file(READ "${OUT}/summary.md" text)
message("\n${text}")
step("done; everything is in ${OUT}")
