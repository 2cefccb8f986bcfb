# The whole chain on the photographs of photos/: calibrate, render, compare, summarise.
#
#   cmake -DTILTCAL= -DPOVRAY= -DEXR2PNG= -DSCENE=<this folder> -DOUT= [-DSAMPLES=128] -P demo.cmake
#
# OUT receives calibration/, render-<state>.exr and .png, side-by-side-<state>.png (photograph left), profile-<state>.png,
# profiles/ (curves as CSV and numbers as JSON for every match) and summary.md. Any step that fails ends the demo.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/summary.cmake")

foreach(name TILTCAL POVRAY EXR2PNG SCENE OUT)
	if(NOT DEFINED ${name})
		message(FATAL_ERROR "demo.cmake needs -D${name}=...")
	endif()
endforeach()
if(NOT DEFINED SAMPLES)
	set(SAMPLES 128)
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
	set(log "${OUT}/render-${state}.txt")
	execute_process(
		COMMAND "${POVRAY}" "+I${SCENE}/boxes.pov" "+L${SCENE}" "+L${OUT}/calibration" +W1800 +H1200
			Declare=State=${number} Declare=TiltCal_Blur_Samples=${SAMPLES} -D -A +FE "+O${OUT}/render-${state}.exr"
		OUTPUT_FILE "${log}" ERROR_FILE "${log}" RESULT_VARIABLE failed)
	file(READ "${log}" text)
	if(failed)
		message(FATAL_ERROR "${text}\nPOV-Ray failed")
	endif()
	if(text MATCHES "\n(Tilt lens[^\n]*\n([^-=\n][^\n]*\n)*)")
		message("${CMAKE_MATCH_1}") # the block of the render statistics
	endif()
	math(EXPR number "${number} + 1")
endforeach()

foreach(state IN LISTS STATES)
	step("comparing photograph and render, ${state}")
	set(photo "${SCENE}/photos/scene/${state}.jpg")
	set(render "${OUT}/render-${state}")
	foreach(match gain shading)
		execute_process(
			COMMAND "${TILTCAL}" profile "${photo}" "${render}.exr" --line ${RED_LINE} --line ${GREEN_LINE} --match ${match}
				--json "${OUT}/profiles/${state}-${match}.json" --out "${OUT}/profiles/${state}-${match}"
			OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
	endforeach()
	file(COPY_FILE "${OUT}/profiles/${state}-shading/profile.png" "${OUT}/profile-${state}.png")
	# Side by side at one brightness: the photograph's exposure is the gain that was just fitted.
	file(READ "${OUT}/profiles/${state}-gain.json" json)
	string(JSON gain GET "${json}" shading coefficients 0)
	execute_process(
		COMMAND "${EXR2PNG}" "${render}.exr" "${render}.png" "${photo}" ${gain} "${OUT}/side-by-side-${state}.png"
		COMMAND_ERROR_IS_FATAL ANY)
endforeach()

step("summary")
write_summary("${OUT}" "${STATES}")
file(READ "${OUT}/summary.md" text)
message("\n${text}")
step("done; everything is in ${OUT}")
