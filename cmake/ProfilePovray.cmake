# For BuildPovray.cmake: builds a POV-Ray that counts where it goes, lets it render scenes of the race, small, and
# adds to FLAGS what makes GCC use the counts. PROFILE holds them; they are learnt once, a folder that is removed again.
# Code that these scenes never reach is compiled as without a profile.

set(CCACHE "") # the counts decide what the compiler makes, and are not in its command line

if(NOT EXISTS "${PROFILE}/learnt.txt")
	message(STATUS "POV-Ray: built twice, first to learn where its time goes")
	file(REMOVE_RECURSE "${PROFILE}")
	set(build "")
	foreach(name IN ITEMS WORK PATCH_DIR LENS_LIBRARY SOURCE CXX CC)
		list(APPEND build "-D${name}=${${name}}")
	endforeach()
	execute_process(
		COMMAND "${CMAKE_COMMAND}" ${build} "-DSTAGE=${PROFILE}/stage" "-DFLAGS=${FLAGS} -fprofile-generate=${PROFILE} -fprofile-update=prefer-atomic"
			-P "${CMAKE_CURRENT_LIST_DIR}/BuildPovray.cmake"
		COMMAND_ERROR_IS_FATAL ANY)
	set(scenes "${CMAKE_CURRENT_LIST_DIR}/../tests/accuracy/scenes")
	foreach(scene IN ITEMS plain foliage glass texture shelf floor)
		foreach(denoise IN ITEMS 0 1)
			message(STATUS "POV-Ray: learning from ${scene}.pov")
			execute_process(
				COMMAND "${PROFILE}/stage/bin/povray" "+I${scenes}/${scene}.pov" "+L${scenes}" "+O${PROFILE}/picture.ppm" +FP +W80 +H60 +WT1 -D -A -GA
					Declare=Race_Camera=1 Declare=Race_Max=16 "Declare=Race_Denoise=${denoise}"
				RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
			if(NOT result EQUAL 0)
				message(FATAL_ERROR "POV-Ray could not render ${scene}.pov to learn from it:\n${said}")
			endif()
		endforeach()
	endforeach()
	file(REMOVE_RECURSE "${PROFILE}/stage")
	file(WRITE "${PROFILE}/learnt.txt" "")
endif()

string(APPEND FLAGS " -fprofile-use=${PROFILE} -fprofile-partial-training -fprofile-correction -Wno-missing-profile -Wno-coverage-mismatch")
