# What each effect of the calibrated lens does to Table 2: mean brightness error, photograph against render, with one gain
# (--match gain), from no effect to all.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<this folder> -DOUT= [-DSAMPLES=128] -P effect-shares.cmake
#
# OUT receives a folder for each set of effects and shares.md. Any step that fails ends it.
cmake_minimum_required(VERSION 3.25)
foreach(name TILTCAL POVRAY SCENE OUT)
	if(NOT DEFINED ${name})
		message(FATAL_ERROR "effect-shares.cmake needs -D${name}=...")
	endif()
endforeach()
if(NOT DEFINED SAMPLES)
	set(SAMPLES 128)
endif()

include("${CMAKE_CURRENT_LIST_DIR}/steps.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/summary.cmake") # line_error

# One more at a time; the last is what tiltcal chooses by itself.
set(SETS none distortion distortion,field_curvature distortion,field_curvature,vignetting_natural auto)
set(none_title "none")
set(distortion_title "distortion")
set(distortion,field_curvature_title "… and field curvature")
set(distortion,field_curvature,vignetting_natural_title "… and natural vignetting")
set(auto_title "… and rims before and behind the lens: all that is significant")

set(table "| effects | untilted | plus5 | minus5 |\n|---|---|---|---|\n")
foreach(effects IN LISTS SETS)
	message("[effect-shares] ${effects}")
	string(REPLACE "," "+" folder "${OUT}/${effects}")
	calibrate_boxes("${folder}/calibration" --effects ${effects})
	place_boxes("${folder}/calibration")
	set(row "| ${${effects}_title} |")
	foreach(state IN LISTS STATES)
		render_boxes("${folder}/calibration" ${state} "${folder}/${state}.exr" ${SAMPLES} log)
		compare_boxes(${state} "${folder}/${state}.exr" gain "${folder}/${state}.json" "${folder}/${state}")
		line_error("${folder}/${state}.json" 0 red)
		line_error("${folder}/${state}.json" 1 green)
		string(APPEND row " ${red} / ${green} |")
	endforeach()
	string(APPEND table "${row}\n")
	message("${row}")
endforeach()
file(WRITE "${OUT}/shares.md" "${table}")
message("${table}\nwritten to ${OUT}/shares.md")
