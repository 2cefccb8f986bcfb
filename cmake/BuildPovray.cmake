# Acquires, patches, configures and makes POV-Ray, each step only where needed,
# and lays out STAGE/bin, STAGE/share and STAGE/etc so that it runs from there.
#
#   cmake -DWORK=... -DSTAGE=... -DPATCH_DIR=... -DLENS_LIBRARY=... -DFLAGS=... [-DSOURCE=...] [-DCCACHE=...]
#         [-DCXX=...] [-DCC=...] [-DOWN_FLAGS=...] [-DPROFILE=...] -P BuildPovray.cmake
#
# LENS_LIBRARY: the archive of PATCH_DIR/lens, which CMake has made.
# OWN_FLAGS: further flags for tilt_lens/*.cpp and for linking, not for upstream's sources.
# PROFILE: a folder for what GCC learns of POV-Ray at work; POV-Ray is built twice then (ProfilePovray.cmake).

cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/PovrayPin.cmake")
set(src "${WORK}/src")

execute_process(
	COMMAND "${CMAKE_COMMAND}" "-DDESTINATION=${WORK}" "-DSOURCE=${SOURCE}" -P "${CMAKE_CURRENT_LIST_DIR}/AcquirePovray.cmake"
	COMMAND_ERROR_IS_FATAL ANY)
execute_process(
	COMMAND "${CMAKE_COMMAND}" "-DARCHIVE=${WORK}/${POVRAY_ARCHIVE}" "-DWORK=${WORK}" "-DPATCH_DIR=${PATCH_DIR}"
		-P "${CMAKE_CURRENT_LIST_DIR}/PatchPovray.cmake"
	COMMAND_ERROR_IS_FATAL ANY)

if(PROFILE)
	include("${CMAKE_CURRENT_LIST_DIR}/ProfilePovray.cmake")
endif()

# Optimisation flags are ours, not configure's: its -ffast-math may not be had in a
# program that promises to handle infinities, nor -march=native in one whose
# pictures are to be the same on every machine. SDL draws the preview window.
set(options --disable-optimiz --disable-optimiz-arch --disable-strip --with-boost-thread=boost_thread --with-libsdl)

# What configure's answer depends on: the flags, its options, where lens/ is and the list of source files.
file(GLOB ours RELATIVE "${PATCH_DIR}" "${PATCH_DIR}/tilt_lens/*.cpp")
set(wanted "${FLAGS}|${options}|${CXX}|${CC}|${CCACHE}|${PATCH_DIR}|${LENS_LIBRARY}|${ours}")
if(OWN_FLAGS)
	string(APPEND wanted "|${OWN_FLAGS}")
endif()
set(configured "")
if(EXISTS "${WORK}/configured.txt")
	file(READ "${WORK}/configured.txt" configured)
endif()

# make does not know that its flags have changed.
set(compiled "")
if(EXISTS "${WORK}/compiled.txt")
	file(READ "${WORK}/compiled.txt" compiled)
endif()
if(compiled AND NOT compiled STREQUAL "${FLAGS}|${OWN_FLAGS}|${CXX}|${CC}")
	file(GLOB_RECURSE objects "${src}/*.o" "${src}/*.a")
	file(REMOVE ${objects} "${src}/unix/povray")
endif()
file(WRITE "${WORK}/compiled.txt" "${FLAGS}|${OWN_FLAGS}|${CXX}|${CC}")

if(NOT configured STREQUAL wanted)
	message(STATUS "POV-Ray: configuring (log in ${WORK}/configure.log)")
	execute_process(COMMAND ./prebuild.sh WORKING_DIRECTORY "${src}/unix"
		RESULT_VARIABLE result OUTPUT_FILE "${WORK}/prebuild.log" ERROR_FILE "${WORK}/prebuild.log")
	if(NOT result EQUAL 0)
		message(FATAL_ERROR "POV-Ray's prebuild.sh failed; see ${WORK}/prebuild.log")
	endif()
	execute_process(
		COMMAND "${CMAKE_COMMAND}" -E env ASAN_OPTIONS=detect_leaks=0 # configure's test programs leak
			./configure "COMPILED_BY=the tilt-lens project" NON_REDISTRIBUTABLE_BUILD=yes
			${options}
			"LIBS=-lboost_system -lboost_thread" "CPPFLAGS=-I${PATCH_DIR}" "CXXFLAGS=${FLAGS}" "CFLAGS=${FLAGS}" "LDFLAGS=${OWN_FLAGS}"
			"CXX=${CCACHE} ${CXX}" "CC=${CCACHE} ${CC}"
		WORKING_DIRECTORY "${src}"
		RESULT_VARIABLE result OUTPUT_FILE "${WORK}/configure.log" ERROR_FILE "${WORK}/configure.log")
	if(NOT result EQUAL 0)
		message(FATAL_ERROR "POV-Ray's configure failed; see ${WORK}/configure.log")
	endif()
	file(STRINGS "${WORK}/configure.log" missing REGEX "Unsupported image formats: +[a-z]")
	if(missing)
		message(FATAL_ERROR "POV-Ray would lack picture formats:${missing}. Run cmake/setup.sh and try again.")
	endif()
	file(STRINGS "${WORK}/configure.log" windowless REGEX "X Window display: +disabled")
	if(windowless)
		message(WARNING "POV-Ray: no SDL 1.2, so +D will show nothing. Run cmake/setup.sh and build again for the preview window.")
	endif()
	# GNU make prefers these files to configure's Makefiles. The program links the lens library, and again when that is newer.
	file(WRITE "${src}/unix/GNUmakefile" "include Makefile\nLIBS += ${LENS_LIBRARY}\npovray: ${LENS_LIBRARY}\n")
	if(OWN_FLAGS)
		file(WRITE "${src}/source/GNUmakefile" "include Makefile\nbackend/tilt_lens/%.o: CXXFLAGS += ${OWN_FLAGS}\n")
	else()
		file(REMOVE "${src}/source/GNUmakefile")
	endif()
	file(WRITE "${WORK}/configured.txt" "${wanted}")
endif()

include(ProcessorCount)
ProcessorCount(cores)
message(STATUS "POV-Ray: making (the first time takes minutes; warnings of upstream's own go to ${WORK}/make.log)")
# Upstream's compile lines are long and its warnings many: show the names only.
execute_process(
	COMMAND make -j${cores} --no-print-directory
	COMMAND tee "${WORK}/make.log"
	COMMAND awk "/^(make|mv |depbase|rm |ranlib)/ { next } match(\$0, /[a-z_0-9]+\\.cpp/) && / -c / { n++; if (n % 10 == 0) { printf \"   POV-Ray: %d files compiled\\n\", n; fflush() } }"
	WORKING_DIRECTORY "${src}" RESULTS_VARIABLE results ERROR_FILE "${WORK}/make-errors.log")
list(GET results 0 result)
if(NOT result EQUAL 0)
	execute_process(COMMAND grep -n -A6 -E "error|\\*\\*\\*" "${WORK}/make-errors.log")
	message(FATAL_ERROR "Building POV-Ray failed; see ${WORK}/make.log and ${WORK}/make-errors.log")
endif()

set(share "${STAGE}/share/povray-3.7")
set(etc "${STAGE}/etc/povray/3.7")
file(MAKE_DIRECTORY "${STAGE}/bin" "${etc}" "${share}")
# By way of a rename: the program may be running.
file(COPY_FILE "${src}/unix/povray" "${STAGE}/bin/povray.new")
file(RENAME "${STAGE}/bin/povray.new" "${STAGE}/bin/povray")
file(COPY "${src}/distribution/include" "${src}/distribution/ini" DESTINATION "${share}")
file(COPY "${PATCH_DIR}/include" DESTINATION "${share}")
file(COPY_FILE "${PATCH_DIR}/config/povray.conf" "${etc}/povray.conf" ONLY_IF_DIFFERENT)
file(COPY_FILE "${PATCH_DIR}/config/povray.ini" "${etc}/povray.ini" ONLY_IF_DIFFERENT)
message(STATUS "POV-Ray: ${STAGE}/bin/povray is up to date")
