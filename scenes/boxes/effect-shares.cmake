# What each effect of the calibrated lens does to Table 2: mean brightness error, photograph against render, with one gain
# (--match gain), from no effect to all of a thin lens, and to the real one.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<this folder> -DOUT= [-DSAMPLES=128] -P effect-shares.cmake
#
# OUT receives a folder for each set of effects and shares.md. Any step that fails ends it.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/tables.cmake")
need(TILTCAL POVRAY SCENE OUT)
defaults(SAMPLES=128)
include("${CMAKE_CURRENT_LIST_DIR}/steps.cmake")

# One more at a time; the last is what tiltcal chooses by itself, for which it finds the real lens too.
set(SETS none distortion distortion,field_curvature distortion,field_curvature,vignetting_natural auto)
set(none_title "none")
set(distortion_title "distortion")
set(distortion,field_curvature_title "… and field curvature")
set(distortion,field_curvature,vignetting_natural_title "… and natural vignetting")
set(auto_title "… and rims before and behind the lens: all that is significant")

table_head(table effects ${STATES})
foreach(effects IN LISTS SETS)
	say("${effects}")
	string(REPLACE "," "+" folder "${OUT}/${effects}")
	calibrate_boxes("${folder}/calibration" --effects ${effects})
	place_boxes("${folder}/calibration" --thin-lens)
	table_2_row(table "${${effects}_title}" "${folder}/calibration" "${folder}" ${SAMPLES} Declare=TiltCal_Real_Lens=0)
endforeach()
say("the real lens")
place_boxes("${OUT}/auto/calibration")
table_2_row(table "the real lens instead" "${OUT}/auto/calibration" "${OUT}/real" ${SAMPLES})
file(WRITE "${OUT}/shares.md" "${table}")
message("${table}\nwritten to ${OUT}/shares.md")
