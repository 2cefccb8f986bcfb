# What each effect of the calibrated lens does to Table 2: mean brightness error, photograph against render, with one gain
# (--match gain), from no effect to all.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENE=<this folder> -DOUT= [-DSAMPLES=128] -P effect-shares.cmake
#
# OUT receives a folder for each set of effects and shares.md. Any step that fails ends it.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/summary.cmake") # line_error

foreach(name TILTCAL POVRAY SCENE OUT)
	if(NOT DEFINED ${name})
		message(FATAL_ERROR "effect-shares.cmake needs -D${name}=...")
	endif()
endforeach()
if(NOT DEFINED SAMPLES)
	set(SAMPLES 128)
endif()

set(STATES untilted plus5 minus5) # boxes.pov numbers them so
# One more at a time; the last is what tiltcal chooses by itself.
set(SETS none distortion distortion,field_curvature distortion,field_curvature,vignetting_natural auto)
set(none_title "none")
set(distortion_title "distortion")
set(distortion,field_curvature_title "… and field curvature")
set(distortion,field_curvature,vignetting_natural_title "… and natural vignetting")
set(auto_title "… and the second rim: all that is significant")

set(table "| effects | untilted | plus5 | minus5 |\n|---|---|---|---|\n")
foreach(effects IN LISTS SETS)
	message("[effect-shares] ${effects}")
	string(REPLACE "," "+" folder "${OUT}/${effects}")
	file(MAKE_DIRECTORY "${folder}")
	execute_process(
		COMMAND "${TILTCAL}" calibrate --board 12x9 --square 25 --pitch 0.02 --effects ${effects}
			--untilted "${SCENE}/photos/target/untilted-*.jpg" --tilted "plus5=${SCENE}/photos/target/plus5-*.jpg"
			--tilted "minus5=${SCENE}/photos/target/minus5-*.jpg" --out "${folder}/calibration"
		OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
	set(row "| ${${effects}_title} |")
	set(number 0)
	foreach(state IN LISTS STATES)
		execute_process(
			COMMAND "${POVRAY}" "+I${SCENE}/boxes.pov" "+L${SCENE}" "+L${folder}/calibration" +W1800 +H1200
				Declare=State=${number} Declare=TiltCal_Blur_Samples=${SAMPLES} -D -A +FE "+O${folder}/${state}.exr"
			OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
		execute_process(
			COMMAND "${TILTCAL}" profile "${SCENE}/photos/scene/${state}.jpg" "${folder}/${state}.exr" --line 0,660,1799,660
				--line 900,0,900,1199 --match gain --json "${folder}/${state}.json" --out "${folder}/${state}"
			OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
		line_error("${folder}/${state}.json" 0 red)
		line_error("${folder}/${state}.json" 1 green)
		string(APPEND row " ${red} / ${green} |")
		math(EXPR number "${number} + 1")
	endforeach()
	string(APPEND table "${row}\n")
	message("${row}")
endforeach()
file(WRITE "${OUT}/shares.md" "${table}")
message("${table}\nwritten to ${OUT}/shares.md")
