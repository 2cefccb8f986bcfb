# Includes run one way only: a room includes itself, the rooms before it in its CMakeLists's list, the public headers and
# the lens library. Also: every room has a README.md, includes of our own name their room, and the rooms that other programs get as a
# library print nothing.
#
#   cmake -DROOT=... -DROOMS=base,picture,... -DLIBRARY_ROOMS=base,... -P rooms.cmake

cmake_minimum_required(VERSION 3.25)
string(REPLACE "," ";" rooms "${ROOMS}")
string(REPLACE "," ";" library_rooms "${LIBRARY_ROOMS}")
set(faults "")
set(seen 0)

# Every folder of calib is a room of the list, or has the man pages, the public headers or the Python module.
file(GLOB folders RELATIVE "${ROOT}/calib" "${ROOT}/calib/*/")
foreach(folder IN LISTS folders)
	if(IS_DIRECTORY "${ROOT}/calib/${folder}" AND NOT folder IN_LIST rooms AND NOT folder MATCHES "^(include|man|python)$")
		string(APPEND faults "calib/${folder}: is no room of calib/CMakeLists.txt\n")
	endif()
endforeach()
list(JOIN rooms "|" known)
set(known "tiltcal|lens|tilt_lens|${known}")

# One folder's files, each include of which must begin with one of `allowed`.
function(check_folder folder allowed)
	file(GLOB files "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
	set(found "${faults}")
	set(seen_before "${seen}")
	foreach(file IN LISTS files)
		file(RELATIVE_PATH name "${ROOT}" "${file}")
		file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]+(\"|<(${known})/)")
		foreach(include IN LISTS includes)
			string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]+)[\">].*$" "\\1" what "${include}")
			string(REGEX REPLACE "/.*$" "" room "${what}")
			math(EXPR seen "${seen} + 1")
			if(what STREQUAL "vfe.h" AND folder STREQUAL "povray-patch/tilt_lens")
				# POV-Ray's front end
			elseif(NOT what MATCHES "/")
				string(APPEND found "${name}: includes \"${what}\": name its room, \"room/${what}\"\n")
			elseif(NOT room IN_LIST allowed)
				list(JOIN allowed ", " text)
				string(APPEND found "${name}: includes ${what}; ${folder} may include ${text}\n")
			endif()
		endforeach()
	endforeach()
	if(seen EQUAL seen_before)
		string(APPEND found "${folder}: no file of it includes anything of ours: does ROOT=${ROOT} hold the sources?\n")
	endif()
	set(faults "${found}" PARENT_SCOPE)
	set(seen "${seen}" PARENT_SCOPE)
	if(NOT EXISTS "${ROOT}/${folder}/README.md")
		set(faults "${found}${folder}: has no README.md\n" PARENT_SCOPE)
	endif()
endfunction()

check_folder(povray-patch/lens "lens")
check_folder(povray-patch/tilt_lens "lens;backend;base")   # the last two are POV-Ray's
check_folder(povray-patch/tiltcost "lens;tiltcal;base;program;plane_page;tiltcost")
check_folder(calib/include/tiltcal "tiltcal;lens")
check_folder(calib/python "tiltcal")
set(allowed "lens;tiltcal")
foreach(room IN LISTS rooms)
	list(APPEND allowed "${room}")
	check_folder("calib/${room}" "${allowed}")
endforeach()

# The library for other programs is quiet, and knows no command line: its inputs stand in backquotes.
list(TRANSFORM library_rooms PREPEND calib/)
foreach(folder IN LISTS library_rooms ITEMS calib/include/tiltcal povray-patch/lens)
	file(GLOB files "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
	foreach(file IN LISTS files)
		file(STRINGS "${file}" lines REGEX "spdlog|fmt::print|[^n]printf\\(|puts\\(|fwrite|perror|std::c(out|err|log)[^a-z]|/proc/|\"[^\"]*--[a-z]")
		if(lines)
			file(RELATIVE_PATH name "${ROOT}" "${file}")
			string(APPEND faults "${name}: prints, or names an option:\n${lines}\n")
		endif()
	endforeach()
endforeach()

if(faults)
	message(FATAL_ERROR "${faults}")
endif()
message(STATUS "${seen} includes, each of an earlier room")
