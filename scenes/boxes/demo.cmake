# The whole chain on the photographs of photos/: calibrate, render, compare, summarise.
#
#   cmake -DTILTCAL= -DPOVRAY= -DEXR2PNG= -DSCENE=<this folder> -DOUT= [-DSAMPLES=128] -P demo.cmake
#
# OUT receives calibration/ (with pose.inc and pose-points.png, the camera's place), render-<state>.exr and .png, side-by-side-<state>.png (photograph left), profile-<state>.png,
# profiles/ (curves as CSV and numbers as JSON for every match) and summary.md. Any step that fails ends the demo.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")
need(TILTCAL POVRAY EXR2PNG SCENE OUT)
defaults(SAMPLES=128)
include("${CMAKE_CURRENT_LIST_DIR}/steps.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/summary.cmake")

step("calibrating from 18 photographs of the board")
calibrate_boxes("${OUT}/calibration")
step("placing the camera by the floor's tiles in the untilted photograph")
place_boxes("${OUT}/calibration")

foreach(state IN LISTS STATES)
	step("rendering the boxes, ${state}: 1800 x 1200, ${SAMPLES} lens samples per pixel, denoised")
	render_boxes("${OUT}/calibration" ${state} "${OUT}/render-${state}.exr" ${SAMPLES} log ${DEMO_OPTIONS})
	file(WRITE "${OUT}/render-${state}.txt" "${log}")
	if(log MATCHES "\n(Tilt lens[^\n]*\n([^-=\n][^\n]*\n)*)")
		message("${CMAKE_MATCH_1}") # the block of the render statistics
	endif()
endforeach()

foreach(state IN LISTS STATES)
	step("comparing photograph and render, ${state}")
	set(photo "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}")
	set(render "${OUT}/render-${state}")
	foreach(match gain shading)
		compare_boxes(${state} "${render}.exr" ${match} "${OUT}/profiles/${state}-${match}.json" "${OUT}/profiles/${state}-${match}")
	endforeach()
	file(COPY_FILE "${OUT}/profiles/${state}-shading/profile.png" "${OUT}/profile-${state}.png")
	# Side by side at one brightness: the photograph's exposure is the gain that was just fitted.
	file(READ "${OUT}/profiles/${state}-gain.json" json)
	string(JSON gain GET "${json}" shading coefficients 0)
	run(COMMAND "${EXR2PNG}" "${render}.exr" "${render}.png" "${photo}" ${gain} "${OUT}/side-by-side-${state}.png")
endforeach()

step("summary")
write_summary("${OUT}" "${STATES}")
file(READ "${OUT}/summary.md" text)
message("\n${text}")
step("done; everything is in ${OUT}")
