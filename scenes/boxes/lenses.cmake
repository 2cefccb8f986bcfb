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

calibrate_boxes("${OUT}/calibration")
table_head(table lens ${STATES})
say("thin")
place_boxes("${OUT}/calibration" --thin-lens)
table_2_row(table "thin, with its bowl and rims" "${OUT}/calibration" "${OUT}/thin" ${SAMPLES} Declare=TiltCal_Real_Lens=0)
say("real")
place_boxes("${OUT}/calibration" --real-lens)
table_2_row(table "real, for scenes" "${OUT}/calibration" "${OUT}/real" ${SAMPLES} Declare=TiltCal_Real_Lens=1)
file(WRITE "${OUT}/lenses.md" "${table}")
message("${table}\nwritten to ${OUT}/lenses.md")
