# The Debian package povray-tilt, beside the distribution's povray: `cmake --build --preset package` writes it to
# out/package. The project is installed as a whole to a prefix of its own, /usr/lib/povray-tilt, where the programs find
# each other and POV-Ray finds its files (patch 0005); package-layout.cmake then moves what belongs elsewhere.

set(TILT_LENS_PACKAGE_CONTACT "the tilt-lens project <maintainers@tilt-lens.invalid>" CACHE STRING
	"Maintainer named in the Debian package: NAME <ADDRESS>")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME povray-tilt)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/out/package")
set(CPACK_PACKAGE_CONTACT "${TILT_LENS_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "POV-Ray with a tilted lens, and its calibration from photographs")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"povray-tilt is POV-Ray 3.7 with the camera type tilt_lens, which renders what
a tilted (Scheimpflug) lens sees. tiltcal finds the numbers of a real lens
from photographs of a checkerboard or a grid of circles; tiltcost tells
before a long render what accuracy costs in time.
.
It installs beside the package povray and replaces nothing of it.")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_PACKAGING_INSTALL_PREFIX /usr/lib/povray-tilt)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/package-layout.cmake")
set(CPACK_TILT_LENS_SOURCE "${PROJECT_SOURCE_DIR}")

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "slurm-client, povray, povray-doc")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
file(WRITE "${CMAKE_BINARY_DIR}/package/conffiles" "/etc/povray-tilt/povray.conf\n/etc/povray-tilt/povray.ini\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_BINARY_DIR}/package/conffiles")

include(CPack)
