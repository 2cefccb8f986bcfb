# The box scene through the two lenses of a calibration, the thin one and the real one for scenes, against the photographs, along the red
# line of Table 2, and through the real one in the picture's corners, where no board stood. Only two rows of cells of 12 pixels about a line are rendered, from which the gain is found.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<scenes/boxes> -DCALIBRATION= -DWORK= -P real_lens.cmake
cmake_minimum_required(VERSION 3.25)

# What was to be reached with the demo's samples, set before it was: 1.0 of 255, of which 0.8 is the photograph's noise.
set(LIMIT 1.0)
# In the corners 2: the goal too. Of the mean over 150 pixels, which noise of 2 of 255 a pixel, in the dark, makes uncertain by 0.16.
set(LIMIT_OF_CORNERS 2.0)
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
# `y`: of a line 12 pixels from the picture's border, between whose rows `first` and `last` all is rendered, numbered from 1.
function(compare_corners state y first last)
	set(cameras "${WORK}/1")
	set(picture "${cameras}/${state}-${y}.exr")
	render_boxes("${cameras}" ${state} "${picture}" ${SAMPLES} log Declare=TiltCal_Real_Lens=1 +SR${first} +ER${last} +WT1)
	run(COMMAND "${TILTCAL}" profile "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}" "${picture}" --line 0,${y},149,${y} --line 1650,${y},1799,${y} --match gain
		--out "${cameras}/${state}-${y}")
	foreach(corner 1 2)
		execute_process(COMMAND awk -F, "NR > 1 { sum += $5 - $4; ++n } END { print sum / n; exit !(sum / n <= ${LIMIT_OF_CORNERS} && sum / n >= -${LIMIT_OF_CORNERS}) }"
			"${cameras}/${state}-${y}/profile-${corner}.csv" OUTPUT_VARIABLE mean OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE outside)
		message("${state}, row ${y}, corner ${corner}: the render is brighter by ${mean} (limit ${LIMIT_OF_CORNERS})")
		if(outside)
			message(SEND_ERROR "too large")
		endif()
	endforeach()
endfunction()
foreach(state IN LISTS STATES)
	compare_corners(${state} 12 1 24)
	compare_corners(${state} 1187 1177 1200)
endforeach()
foreach(state IN LISTS STATES)
	message("${state}: mean error ${error_1_${state}} through the real lens (limit ${LIMIT}), ${error_0_${state}} through the thin one")
	if(NOT error_1_${state} LESS_EQUAL LIMIT OR NOT error_1_${state} LESS error_0_${state})
		message(SEND_ERROR "too large")
	endif()
endforeach()
