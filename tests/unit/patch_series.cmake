# The series applies to a fresh copy of the pinned source, and applying it again
# leaves every file, and its time, alone (otherwise make would rebuild).
include("${MODULE_DIR}/PovrayPin.cmake")
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")

macro(apply)
	execute_process(
		COMMAND "${CMAKE_COMMAND}" "-DARCHIVE=${BUILD}/${POVRAY_ARCHIVE}" "-DWORK=${WORK}" "-DPATCH_DIR=${PATCH_DIR}"
			-P "${MODULE_DIR}/PatchPovray.cmake"
		COMMAND_ERROR_IS_FATAL ANY)
endmacro()

apply()
file(STRINGS "${WORK}/patched-files.txt" patched)
list(LENGTH patched count)
if(count LESS 5)
	message(FATAL_ERROR "only ${count} files were patched; the series looks empty")
endif()
foreach(name IN LISTS patched)
	file(SHA256 "${WORK}/pristine/${name}" before)
	file(SHA256 "${WORK}/src/${name}" after)
	if(before STREQUAL after)
		message(FATAL_ERROR "${name} is in the series but was not changed")
	endif()
	file(TIMESTAMP "${WORK}/src/${name}" time_${name} "%s")
endforeach()
execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 1.1)
apply()
foreach(name IN LISTS patched)
	file(TIMESTAMP "${WORK}/src/${name}" again "%s")
	if(NOT again STREQUAL time_${name})
		message(FATAL_ERROR "${name} was written again although nothing changed")
	endif()
endforeach()
file(REMOVE_RECURSE "${WORK}")
