#!/bin/sh
# usage: plane_page.sh CASE PYTHON TILTCAL TILTCOST POVRAY CASES PHOTOS WORK
# Makes a page in a fresh folder WORK and tries it in headless Chromium.
set -u
here=$(cd "$(dirname "$0")" && pwd)
case=$1 python=$2 tiltcal=$3 tiltcost=$4 povray=$5 cases=$6 photos=$7 work=$8
rm -rf "$work" && mkdir -p "$work/tmp" "$work/home" && cd "$work" || exit 99
TMPDIR=$work/tmp; HOME=$work/home; export TMPDIR HOME

. "$here/tiltcost_says.sh"
try() { "$python" "$here/plane_page.py" "$@" || fail "$*"; }
scene() { # scene FILE LENS AROUND
	printf '#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera {\n%s\n%s }\nsphere { <0, 0, 7>, 1 pigment { rgb 1 } finish { ambient 1 } }\n' "$2" "$3" >"$1"
}
[ -n "$python" ] || fail "no python3 with selenium: cmake/setup.sh installs chromium, chromium-driver and python3-selenium"

around='location <1, 2, -3> right 1.2*x up 0.8*y look_at <0, 1, 5>'
lens='tilt_lens {
  lens_tilt 5  focal_length 1.2  focal_distance 9  f_stop 4
}
'
case $case in
page)
	scene "a <b>&amp; scene.pov" "$lens" "$around"
	expect 0 "a <b>&amp; scene.pov" +W32 +H24 --page page.html; silent
	try page page.html ;;
formulas) scene s.pov "$lens" "$around"; expect 0 s.pov +W32 +H24 --page page.html; try formulas page.html "$cases" ;;
blocks)
	# With every word that has to stay.
	scene s.pov 'tilt_lens {
  lens_tilt 5  focal_length 1.2  focal_distance 9  f_stop 4
  distortion -0.01, 0.001  field_curvature -0.01  blades 5 rotation 18 curvature 0.3  vignetting natural  vignetting optical 0.9, 0.4, 0.8, -0.3
  chromatic lateral 0.0004, -0.0007 axial -0.0001, 0.0002  pupil_magnification 1.07
  aberrations { f_stop 2.8 spherical -0.05 coma 0.1 fifth_order { 0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0.02 } }  denoise  area_light_grid  channels  seed 7
}
' "$around"
	expect 0 s.pov +W32 +H24 --page page.html
	try blocks page.html "$tiltcost" "$povray" s.pov ;;
usage)
	scene s.pov "$lens" "$around"
	refuses 2 "goes with none of" s.pov --page page.html --time 3s
	refuses 2 "does not end in .html" s.pov --page page.pdf
	refuses 3 "nowhere" s.pov --page nowhere/page.html
	scene plain.pov perspective "$around"; refuses 1 "no tilt_lens" plain.pov +W32 +H24 --page page.html
	scene broken.pov "$lens [" "$around"; refuses 1 "Parse Error" broken.pov +W32 +H24 --page page.html
	scene writes.pov "$lens" "$around"; echo '#fopen Log "log.txt" write' >>writes.pov
	refuses 1 "scene-may-write" writes.pov +W32 +H24 --page page.html; [ ! -e log.txt ] || fail "log.txt was written"
	[ ! -e page.html ] || fail "a page is left"
	# A pinhole has a lens too, and words around the block that would contradict it are named.
	scene pinhole.pov 'tilt_lens { lens_tilt 3 }' "focal_point <0, 1, 5> $around"; expect 0 pinhole.pov +W32 +H24 --page page.html
	grep -q 'take focal_point out of the camera' page.html || fail "focal_point is not named"
	expect 0 s.pov +W3000 +H2000 --page page.html; [ -s page.html ] && [ ! -e s.png ] || fail "no page, or a picture" ;;
report)
	"$tiltcal" calibrate --model rigid --effects none --board 12x9 --square 25 --pitch 0.02 --edges-per-photo 40 --untilted "$photos/target/untilted-[1-2].jpg" \
		--tilted plus5="$photos/target/plus5-[1-2].jpg" --out result >out 2>err || fail "calibrate"
	try report result/report.html ;;
*) echo "no such case: $case"; exit 99 ;;
esac
