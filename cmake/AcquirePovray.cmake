# Brings the pinned POV-Ray archive to DESTINATION (a folder), from the first of:
#   SOURCE, a path the user gave (an archive, or a folder that holds one);
#   the distribution's source package;
#   the upstream URL.
# Only an archive with the pinned SHA-256 is taken.
#
#   cmake -DDESTINATION=... [-DSOURCE=...] -P AcquirePovray.cmake

cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/PovrayPin.cmake")
set(archive "${DESTINATION}/${POVRAY_ARCHIVE}")

function(take_if_genuine file from)
	set(taken FALSE PARENT_SCOPE)
	if(NOT EXISTS "${file}" OR IS_DIRECTORY "${file}")
		return()
	endif()
	file(SHA256 "${file}" sum)
	if(NOT sum STREQUAL POVRAY_SHA256)
		message(STATUS "POV-Ray: ${file} is not the pinned archive (SHA-256 ${sum})")
		return()
	endif()
	if(NOT file STREQUAL archive)
		file(COPY_FILE "${file}" "${archive}.part")
		file(RENAME "${archive}.part" "${archive}")
	endif()
	message(STATUS "POV-Ray: source archive from ${from}, SHA-256 as pinned")
	set(taken TRUE PARENT_SCOPE)
endfunction()

take_if_genuine("${archive}" "an earlier build")
if(taken)
	return()
endif()
file(MAKE_DIRECTORY "${DESTINATION}")

if(SOURCE)
	set(candidates "${SOURCE}")
	if(IS_DIRECTORY "${SOURCE}")
		file(GLOB candidates "${SOURCE}/povray*.tar.gz" "${SOURCE}/v${POVRAY_VERSION}.tar.gz")
	endif()
	foreach(candidate IN LISTS candidates)
		take_if_genuine("${candidate}" "${candidate}")
		if(taken)
			return()
		endif()
	endforeach()
	message(FATAL_ERROR "POVRAY_SOURCE=${SOURCE}: no POV-Ray ${POVRAY_VERSION} source archive with SHA-256 "
		"${POVRAY_SHA256} there. Give the unmodified archive (${POVRAY_ARCHIVE} or v${POVRAY_VERSION}.tar.gz) or its folder.")
endif()

find_program(APT_GET apt-get)
if(APT_GET)
	message(STATUS "POV-Ray: asking the distribution for its source package")
	set(download "${DESTINATION}/apt")
	execute_process(
		COMMAND sh "${CMAKE_CURRENT_LIST_DIR}/fetch-source-package.sh" povray "${download}"
		RESULT_VARIABLE result OUTPUT_VARIABLE log ERROR_VARIABLE log)
	if(NOT result EQUAL 0)
		message(STATUS "POV-Ray: no source package from apt:\n${log}")
	endif()
	take_if_genuine("${download}/${POVRAY_ARCHIVE}" "the distribution's source package")
	file(REMOVE_RECURSE "${download}")
	if(taken)
		return()
	endif()
endif()

message(STATUS "POV-Ray: downloading ${POVRAY_URL}")
file(DOWNLOAD "${POVRAY_URL}" "${archive}.download" STATUS status INACTIVITY_TIMEOUT 60)
list(GET status 0 code)
if(code EQUAL 0)
	take_if_genuine("${archive}.download" "${POVRAY_URL}")
endif()
file(REMOVE "${archive}.download")
if(NOT taken)
	message(FATAL_ERROR "POV-Ray ${POVRAY_VERSION}: no source. Bring ${POVRAY_ARCHIVE} (SHA-256 ${POVRAY_SHA256}) here and configure "
		"with -DPOVRAY_SOURCE=/path/to/it.")
endif()
