# cmake --install into an empty prefix gives programs that run from there: POV-Ray
# finds its include files beside itself, with nothing of the build folder in its way.
#
#   cmake -DBUILD= -DWORK= -P install.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(WRITE "${WORK}/scene.pov" "#version 3.7;\n#include \"colors.inc\"\nglobal_settings { assumed_gamma 1 }\n"
	"camera { tilt_lens location -5*z look_at 0 }\nsphere { 0, 1 pigment { Red } finish { ambient 1 } }\n")
execute_process(COMMAND "${prefix}/bin/povray" +Iscene.pov +Oscene.png +W40 +H30 -D
	WORKING_DIRECTORY "${WORK}" OUTPUT_FILE "${WORK}/log" ERROR_FILE "${WORK}/log" RESULT_VARIABLE failed)
if(failed OR NOT EXISTS "${WORK}/scene.png")
	file(READ "${WORK}/log" log)
	message(FATAL_ERROR "the installed povray does not run:\n${log}")
endif()
execute_process(COMMAND "${prefix}/bin/tiltcal" --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
if(NOT version MATCHES "tiltcal [0-9]+\\.[0-9]+")
	message(FATAL_ERROR "tiltcal --version printed: ${version}")
endif()
execute_process(COMMAND "${prefix}/bin/tiltcost" --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
if(NOT version MATCHES "tiltcost [0-9]+\\.[0-9]+")
	message(FATAL_ERROR "tiltcost --version printed: ${version}")
endif()
foreach(page tiltcal tiltcost povray-tilt)
	if(NOT EXISTS "${prefix}/share/man/man1/${page}.1")
		message(FATAL_ERROR "no man page ${prefix}/share/man/man1/${page}.1")
	endif()
endforeach()
if(NOT EXISTS "${prefix}/share/tilt-lens/calibration.schema.json")
	message(FATAL_ERROR "no ${prefix}/share/tilt-lens/calibration.schema.json")
endif()
file(REMOVE_RECURSE "${WORK}")
