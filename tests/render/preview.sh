#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
# usage: preview.sh CASE POVRAY WORK PYTHON
# The preview window (+D) on an X server without a screen (Xvfb), which is read and clicked at. Exit code 77: Xvfb or xdotool is missing.
set -u
case=$1 povray=$2 work=$3 python=$4
here=$(cd "$(dirname "$0")" && pwd)
for tool in Xvfb xdotool; do command -v $tool >/dev/null || { echo "skipped: no $tool; sh cmake/setup.sh installs it"; exit 77; }; done
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99
server='' renderer=''
trap 'kill $renderer $server 2>/dev/null' EXIT
fail() { echo "FAILED: $*"; tail -n 20 log; exit 1; }

start_server() {
	Xvfb -displayfd 5 -screen 0 640x480x24 -fbdir . -nolisten tcp 5>display >xvfb.log 2>&1 &
	server=$!
	wait_for 'test -s display'
	DISPLAY=:$(cat display); export DISPLAY
}
wait_for() { # within a minute, on any machine
	for tenth in $(seq 600); do eval "$1" >/dev/null 2>&1 && return; sleep 0.1; done
	fail "a minute went by without: $1"
}
scene() { # BLUR_SAMPLES [WORDS-OF-THE-LENS]
	cat >s.pov <<-END
		#version 3.7; global_settings { assumed_gamma 1 }
		camera { tilt_lens { aperture_diameter 0.4 focal_distance 5 focal_plane_tilt 40 ${2-} } blur_samples $1 location -5*z look_at <0, 0.2, 0> }
		light_source { <3, 5, -5> rgb 1 }
		plane { z, 3 pigment { checker rgb 0.2 rgb 0.8 scale 0.3 } }
		sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
	END
}
render() { "$povray" +Is.pov +O"$1" +W160 +H120 +FN +D -P "${2-+P}" >log 2>&1 & renderer=$!; }
window() { xdotool search --onlyvisible --pid "$renderer" 2>/dev/null || xdotool search --onlyvisible --class . ; }
# The window's pixels are the file's: 8 bits of the same numbers.
same_picture() { "$python" "$here/preview.py" Xvfb_screen0 "$1" || fail "the window shows another picture"; }

case $case in
blur | denoise | focus)
	case $case in
	blur) scene 16 ;;
	denoise) scene 16 denoise ;;
	focus) scene 16 'show focus' ;;
	esac
	start_server
	render s.png
	# It waits for a click when it is done.
	wait_for 'test -s s.png'; wait_for "$python $here/preview.py Xvfb_screen0 s.png"
	same_picture s.png
	kill -0 $renderer || fail "it did not wait"
	xdotool mousemove 320 240 click 1
	wait_for "! kill -0 $renderer"
	wait $renderer || fail "exit code $?" ;;
stop)
	scene 100000
	start_server
	render s.png
	wait_for "$python $here/preview.py Xvfb_screen0 something"
	xdotool key --window "$(window | head -1)" q
	wait_for "! kill -0 $renderer"
	wait $renderer; got=$?
	[ $got != 0 ] || fail "a stopped render ends with exit code 0"
	grep -q -i 'abort\|halted\|cancel' log || fail "it does not say that it was stopped" ;;
none)
	scene 4
	unset DISPLAY; "$povray" +Is.pov +Oa.png +W160 +H120 +FN +D -P >log 2>&1 || fail "without a display"
	[ "$(grep -c -i 'sdl' log)" = 1 ] || fail "not one line about it: $(grep -i sdl log)"
	"$povray" +Is.pov +Ob.png +W160 +H120 +FN -D >log 2>&1 || fail "-D"
	cmp a.png b.png || fail "another picture" ;;
*) echo "unknown case $case"; exit 99 ;;
esac
echo "all well"
