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

# One folder's files, each include of which must begin with one of `allowed`.
function(check_folder folder allowed)
	file(GLOB files "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
	set(found "${faults}")
	foreach(file IN LISTS files)
		file(RELATIVE_PATH name "${ROOT}" "${file}")
		file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]+(\"|<(tiltcal|lens)/)")
		foreach(include IN LISTS includes)
			string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]+)[\">].*$" "\\1" what "${include}")
			string(REGEX REPLACE "/.*$" "" room "${what}")
			math(EXPR seen "${seen} + 1")
			if(NOT what MATCHES "/")
				string(APPEND found "${name}: includes \"${what}\": name its room, \"room/${what}\"\n")
			elseif(NOT room IN_LIST allowed)
				list(JOIN allowed ", " text)
				string(APPEND found "${name}: includes ${what}; ${folder} may include ${text}\n")
			endif()
		endforeach()
	endforeach()
	set(faults "${found}" PARENT_SCOPE)
	set(seen "${seen}" PARENT_SCOPE)
	if(NOT EXISTS "${ROOT}/${folder}/README.md")
		set(faults "${found}${folder}: has no README.md\n" PARENT_SCOPE)
	endif()
endfunction()

check_folder(povray-patch/lens "lens")
check_folder(povray-patch/tilt_lens "lens;backend;base")   # the last two are POV-Ray's
check_folder(povray-patch/tiltcost "lens;tiltcal;base;program;tiltcost")
check_folder(calib/include/tiltcal "tiltcal;lens")
set(allowed "lens;tiltcal")
foreach(room IN LISTS rooms)
	list(APPEND allowed "${room}")
	check_folder("calib/${room}" "${allowed}")
endforeach()

# The library for other programs is quiet, and knows no command line: its inputs stand in backquotes.
foreach(room IN LISTS library_rooms)
	file(GLOB files "${ROOT}/calib/${room}/*.h" "${ROOT}/calib/${room}/*.cpp")
	foreach(file IN LISTS files)
		file(STRINGS "${file}" lines REGEX "spdlog|fmt::print|[^n]printf\\(|std::c(out|err|log)\\b|/proc/|\"[^\"]*--[a-z]")
		if(lines)
			file(RELATIVE_PATH name "${ROOT}" "${file}")
			string(APPEND faults "${name}: prints, or names an option:\n${lines}\n")
		endif()
	endforeach()
endforeach()

if(faults)
	message(FATAL_ERROR "${faults}")
endif()
if(seen LESS 300)
	message(FATAL_ERROR "only ${seen} includes were seen: does ROOT=${ROOT} hold the sources?")
endif()
message(STATUS "${seen} includes, each of an earlier room")
