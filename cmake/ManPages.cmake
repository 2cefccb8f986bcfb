# Man pages, made at build time from the programs' own --help, or the table of words, and from hand-written frames.

set(man_folder "${CMAKE_BINARY_DIR}/share/man/man1")
file(MAKE_DIRECTORY "${man_folder}")
set(TILTCAL_SUBCOMMANDS target detect calibrate pose profile lens export import undistort project unproject)

# add_man_page(PROGRAM FRAME [SUBCOMMAND...]): FRAME becomes PROGRAM.1.
function(add_man_page program frame)
	set(page "${man_folder}/${program}.1")
	set(script "${PROJECT_SOURCE_DIR}/cmake/make-man-page.sh")
	add_custom_command(OUTPUT "${page}"
		COMMAND sh "${script}" "$<TARGET_FILE:${program}>" "${frame}" "${page}" ${ARGN}
		DEPENDS ${program} "${frame}" "${script}" "${PROJECT_SOURCE_DIR}/cmake/help-to-man.awk"
		COMMENT "Man page of ${program}" VERBATIM)
	set_property(GLOBAL APPEND PROPERTY tilt_lens_man_pages "${page}")
endfunction()

add_man_page(tiltcal "${PROJECT_SOURCE_DIR}/calib/man/tiltcal.1.in" ${TILTCAL_SUBCOMMANDS})
# A script is no target: the target that puts it into its place is cluster-programs.
set(cluster_source "${PROJECT_SOURCE_DIR}/povray-patch/cluster")
foreach(script strips:povray-strips batch:tiltcal-batch)
	string(REGEX MATCH "(.*):(.*)" script "${script}")
	set(program "${CMAKE_MATCH_2}")
	add_custom_command(OUTPUT "${man_folder}/${program}.1"
		COMMAND sh "${PROJECT_SOURCE_DIR}/cmake/make-man-page.sh" "${CMAKE_BINARY_DIR}/bin/${program}" "${cluster_source}/man/${program}.1.in" "${man_folder}/${program}.1"
		DEPENDS cluster-programs "${cluster_source}/lib/${CMAKE_MATCH_1}_options.py" "${cluster_source}/man/${program}.1.in" "${PROJECT_SOURCE_DIR}/cmake/make-man-page.sh"
			"${PROJECT_SOURCE_DIR}/cmake/help-to-man.awk"
		COMMENT "Man page of ${program}" VERBATIM)
	set_property(GLOBAL APPEND PROPERTY tilt_lens_man_pages "${man_folder}/${program}.1")
endforeach()
add_man_page(tiltcost "${PROJECT_SOURCE_DIR}/povray-patch/tiltcost/man/tiltcost.1.in")
get_property(man_pages GLOBAL PROPERTY tilt_lens_man_pages)
add_custom_target(man-pages ALL DEPENDS ${man_pages})

# This one is POV-Ray's own: hand-written but for the words of tilt_lens, which come from the table that the parser has.
add_executable(words_page EXCLUDE_FROM_ALL "${PROJECT_SOURCE_DIR}/povray-patch/man/words_page.cpp")
target_link_libraries(words_page PRIVATE tilt_lens_core tilt_lens_warnings)
set_target_properties(words_page PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/povray-patch")
set(frame "${PROJECT_SOURCE_DIR}/povray-patch/man/povray-tilt.1.in")
set(page "${man_folder}/povray-tilt.1")
add_custom_command(OUTPUT "${page}"
	COMMAND words_page "${PROJECT_VERSION}" < "${frame}" > "${page}"
	DEPENDS words_page "${frame}"
	COMMENT "Man page of povray-tilt" VERBATIM)
add_custom_target(povray-man-page ALL DEPENDS "${page}")
if(TARGET povray)
	list(APPEND man_pages "${page}")
endif()
install(FILES ${man_pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
