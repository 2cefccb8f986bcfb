# A dragon in a tilted photograph: places the calibrated camera by points of the photograph, renders three passes, combines them.
#
#   cmake -DTILTCAL= -DPOVRAY= -DSCENES=<scenes> -DCALIBRATION=<out of tiltcal calibrate> -DOUT= [-DSTATE=plus5]
#         [-DWIDTH=1800] [-DSAMPLES=128] [-DPUT_IN=1] [-DPICTURE=composed.png] -P composition.cmake
#
# OUT receives pose.inc, pose-points.png, photo.inc, pass0.exr to pass2.exr and the picture. Any step that fails ends it.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/script.cmake")
need(TILTCAL POVRAY SCENES CALIBRATION OUT)
defaults(STATE=plus5 WIDTH=1800 SAMPLES=128 PUT_IN=1 PICTURE=composed.png)
math(EXPR height "${WIDTH} * 2 / 3")
set(here "${SCENES}/composition")
file(MAKE_DIRECTORY "${OUT}")

function(run_povray picture)
	run(FOLDER "${OUT}" COMMAND "${POVRAY}" ${ARGN} "+L${here}" "+L${SCENES}/dragons" "+L${OUT}" "+L${SCENES}/boxes/photos/scene" -D -A
		+W${WIDTH} +H${height} "+O${OUT}/${picture}")
endfunction()

say("${STATE}: placing the camera by points of the photograph")
execute_process(
	COMMAND "${TILTCAL}" pose --calibration "${CALIBRATION}/calibration.json" --state ${STATE} --points "${here}/points-${STATE}.csv"
		--photo "${SCENES}/boxes/photos/scene/${STATE}.jpg" --overlay "${OUT}/pose-points.png" --out "${OUT}/pose.inc"
	COMMAND_ERROR_IS_FATAL ANY)
foreach(pass 0 1 2)
	say("pass ${pass} of 0 to 2: ${WIDTH} x ${height}, ${SAMPLES} samples a pixel")
	run_povray(pass${pass}.exr "+I${here}/pass.pov" +FE Declare=Pass=${pass} Declare=Put_In=${PUT_IN} Declare=TiltCal_Blur_Samples=${SAMPLES})
endforeach()
say("combining")
set(format "")
if(PICTURE MATCHES "\\.exr$")
	set(format +FE)
elseif(PICTURE MATCHES "\\.jpg$")
	set(format +FJ90)
endif()
# POV-Ray 3.7 declares no strings on its command line.
file(WRITE "${OUT}/photo.inc" "#declare Photo_File = \"${STATE}.jpg\";\n")
run_povray("${PICTURE}" "+I${here}/combine.pov" ${format})
say("written to ${OUT}/${PICTURE}")
