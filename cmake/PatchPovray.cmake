# Brings the source tree to exactly "pristine plus series plus our sources", and
# touches only the files that differ from that, so that make rebuilds only what
# depends on a change. Runs as often as you like.
#
#   cmake -DARCHIVE=... -DWORK=... -DPATCH_DIR=... -P PatchPovray.cmake
#
# WORK/pristine  upstream as it came
# WORK/src       what is built
# WORK/staging   patched copies of the patched files

cmake_minimum_required(VERSION 3.25)

set(pristine "${WORK}/pristine")
set(src "${WORK}/src")
set(staging "${WORK}/staging")

if(NOT EXISTS "${WORK}/extracted.stamp")
	message(STATUS "POV-Ray: unpacking")
	file(REMOVE_RECURSE "${pristine}" "${src}")
	file(ARCHIVE_EXTRACT INPUT "${ARCHIVE}" DESTINATION "${WORK}/unpack")
	file(GLOB top "${WORK}/unpack/*")
	file(RENAME "${top}" "${pristine}")
	file(REMOVE_RECURSE "${WORK}/unpack")
	file(COPY "${pristine}/" DESTINATION "${src}")
	file(TOUCH "${WORK}/extracted.stamp")
endif()

file(STRINGS "${PATCH_DIR}/series" series REGEX "^[^#]")
set(touched "")
foreach(patch IN LISTS series)
	file(STRINGS "${PATCH_DIR}/patches/${patch}" lines REGEX "^\\+\\+\\+ b/")
	foreach(line IN LISTS lines)
		string(REGEX REPLACE "^\\+\\+\\+ b/([^\t]*).*" "\\1" name "${line}")
		list(APPEND touched "${name}")
	endforeach()
endforeach()
list(REMOVE_DUPLICATES touched)

file(REMOVE_RECURSE "${staging}")
foreach(name IN LISTS touched)
	get_filename_component(folder "${staging}/${name}" DIRECTORY)
	file(COPY "${pristine}/${name}" DESTINATION "${folder}")
endforeach()

find_program(PATCH patch REQUIRED)
foreach(patch IN LISTS series)
	execute_process(
		COMMAND "${PATCH}" --strip=1 --fuzz=0 --forward --batch --no-backup-if-mismatch
			--reject-file=- --input "${PATCH_DIR}/patches/${patch}"
		WORKING_DIRECTORY "${staging}"
		RESULT_VARIABLE result OUTPUT_VARIABLE log ERROR_VARIABLE log)
	if(NOT result EQUAL 0 OR log MATCHES "offset|fuzz")
		message(FATAL_ERROR "povray-patch/patches/${patch} does not apply cleanly:\n${log}\nSee povray-patch/README.md, \"How to rebase\".")
	endif()
endforeach()

# Files that an earlier series patched and this one does not go back to pristine.
set(restored "")
if(EXISTS "${WORK}/patched-files.txt")
	file(STRINGS "${WORK}/patched-files.txt" earlier)
	foreach(name IN LISTS earlier)
		if(NOT name IN_LIST touched)
			file(COPY_FILE "${pristine}/${name}" "${src}/${name}" ONLY_IF_DIFFERENT)
			list(APPEND restored "${name}")
		endif()
	endforeach()
endif()
foreach(name IN LISTS touched)
	file(COPY_FILE "${staging}/${name}" "${src}/${name}" ONLY_IF_DIFFERENT)
endforeach()
list(JOIN touched "\n" text)
file(WRITE "${WORK}/patched-files.txt" "${text}\n")

# Our own sources are linked, not copied: an edit is seen by make at once.
file(GLOB ours RELATIVE "${PATCH_DIR}/tilt_lens" "${PATCH_DIR}/tilt_lens/*.h" "${PATCH_DIR}/tilt_lens/*.cpp")
set(linked "${src}/source/backend/tilt_lens")
file(MAKE_DIRECTORY "${linked}")
file(GLOB present RELATIVE "${linked}" "${linked}/*.h" "${linked}/*.cpp")   # not objects, which make keeps there
foreach(name IN LISTS present)
	if(NOT name IN_LIST ours)
		file(REMOVE "${linked}/${name}")
	endif()
endforeach()
foreach(name IN LISTS ours)
	if(NOT EXISTS "${linked}/${name}")
		file(CREATE_LINK "${PATCH_DIR}/tilt_lens/${name}" "${linked}/${name}" SYMBOLIC)
	endif()
endforeach()
