# Table 2 through each lens that a calibration has: the thin one and the real one for scenes. Mean brightness error, photograph
# against render, with one gain (--match gain), of 255.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<this folder> -DOUT= [-DSAMPLES=64] -P lenses.cmake
#
# OUT receives calibration/, a folder for each lens and lenses.md. Any step that fails ends it.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/tables.cmake")
need(TILTCAL POVRAY SCENE OUT)
defaults(SAMPLES=64)
include("${CMAKE_CURRENT_LIST_DIR}/steps.cmake")

set(thin_title "thin, with its bowl and rims")
set(thin_words 0)
set(real_title "real, for scenes")
set(real_words 1)
set(real_pose --real-lens)

calibrate_boxes("${OUT}/calibration")
table_head(table lens ${STATES})
foreach(lens thin real)
	say("${${lens}_title}")
	file(MAKE_DIRECTORY "${OUT}/${lens}")
	place_boxes("${OUT}/calibration" ${${lens}_pose})
	set(cells "${${lens}_title}")
	foreach(state IN LISTS STATES)
		render_boxes("${OUT}/calibration" ${state} "${OUT}/${lens}/${state}.exr" ${SAMPLES} log Declare=TiltCal_Real_Lens=${${lens}_words})
		compare_boxes(${state} "${OUT}/${lens}/${state}.exr" gain "${OUT}/${lens}/${state}.json" "${OUT}/${lens}/${state}")
		line_errors("${OUT}/${lens}/${state}.json" errors)
		list(APPEND cells "${errors}")
	endforeach()
	set(row "")
	table_row(row ${cells})
	string(APPEND table "${row}")
	message("${row}")
endforeach()
file(WRITE "${OUT}/lenses.md" "${table}")
message("${table}\nwritten to ${OUT}/lenses.md")
