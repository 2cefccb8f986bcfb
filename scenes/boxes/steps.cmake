# The steps that the demo, its experiments and the tests share. Needs TILTCAL, POVRAY and SCENE (this folder).
#
# calibrate_boxes(FOLDER [tiltcal options])      FOLDER/camera-<state>.inc, calibration.json
# place_boxes(FOLDER [PHOTO])                    FOLDER/pose.inc: where the untilted photograph says the camera stood
# render_boxes(FOLDER STATE EXR SAMPLES LOG [POV-Ray options])
# compare_boxes(STATE EXR MATCH JSON OUT)        along the red and the green line
# Any step that fails ends the script, with what the program said.

set(STATES untilted plus5 minus5) # boxes.pov numbers them so
set(RED_LINE 0,660,1799,660)
set(GREEN_LINE 900,0,900,1199)
if(NOT DEFINED PHOTOS)
	set(PHOTOS "${SCENE}/photos")
endif()
if(NOT DEFINED PHOTO_SUFFIX)
	set(PHOTO_SUFFIX jpg)
endif()

function(run_step what output)
	execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE failed)
	if(failed)
		message(FATAL_ERROR "${text}\n${what} failed")
	endif()
	set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(calibrate_boxes folder)
	file(MAKE_DIRECTORY "${folder}")
	# Straight to the terminal: it shows its own progress and report.
	execute_process(
		COMMAND "${TILTCAL}" calibrate --board 12x9 --square 25 --pitch 0.02 ${ARGN}
			--untilted "${PHOTOS}/target/untilted-*.${PHOTO_SUFFIX}"
			--tilted "plus5=${PHOTOS}/target/plus5-*.${PHOTO_SUFFIX}"
			--tilted "minus5=${PHOTOS}/target/minus5-*.${PHOTO_SUFFIX}"
			--out "${folder}"
		COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(place_boxes folder)
	set(photo "${PHOTOS}/scene/untilted.${PHOTO_SUFFIX}" ${ARGN})
	list(GET photo -1 photo)
	run_step("placing the camera" ignored
		"${TILTCAL}" pose --calibration "${folder}/calibration.json" --state untilted --points "${SCENE}/points.csv"
		--photo "${photo}" --overlay "${folder}/pose-points.png" --out "${folder}/pose.inc")
endfunction()

function(render_boxes folder state exr samples log)
	list(FIND STATES "${state}" number)
	run_step("rendering ${state}" text
		"${POVRAY}" "+I${SCENE}/boxes.pov" "+L${SCENE}" "+L${folder}" +W1800 +H1200 Declare=State=${number}
		Declare=TiltCal_Blur_Samples=${samples} -D -A ${ARGN} +FE "+O${exr}")
	set(${log} "${text}" PARENT_SCOPE)
endfunction()

function(compare_boxes state exr match json out)
	run_step("comparing ${state}" ignored
		"${TILTCAL}" profile "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}" "${exr}" --line ${RED_LINE} --line ${GREEN_LINE}
		--match ${match} --json "${json}" --out "${out}")
endfunction()
