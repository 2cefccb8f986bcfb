# Run by CPack on what it is about to pack. The programs and what they look for beside themselves stay in
# /usr/lib/povray-tilt; configuration goes to /etc, shared files, documents and man pages to /usr/share, and links join them.

set(root "${CPACK_TEMPORARY_DIRECTORY}")
set(source "${CPACK_TILT_LENS_SOURCE}")
set(private "${root}/usr/lib/povray-tilt")
set(doc "${root}/usr/share/doc/povray-tilt")
if(NOT EXISTS "${private}/bin/povray")
	message(FATAL_ERROR "${private}/bin/povray: nothing was installed to pack; build first (cmake --build --preset package)")
endif()

# CMake strips what it has linked itself.
execute_process(COMMAND strip --strip-unneeded "${private}/bin/povray" COMMAND_ERROR_IS_FATAL ANY)

# Programs by their names in the package. The programs follow the links to their own place.
file(MAKE_DIRECTORY "${root}/usr/bin" "${root}/usr/share/man" "${doc}/examples" "${root}/etc")
file(CREATE_LINK ../lib/povray-tilt/bin/povray "${root}/usr/bin/povray-tilt" SYMBOLIC)
file(CREATE_LINK ../lib/povray-tilt/bin/tiltcal "${root}/usr/bin/tiltcal" SYMBOLIC)
file(CREATE_LINK ../lib/povray-tilt/bin/tiltcost "${root}/usr/bin/tiltcost" SYMBOLIC)
file(CREATE_LINK ../lib/povray-tilt/bin/povray-strips "${root}/usr/bin/povray-strips" SYMBOLIC)
file(CREATE_LINK ../lib/povray-tilt/bin/tiltcal-batch "${root}/usr/bin/tiltcal-batch" SYMBOLIC)

# Links out of /usr are absolute, those within it relative: Debian's policy, 10.5.
file(RENAME "${private}/share/povray-3.7" "${root}/usr/share/povray-tilt")
file(CREATE_LINK ../../../share/povray-tilt "${private}/share/povray-3.7" SYMBOLIC)
file(RENAME "${private}/etc/povray/3.7" "${root}/etc/povray-tilt")
file(CREATE_LINK /etc/povray-tilt "${private}/etc/povray/3.7" SYMBOLIC)
file(RENAME "${private}/share/man/man1" "${root}/usr/share/man/man1")
file(REMOVE_RECURSE "${private}/share/man")
file(RENAME "${private}/share/tilt-lens" "${root}/usr/share/tilt-lens")

# Upstream's sample configurations are no use to anybody: povray.ini there names folders of the distribution's package.
file(REMOVE "${root}/usr/share/povray-tilt/ini/povray.ini")

# Documents, laid out so that their links lead somewhere, and the scenes with their pictures as examples.
foreach(document README.md povray-patch/RENDERING.md povray-patch/REFERENCE.md povray-patch/ray-error.png povray-patch/LIMITS.md
		povray-patch/COMING-FROM.md povray-patch/TILT-LENS-INC.md povray-patch/editors/README.md povray-patch/tiltcost/COSTS.md povray-patch/cluster/CLUSTER.md povray-patch/cluster/plan.svg calib/CALIBRATING.md calib/CALIBRATION-JSON.md calib/EXCHANGE.md calib/python/README.md calib/python/example.py calib/prescription/README.md povray-patch/README.md
		tests/accuracy/ACCURACY.md tests/cli/outside/tilts.cpp tests/cli/outside/CMakeLists.txt)
	get_filename_component(folder "${document}" DIRECTORY)
	file(COPY "${source}/${document}" DESTINATION "${doc}/${folder}")
endforeach()
# The page on the model leads to the sources of its formulas.
file(GLOB model "${source}/povray-patch/lens/MODEL*" "${source}/povray-patch/lens/*.h" "${source}/povray-patch/lens/effects.cpp")
file(COPY ${model} DESTINATION "${doc}/povray-patch/lens")
file(MAKE_DIRECTORY "${doc}/calib/report")
file(CREATE_LINK ../../../../tilt-lens/calibration.schema.json "${doc}/calib/report/calibration.schema.json" SYMBOLIC)
file(CREATE_LINK povray-patch/REFERENCE.md "${doc}/REFERENCE.md" SYMBOLIC)
file(CREATE_LINK povray-patch/COMING-FROM.md "${doc}/COMING-FROM.md" SYMBOLIC)
file(COPY "${source}/scenes/" DESTINATION "${doc}/examples"
	PATTERN CMakeLists.txt EXCLUDE PATTERN tools EXCLUDE PATTERN "*.cmake" EXCLUDE)
file(CREATE_LINK examples "${doc}/scenes" SYMBOLIC)

# The licence: Debian keeps no copy of the AGPL in /usr/share/common-licenses.
file(READ "${source}/LICENSE" license)
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n([^.])" "\n \\1" license "\n${license}")
string(REGEX REPLACE "\n\\.\n" "\n .\n" license "${license}")
file(READ "${source}/cmake/package-copyright" copyright)
file(WRITE "${doc}/copyright" "${copyright}${license}")

# One entry, dated by the newest source (SOURCE_DATE_EPOCH where it is set): the same source gives the same package.
set(ENV{LC_ALL} C)
execute_process(COMMAND git -C "${source}" log -1 --format=%ct OUTPUT_VARIABLE seconds ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(DEFINED ENV{SOURCE_DATE_EPOCH})
	set(seconds "$ENV{SOURCE_DATE_EPOCH}")
endif()
if(NOT seconds MATCHES "^[0-9]+$")
	string(TIMESTAMP seconds %s UTC)
endif()
execute_process(COMMAND date -u -R -d "@${seconds}" OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(WRITE "${doc}/changelog"
	"povray-tilt (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * Built from the tilt-lens source tree.\n\n"
	" -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
file(GLOB compressed "${doc}/changelog" "${root}/usr/share/man/man1/*.1")
execute_process(COMMAND gzip -9n ${compressed} COMMAND_ERROR_IS_FATAL ANY)
