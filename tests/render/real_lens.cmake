# The box scene through the two lenses of a calibration, the thin one and the real one for scenes, against the photographs, along the red
# line of Table 2. Only two rows of the cells of 12 pixels about it are rendered, from which the gain is found.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<scenes/boxes> -DCALIBRATION= -DWORK= -P real_lens.cmake
cmake_minimum_required(VERSION 3.25)

# What was to be reached with the demo's samples, set before it was: 1.0 of 255, of which 0.8 is the photograph's noise.
set(LIMIT 1.0)
set(SAMPLES 128)

include("${SCENE}/steps.cmake")
file(REMOVE_RECURSE "${WORK}")
# The real one must be the nearer in every state. The photographs' noise, 0.8 of 255, makes the mean over 1800 pixels uncertain by 0.02.
foreach(real 0 1)
	set(cameras "${WORK}/${real}")
	file(MAKE_DIRECTORY "${cameras}")
	file(COPY "${CALIBRATION}/calibration.json" DESTINATION "${cameras}")
	foreach(state IN LISTS STATES)
		file(COPY "${CALIBRATION}/camera-${state}.inc" DESTINATION "${cameras}")
	endforeach()
	set(through --thin-lens)
	if(real)
		set(through --real-lens)
	endif()
	place_boxes("${cameras}" ${through})
	foreach(state IN LISTS STATES)
		render_boxes("${cameras}" ${state} "${cameras}/${state}.exr" ${SAMPLES} log Declare=TiltCal_Real_Lens=${real} +SR649 +ER672 +WT1)
		run(COMMAND "${TILTCAL}" profile "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}" "${cameras}/${state}.exr" --line ${RED_LINE} --match gain
			--json "${cameras}/${state}.json" --out "${cameras}/${state}")
		file(READ "${cameras}/${state}.json" json)
		string(JSON error_${real}_${state} GET "${json}" lines 0 mean_abs_error)
	endforeach()
endforeach()
foreach(state IN LISTS STATES)
	message("${state}: mean error ${error_1_${state}} through the real lens (limit ${LIMIT}), ${error_0_${state}} through the thin one")
	if(NOT error_1_${state} LESS_EQUAL LIMIT OR NOT error_1_${state} LESS error_0_${state})
		message(SEND_ERROR "too large")
	endif()
endforeach()
