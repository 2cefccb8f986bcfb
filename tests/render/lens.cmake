# The box scene through the photographs' glass, which `tiltcal lens` makes a camera of without a photograph, against the photographs, along
# the red line of Table 2. Only two rows of the cells of 12 pixels about it are rendered, from which the gain is found.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<scenes/boxes> -DWORK= -P lens.cmake
cmake_minimum_required(VERSION 3.25)

# The goal of Table 2 for a camera that was calibrated, which one made of the glass itself may not miss either. Of that the photographs' noise is 0.8;
# 512 samples, so that grain, which adds by squares, is little of the rest.
set(LIMIT 1.0)
set(SAMPLES 512)

include("${SCENE}/steps.cmake")
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
run(COMMAND "${TILTCAL}" lens "${SCENE}/double-gauss.txt" --focal-length 45 --f-number 2.8 --focus 618 --state untilted --state plus5:tilt=5
	--state minus5:tilt=-5 --out "${WORK}/cameras")
foreach(state IN LISTS STATES)
	render_command(command "${SCENE}/boxes.pov" "${WORK}/cameras" ${state} ${SAMPLES} "${WORK}/${state}.exr" Declare=Placed=0 +SR649 +ER672 +WT1)
	run(COMMAND ${command})
	run(COMMAND "${TILTCAL}" profile "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}" "${WORK}/${state}.exr" --line ${RED_LINE} --match gain --json "${WORK}/${state}.json"
		--out "${WORK}/${state}")
	file(READ "${WORK}/${state}.json" json)
	string(JSON error GET "${json}" lines 0 mean_abs_error)
	message("${state}: mean error ${error} (limit ${LIMIT})")
	if(NOT error LESS_EQUAL LIMIT)
		message(SEND_ERROR "too large")
	endif()
endforeach()
