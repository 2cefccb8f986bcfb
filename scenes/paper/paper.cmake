# The paper's experiment on the photographs of scenes/boxes/photos: Tables 1 and 2, profiles, differences, and what the difference
# between photograph and render is made of. One page, OUT/report.html; every number in OUT/results.json.
#
#   cmake -DTILTCAL= -DPOVRAY= -DEXR2PNG= -DREPORT=<paper_report> -DSCENES=<scenes> -DOUT= [-DPHOTOS=<folder>]
#         [-DSAMPLES=128] [-DBOARD_SAMPLES=64] [-DEFFECT_SAMPLES=32] [-DCURVE=8,32,128,512] [-DREUSE=1] -P paper.cmake
#
# PHOTOS: a folder with target/ and scene/ (PNG or JPEG) instead of scenes/boxes/photos. REUSE: steps whose result is there are
# not run again; for whoever works on the page. Any step that fails ends the run. paper_run.h says what OUT receives.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")
need(TILTCAL POVRAY EXR2PNG REPORT SCENES OUT)
defaults(SAMPLES=128 BOARD_SAMPLES=64 EFFECT_SAMPLES=32 CURVE=8,32,128,512 REUSE=0)
string(REPLACE "," ";" CURVE "${CURVE}")
set(SCENE "${SCENES}/boxes")
file(MAKE_DIRECTORY "${OUT}")
set(STEP_TIMES "${OUT}/steps.txt")
file(WRITE "${STEP_TIMES}" "")

# has(FILE RESULT): whether a step may be left out.
function(has file result)
	set(${result} 0 PARENT_SCOPE)
	if(REUSE AND EXISTS "${file}")
		set(${result} 1 PARENT_SCOPE)
	endif()
endfunction()

# calibrate(OUT PHOTOGRAPHS SUFFIX OPTIONS...): of the photographs of the board in a folder. What the whole run took, by the clock: OUT/seconds.txt.
function(calibrate out photographs suffix)
	has("${out}/seconds.txt" there)
	if(NOT there)
		calibrate_command(command "${photographs}" ${suffix} "${out}" ${ARGN})
		string(TIMESTAMP begun "%s")
		run(LOG "${out}/log.txt" COMMAND ${command})
		string(TIMESTAMP ended "%s")
		math(EXPR seconds "${ended} - ${begun}")
		file(WRITE "${out}/seconds.txt" "${seconds}\n")
	endif()
endfunction()

# render(SCENE_FILE CALIBRATION STATE SAMPLES SEED PICTURE OPTIONS...): 1800 x 1200, linear, its log beside it.
# tiltcal's camera files have no switch for the seed: those of CALIBRATION are copied with the word in.
function(render scene_file calibration state samples seed picture)
	has("${picture}" there)
	if(there)
		return()
	endif()
	set(cameras "${calibration}")
	if(seed)
		set(cameras "${OUT}/seeded/${seed}")
		file(GLOB files "${calibration}/*.inc")
		foreach(file IN LISTS files)
			file(READ "${file}" text)
			string(REPLACE "tilt_lens {" "tilt_lens {\n\t\tseed ${seed}" seeded "${text}")
			if(seeded STREQUAL text)
				message(FATAL_ERROR "${file}: no tilt_lens block to put the seed into")
			endif()
			get_filename_component(name "${file}" NAME)
			file(WRITE "${cameras}/${name}" "${seeded}")
		endforeach()
	endif()
	get_filename_component(folder "${picture}" DIRECTORY)
	render_command(command "${scene_file}" "${cameras}" ${state} ${samples} "${folder}/part.exr" ${ARGN})
	run(LOG "${picture}.txt" COMMAND ${command})
	file(RENAME "${folder}/part.exr" "${picture}")
endfunction()

# boxes: every render of the boxes but demo.cmake's goes through here. CALIBRATION holds pose.inc.
function(boxes calibration state samples seed picture)
	render("${SCENE}/boxes.pov" "${calibration}" ${state} ${samples} ${seed} "${picture}" ${ARGN})
endfunction()

# compare(PHOTO RENDER FOLDER STATE MATCH): tiltcal profile on the two lines; the numbers in FOLDER/STATE-MATCH.json.
function(compare photo picture folder state match)
	compare_command(command "${photo}" "${picture}" ${match} "${folder}/${state}-${match}.json" "${folder}/${state}-${match}")
	run(LOG "${folder}/${state}-${match}/log.txt" COMMAND ${command})
endfunction()

# boxes_against(PHOTOGRAPHS SUFFIX CALIBRATION SAMPLES SEED PICTURES PROFILES OPTIONS...): all states through that camera, and Table 2's numbers with one gain.
function(boxes_against photographs photo_suffix calibration samples seed pictures profiles)
	foreach(state IN LISTS STATES)
		boxes("${calibration}" ${state} ${samples} ${seed} "${pictures}/${state}.exr" ${ARGN})
		compare("${photographs}/${state}.${photo_suffix}" "${pictures}/${state}.exr" "${profiles}" ${state} gain)
	endforeach()
endfunction()

# photograph(RENDERS LIKE GAIN SEED RESULT): what the sensor and the file format of LIKE would have made of the render, or of the mean of several.
function(photograph pictures like gain seed result)
	has("${result}" there)
	if(NOT there)
		get_filename_component(folder "${result}" DIRECTORY)
		run(LOG "${folder}/log.txt" COMMAND "${REPORT}" photograph ${pictures} --like "${like}" --camera "${SCENES}/boxes/camera.json"
			--gain ${gain} --seed ${seed} --out "${result}")
	endif()
endfunction()

# A folder of the user's photographs becomes that of a copy of the scene; tiltcal tells formats by content, not by suffix.
set(suffix jpg)
if(PHOTOS)
	get_filename_component(PHOTOS "${PHOTOS}" ABSOLUTE)
	file(REMOVE_RECURSE "${OUT}/scene")
	file(COPY "${SCENE}/" DESTINATION "${OUT}/scene" PATTERN photos EXCLUDE)
	set(SCENE "${OUT}/scene")
	foreach(kind target scene)
		file(MAKE_DIRECTORY "${SCENE}/photos/${kind}")
		file(GLOB files "${PHOTOS}/${kind}/*.png" "${PHOTOS}/${kind}/*.jpg")
		if(files STREQUAL "")
			message(FATAL_ERROR "PHOTOS=${PHOTOS}: no *.png or *.jpg in its folder ${kind}")
		endif()
		foreach(file IN LISTS files)
			get_filename_component(name "${file}" NAME_WE)
			get_filename_component(suffix "${file}" LAST_EXT)
			string(SUBSTRING "${suffix}" 1 -1 suffix)
			file(CREATE_LINK "${file}" "${SCENE}/photos/${kind}/${name}.jpg" SYMBOLIC)
		endforeach()
	endforeach()
	if(EXISTS "${PHOTOS}/truth.json")
		file(COPY_FILE "${PHOTOS}/truth.json" "${SCENE}/photos/truth.json")
	endif()
endif()
set(photos "${SCENE}/photos")
set(PHOTOS "${photos}")
include("${SCENES}/boxes/steps.cmake") # STATES, which boxes.pov and board.pov number so; place_boxes; DEMO_OPTIONS

step("the demo: calibration, three renders of ${SAMPLES} samples a pixel, profiles")
has("${OUT}/demo/summary.md" there)
if(NOT there)
	execute_process(COMMAND "${CMAKE_COMMAND}" "-DTILTCAL=${TILTCAL}" "-DPOVRAY=${POVRAY}" "-DEXR2PNG=${EXR2PNG}" "-DSCENE=${SCENE}"
		"-DOUT=${OUT}/demo" -DSAMPLES=${SAMPLES} -P "${SCENES}/boxes/demo.cmake" OUTPUT_FILE "${OUT}/demo.log" COMMAND_ERROR_IS_FATAL ANY)
endif()
set(calibration "${OUT}/demo/calibration")
foreach(state IN LISTS STATES)
	file(READ "${OUT}/demo/profiles/${state}-gain.json" json)
	string(JSON gain_${state} GET "${json}" shading coefficients 0)
endforeach()

step("Table 1: the models one by one, and photometric refinement")
calibrate("${OUT}/models/paper" "${photos}/target" jpg --model paper --effects none)
calibrate("${OUT}/models/rigid" "${photos}/target" jpg --model rigid)
calibrate("${OUT}/models/plane" "${photos}/target" jpg --model plane)
calibrate("${OUT}/models/curved" "${photos}/target" jpg --model curved)
calibrate("${OUT}/models/photometric" "${photos}/target" jpg --model curved --refine photometric)
calibrate("${OUT}/models/default" "${photos}/target" jpg)

step("sampling noise: the renders again with another seed")
foreach(state IN LISTS STATES)
	boxes("${calibration}" ${state} ${SAMPLES} 1 "${OUT}/seed1/${state}.exr" ${DEMO_OPTIONS})
endforeach()

# Of the mean of both seeds: compression takes some of a render's grain off, which a photograph has not got.
step("the photographs' own noise: the renders through sensor and file format")
set(number 0)
foreach(state IN LISTS STATES)
	photograph("${OUT}/demo/render-${state}.exr;${OUT}/seed1/${state}.exr" "${photos}/scene/${state}.jpg" ${gain_${state}} ${number} "${OUT}/noise/${state}.${suffix}")
	math(EXPR number "${number} + 1")
endforeach()

step("sampling noise and time over samples: a tenth of the picture plus5, about the red line")
foreach(count IN LISTS CURVE)
	foreach(seed 0 1)
		boxes("${calibration}" plus5 ${count} ${seed} "${OUT}/curve/${count}-${seed}.exr" +SR601 +ER720)
	endforeach()
endforeach()

step("closed loop: the calibrated camera photographs the board in every pose, ${BOARD_SAMPLES} samples a pixel")
set(closed "${OUT}/closed")
set(number 0)
foreach(state IN LISTS STATES)
	file(GLOB board_photos "${photos}/target/${state}-*.jpg")
	list(LENGTH board_photos count)
	foreach(photo RANGE 1 ${count})
		has("${closed}/photos/${state}-${photo}.${suffix}" there)
		if(NOT there)
			math(EXPR seed "1000 * (${number} + 1) + ${photo}") # no two pictures with the same grain
			render("${SCENES}/board/board.pov" "${calibration}" ${state} ${BOARD_SAMPLES} ${seed} "${closed}/board.exr" Declare=Photo=${photo})
			list(GET board_photos 0 like)
			photograph("${closed}/board.exr" "${like}" ${gain_${state}} ${seed} "${closed}/photos/${state}-${photo}.${suffix}")
			file(REMOVE "${closed}/board.exr")
		endif()
	endforeach()
	math(EXPR number "${number} + 1")
endforeach()

step("closed loop: calibrating from these")
calibrate("${closed}/calibration" "${closed}/photos" ${suffix})

step("closed loop: the boxes through the camera found, placed by the closed loop's own photograph of them")
place_boxes("${closed}/calibration" "${OUT}/noise/untilted.${suffix}")
boxes_against("${OUT}/noise" ${suffix} "${closed}/calibration" ${SAMPLES} 2 "${closed}" "${closed}/profiles" ${DEMO_OPTIONS})

step("what a thin lens cannot know: Table 2 with fewer effects, ${EFFECT_SAMPLES} samples a pixel")
has("${OUT}/effects/shares.md" there)
if(NOT there)
	run(LOG "${OUT}/effects/log.txt" COMMAND "${CMAKE_COMMAND}" "-DTILTCAL=${TILTCAL}" "-DPOVRAY=${POVRAY}" "-DSCENE=${SCENE}" "-DOUT=${OUT}/effects"
		-DSAMPLES=${EFFECT_SAMPLES} -P "${SCENES}/boxes/effect-shares.cmake")
endif()

step("the boxes through the camera of the paper's method")
place_boxes("${OUT}/models/paper")
boxes_against("${photos}/scene" jpg "${OUT}/models/paper" ${EFFECT_SAMPLES} 0 "${OUT}/paper-method" "${OUT}/paper-method")

step("the ablation, difference pictures")
string(REPLACE ";" "," curve "${CURVE}")
execute_process(COMMAND "${REPORT}" measure --out "${OUT}" --photos "${photos}" --camera "${SCENES}/boxes/camera.json" --suffix ${suffix}
	--samples ${SAMPLES} --board-samples ${BOARD_SAMPLES} --effect-samples ${EFFECT_SAMPLES} --curve ${curve} COMMAND_ERROR_IS_FATAL ANY)
step("the page")
execute_process(COMMAND "${REPORT}" page --out "${OUT}" COMMAND_ERROR_IS_FATAL ANY)
say("done: ${OUT}/report.html")
