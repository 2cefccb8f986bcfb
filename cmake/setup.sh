#!/bin/sh
# Installs what building, testing and running need, on Debian and its relatives.
# Run it as root or with sudo at hand, as often as you like: what is there already
# is left alone. On other systems it lists what to install.

set -eu

packages="
	ca-certificates cmake ninja-build g++ make patch autoconf automake
	libsdl1.2-dev zlib1g-dev libpng-dev libjpeg-dev libtiff-dev libopenexr-dev libexiv2-dev
	libboost-thread-dev libboost-date-time-dev libboost-system-dev
	libceres-dev libeigen3-dev libopencv-dev libcli11-dev nlohmann-json3-dev
	libspdlog-dev libfmt-dev libgtest-dev libgmock-dev libbenchmark-dev libpugixml-dev
	pkg-config pybind11-dev python3-dev libcairo2-dev fonts-dejavu-core poppler-utils
	gnuplot-nox povray povray-includes slurm-wlm munge procps xvfb xdotool
	dpkg-dev file man-db python3-jsonschema python3-openimageio python3-numpy locales vim
	chromium chromium-driver python3-selenium valgrind"
# Wanted, but nothing fails without them (debootstrap: the workflow `package` tests in a clean root).
optional="ccache debootstrap"

if ! command -v apt-get > /dev/null 2>&1; then
	cat >&2 <<'END'
setup.sh knows apt only. Please install by your system's own names:
  a C++17 compiler, cmake >= 3.25, ninja, make, patch, autoconf, automake
  zlib, libpng, libjpeg, libtiff, exiv2, OpenEXR 3, Boost (thread, date_time, system), SDL 1.2 (the preview window)
  Ceres Solver 2.1, Eigen 3, OpenCV 4, CLI11, nlohmann-json, spdlog, fmt,
  pkg-config, cairo, a sans-serif font, poppler's pdftoppm (for a test)
  GoogleTest, Google Benchmark, pugixml, gnuplot
  povray 3.7 (stock, the tests' oracle) and, for tests, man, the sources of a German locale, Slurm and munge, Xvfb and xdotool, Vim with syntax highlighting, Chromium with its driver, valgrind,
  Python 3 with jsonschema 4, numpy, OpenImageIO and selenium 4; pybind11 for the Python module; ccache (optional)
  Fedora: gcc-c++ cmake ninja-build patch autoconf automake zlib-devel libpng-devel libjpeg-turbo-devel
          SDL-devel libtiff-devel exiv2-devel openexr-devel boost-devel ceres-solver-devel eigen3-devel opencv-devel cli11-devel
          json-devel spdlog-devel fmt-devel gtest-devel gmock-devel google-benchmark-devel pugixml-devel gnuplot povray ccache
          pkgconf cairo-devel dejavu-sans-fonts poppler-utils pybind11-devel python3-devel python3-jsonschema python3-numpy python3-openimageio
          chromium chromedriver python3-selenium xorg-x11-server-Xvfb xdotool vim-enhanced valgrind
  Arch:   base-devel cmake ninja sdl12-compat zlib libpng libjpeg-turbo libtiff exiv2 openexr boost ceres-solver eigen opencv
          cli11 nlohmann-json spdlog fmt gtest benchmark pugixml gnuplot povray ccache pkgconf cairo ttf-dejavu poppler
          pybind11 openimageio python-jsonschema python-numpy chromium python-selenium xorg-server-xvfb xdotool vim valgrind
  (Tried: Debian 12 and 13. The lists for Fedora and Arch are from their indexes of packages and have not been tried.)
  and the POV-Ray 3.7.0.10 source archive: cmake --preset release -DPOVRAY_SOURCE=/path/to/archive
END
	exit 1
fi

missing=""
for package in $packages $optional; do
	state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null || true)
	[ "$state" = installed ] || missing="$missing $package"
done
if [ -z "$missing" ]; then
	echo "setup.sh: everything is installed."
	exit 0
fi

as_root=""
if [ "$(id -u)" -ne 0 ]; then
	command -v sudo > /dev/null 2>&1 || {
		echo "setup.sh: needs root (or sudo) to install:$missing" >&2
		exit 1
	}
	as_root=sudo
fi

echo "setup.sh: installing$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get -q update
# shellcheck disable=SC2086 # one word per package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends $missing
echo "setup.sh: done."
