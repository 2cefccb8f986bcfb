# The steps that the demo, its experiments and the tests share. Needs TILTCAL, POVRAY and SCENE (this folder).
#
# calibrate_boxes(FOLDER [tiltcal options])      FOLDER/camera-<state>.inc, calibration.json
# place_boxes(FOLDER [PHOTO] [--thin-lens|--real-lens])   FOLDER/pose.inc: where the untilted photograph says the camera stood
# render_boxes(FOLDER STATE EXR SAMPLES LOG [POV-Ray options])
# compare_boxes(STATE EXR MATCH JSON OUT)        along the red and the green line
# table_2_row(TABLE TITLE CAMERAS FOLDER SAMPLES [POV-Ray options])   a row of Table 2 (cmake/tables.cmake), its pictures in FOLDER
# Any step that fails ends the script, with what the program said.
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")

set(STATES untilted plus5 minus5) # boxes.pov numbers them so
set(RED_LINE 0,660,1799,660)
set(GREEN_LINE 900,0,900,1199)
set(DEMO_OPTIONS Declare=TiltCal_Denoise=1) # what is subtracted from a render of the demo needs the same grain
if(NOT DEFINED PHOTOS)
	set(PHOTOS "${SCENE}/photos")
endif()
if(NOT DEFINED PHOTO_SUFFIX)
	set(PHOTO_SUFFIX jpg)
endif()

# The commands of the steps, which paper.cmake runs on other photographs and with logs.
function(calibrate_command result photographs suffix folder)
	set(${result} "${TILTCAL}" calibrate --board 12x9 --square 25 --pitch 0.02 ${ARGN} --untilted "${photographs}/untilted-*.${suffix}"
		--tilted "plus5=${photographs}/plus5-*.${suffix}" --tilted "minus5=${photographs}/minus5-*.${suffix}" --out "${folder}" PARENT_SCOPE)
endfunction()

function(render_command result scene_file cameras state samples exr)
	get_filename_component(scene_folder "${scene_file}" DIRECTORY)
	list(FIND STATES "${state}" number)
	set(${result} "${POVRAY}" "+I${scene_file}" "+L${scene_folder}" "+L${cameras}" +W1800 +H1200 Declare=State=${number}
		Declare=TiltCal_Blur_Samples=${samples} -D -A +FE ${ARGN} "+O${exr}" PARENT_SCOPE)
endfunction()

function(compare_command result photo exr match json out)
	set(${result} "${TILTCAL}" profile "${photo}" "${exr}" --line ${RED_LINE} --line ${GREEN_LINE}
		--match ${match} --json "${json}" --out "${out}" PARENT_SCOPE)
endfunction()

function(calibrate_boxes folder)
	file(MAKE_DIRECTORY "${folder}")
	calibrate_command(command "${PHOTOS}/target" ${PHOTO_SUFFIX} "${folder}" ${ARGN})
	# Straight to the terminal: it shows its own progress and report.
	execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(place_boxes folder)
	set(through ${ARGN})
	list(FILTER through INCLUDE REGEX "^--")
	set(photo "${PHOTOS}/scene/untilted.${PHOTO_SUFFIX}" ${ARGN})
	list(FILTER photo EXCLUDE REGEX "^--")
	list(GET photo -1 photo)
	run(COMMAND "${TILTCAL}" pose --calibration "${folder}/calibration.json" --state untilted --points "${SCENE}/points.csv"
		--photo "${photo}" ${through} --overlay "${folder}/pose-points.png" --out "${folder}/pose.inc")
endfunction()

function(render_boxes folder state exr samples log)
	render_command(command "${SCENE}/boxes.pov" "${folder}" ${state} ${samples} "${exr}" ${ARGN})
	run(SAID text COMMAND ${command})
	set(${log} "${text}" PARENT_SCOPE)
endfunction()

function(compare_boxes state exr match json out)
	compare_command(command "${PHOTOS}/scene/${state}.${PHOTO_SUFFIX}" "${exr}" ${match} "${json}" "${out}")
	run(COMMAND ${command})
endfunction()

function(table_2_row its_table title cameras folder samples)
	file(MAKE_DIRECTORY "${folder}")
	set(cells "${title}")
	foreach(state IN LISTS STATES)
		render_boxes("${cameras}" ${state} "${folder}/${state}.exr" ${samples} log ${ARGN})
		compare_boxes(${state} "${folder}/${state}.exr" gain "${folder}/${state}.json" "${folder}/${state}")
		line_errors("${folder}/${state}.json" errors)
		list(APPEND cells "${errors}")
	endforeach()
	set(row "")
	table_row(row ${cells})
	message("${row}")
	set(${its_table} "${${its_table}}${row}" PARENT_SCOPE)
endfunction()
