# Sourced by the scripts of the render tests:
#
#   SCRIPT CASE STOCK OURS COMPARE WORK
#
# STOCK and OURS are POV-Rays, COMPARE is compare_pictures, WORK a folder that is emptied first. Every check says what
# it found; the script ends with the number of failed ones.

case=$1 stock=$2 ours=$3 compare=$4 work=$5
here=$(cd "$(dirname "$0")" && pwd)
failures=0
if ! [ -x "$stock" ]; then
	echo "no stock POV-Ray at '$stock'; the distribution's package povray is the oracle (cmake/setup.sh installs it)"
	exit 1
fi
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1

fail() {
	echo "FAILED: $*"
	failures=$((failures + 1))
}

# check WHAT COMMAND...: the command must succeed.
check() {
	what=$1
	shift
	if "$@" > check.txt 2>&1; then
		echo "$what: $(tail -1 check.txt)"
	else
		fail "$what: $(cat check.txt)"
	fi
}

# povray_to PROGRAM PICTURE SCENE OPTIONS...: a picture of 120 x 90 without anti-aliasing, by one thread, unless the
# options say otherwise. The log goes to PICTURE.log, without carriage returns. PICTURE.ppm has 16 bits, linear.
povray_to() {
	program=$1 picture=$2 scene=$3
	shift 3
	case $picture in
		*.ppm) format="+FP16 File_Gamma=1" ;;
		*) format="+FE" ;;
	esac
	# $format: two words.
	"$program" -D +W120 +H90 -A +WT1 $format "+L$here" "+I$scene" "+O$picture" "$@" < /dev/null > raw.log 2>&1
	status=$?
	tr '\r' '\n' < raw.log > "$picture.log"
	return $status
}

# render PROGRAM PICTURE SCENE OPTIONS...: as above, and must succeed.
render() {
	povray_to "$@" && return
	shift
	fail "$1: $(grep -A3 -i error "$1.log" | tail -8)"
	finish
}

finish() {
	[ $failures -eq 0 ] && echo "all well" && exit 0
	echo "$failures checks failed"
	exit 1 # their number could be 256
}

# The view of most scenes, and the block that the tests of the lens itself put before it.
view='location <0, 2.6, -3.5> right x * 4 / 3 up y direction z * 1.5 look_at <0, 1.2, 6>'
tilted='tilt_lens { focal_plane_tilt 60 tilt_direction 30 focal_distance 8 aperture_diameter 0.4 }'
