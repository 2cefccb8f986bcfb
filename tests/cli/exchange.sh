#!/bin/sh
# usage: exchange.sh CASE TILTCAL PHOTOS WORK PYTHON
# A calibrated camera for other programs (tiltcal export, undistort, project, unproject): as files.sh runs a case.
set -u
case=$1 tiltcal=$2 photos=$3 work=$4 python=$5
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }
expect() { want=$1; shift; "$tiltcal" "$@" >out 2>err; got=$?; [ "$got" = "$want" ] || fail "exit code $got, expected $want: tiltcal $*"; }
prints() { grep -q -e "$1" out || fail "stdout does not say '$1'"; }
refuses() { want=$1 text=$2; shift 2; expect "$want" "$@"; grep -q -e "$text" err || fail "stderr does not say '$text'"; [ "$(wc -l <err)" = 1 ] || fail "not one line"; }
nothing_left() { left=$(find . -name '.tiltcal*'); [ -z "$left" ] || fail "temporary files left: $left"; }

printf '%s\n' '%YAML:1.0' --- 'image_width: 1800' 'image_height: 1200' 'camera_matrix: !!opencv-matrix' '   rows: 3' '   cols: 3' '   dt: d' \
	'   data: [ 2400., 0., 900., 0., 2400., 600., 0., 0., 1. ]' 'distortion_coefficients: !!opencv-matrix' '   rows: 5' '   cols: 1' '   dt: d' \
	'   data: [ -0.125, 0.02, 0.001, 0., 0. ]' >camera.yml
expect 0 import camera.yml --pitch 0.02 --out imported.json
"$python" "$here/exchange.py" camera imported.json camera.json >out 2>err || fail "no camera"
c="--calibration camera.json"

case $case in
colmap)
	sed 's/"lens_tilt_deg": 5/"lens_tilt_deg": 0/; s/911.7/900.0/; s/588.3/600.0/' camera.json >untilted.json
	expect 0 export --calibration untilted.json --colmap untilted.txt
	"$python" "$here/exchange.py" colmap_untilted untilted.json untilted.txt >out 2>err || fail "the untilted camera"
	awk 'BEGIN { print "u_px,v_px"; for (i = 0; i <= 8; ++i) for (j = 0; j <= 6; ++j) print i * 1799 / 8 "," j * 1199 / 6 }' >grid.csv
	expect 0 unproject grid.csv $c; awk -F, 'NR == 1 { print "x,y,z" } NR > 1 { print 700 * $3 "," 700 * $4 "," 700 * $5 }' OFMT=%.15g out >grid-rays.csv
	expect 0 project grid-rays.csv $c --out seen.csv ;;
esac
case $case in
colmap | renderman | arnold | blender)
	expect 0 export $c --$case camera.txt --unit-mm 10; prints "camera.txt: not in it: "
	"$python" "$here/exchange.py" $case camera.json camera.txt >out 2>err
	got=$?
	cat out
	[ $got = 77 ] && exit 77
	[ $got = 0 ] || fail "the file" ;;
maps)
	expect 0 export $c --stmap maps/c --rays maps/rays.exr; prints "undistorted 1800 x 1200, which shows 9[0-9.]* % of the photograph"
	for file in c-undistort c-redistort rays; do [ "$(head -c 4 maps/$file.exr | od -An -tx1)" = " 76 2f 31 01" ] || fail "$file.exr is no OpenEXR"; done
	expect 0 export $c --stmap maps/d --overscan auto; prints "which shows 100.0 %"
	expect 0 export $c --stmap maps/e --overscan 5; prints "undistorted 1980 x 1320"
	cp maps/c-undistort.exr before
	(ulimit -f 100; trap '' XFSZ; "$tiltcal" export $c --stmap maps/c >out 2>err); [ $? = 3 ] || fail "a full disk"
	cmp -s before maps/c-undistort.exr || fail "half a map"
	nothing_left ;;
warp)
	# A photograph in linear light, as an EXR: through a camera that changes nothing.
	sed 's/-0.125/0/; s/0.02,/0,/; s/0.001/0/' camera.yml >plain.yml
	expect 0 import plain.yml --pitch 0.02 --out plain.json
	expect 0 undistort "$photos/scene/plus5.jpg" --calibration plain.json --out linear --format exr
	expect 0 undistort linear/plus5.exr $c --out flat --format exr
	expect 0 export $c --stmap c
	"$python" "$here/exchange.py" warp c-undistort.exr linear/plus5.exr flat/plus5.exr >out 2>err
	got=$?
	cat out
	[ $got = 77 ] && exit 77
	[ $got = 0 ] || fail "another picture" ;;
usage)
	refuses 2 "nothing to write.*--stmap" export $c
	for bad in -1 101 wide 5,5; do refuses 2 "--overscan $bad: give percent" export $c --stmap x --overscan=$bad; done
	for bad in 0 -1 inf; do refuses 2 "--unit-mm" export $c --blender x.py --unit-mm=$bad; done
	refuses 2 "state plus9" export $c --state plus9 --rays x.exr
	: >blocked; refuses 3 blocked export $c --rays blocked/x.exr
	# What is read is not written over, nor one file twice.
	refuses 2 "--opencv camera.json: would write over what --calibration reads" export $c --opencv camera.json
	refuses 2 "--arnold ./x.ass: is the file of --renderman too" export $c --renderman x.ass --arnold ./x.ass
	refuses 2 "--stmap x-undistort.exr: is the file of --rays too" export $c --rays x-undistort.exr --stmap x
	cp camera.yml same.yml; ln -s same.yml linked.yml
	refuses 2 "--out linked.yml: would write over what IN reads" import same.yml --pitch 0.02 --out linked.yml
	cmp -s camera.yml same.yml || fail "written over"
	[ -z "$(ls x* 2>/dev/null)" ] || fail "written: $(ls)" ;;
points)
	printf 'u_px,v_px\n0,0\n900.5,600.25\n1799,1199\n' >pixels.csv
	expect 0 unproject pixels.csv $c; cp out rays.csv
	# 700 mm along every ray, and back.
	(echo x,y,z; awk -F, 'NR > 1 { printf "%.15g,%.15g,%.15g\n", 700 * $3, 700 * $4, 700 * $5 }' rays.csv) >points.csv
	expect 0 project points.csv $c --out new/seen.csv
	awk -F, 'NR > 1 { print $4 "," $5 }' new/seen.csv >back
	awk -F, 'NR > 1' pixels.csv | paste -d, - back | awk -F, '{ x = $1 - $3; y = $2 - $4; if (x * x + y * y > 1e-14) { print; exit 1 } }' >bad || fail "not the same pixels: $(cat bad)"
	"$tiltcal" project - $c <points.csv >out 2>err || fail "standard input"
	cmp -s out new/seen.csv || fail "standard input gives other pixels"
	refuses 3 "pixels.csv:1: 'u_px,v_px' is not the header x,y,z" project pixels.csv $c
	sed '3s/,.*//' points.csv >cut.csv; refuses 3 "cut.csv:3: .*not 3 numbers x,y,z" project cut.csv $c
	refuses 3 nowhere.csv unproject nowhere.csv $c
	refuses 2 "--out points.csv: would write over what POINTS reads" project points.csv $c --out points.csv
	# What is not known is empty, and said: where the distortion turns back, and what OpenCV's model has not.
	sed 's/2400\./900./g; s/-0.125, 0.02/-0.3, 0./' camera.yml >wide.yml
	expect 0 import wide.yml --pitch 0.02 --out wide.json; grep -q "distortion turns back inside the picture: pixel (.*) sees nothing, and POV-Ray refuses this camera" err || fail "not said"
	expect 0 unproject pixels.csv --calibration wide.json; [ "$(sed -n 2p out)" = "0,0,,,," ] || fail "a direction where there is none"
	sed -n 3p out | grep -q '^900.5,600.25,.*[0-9],$' || fail "a focus that nobody knows"
	expect 0 export --calibration wide.json --rays rays.exr; grep -q "distortion turns back" err || fail "not said"; prints "the plane of focus is unknown"
	refuses 1 "distortion turns back" export --calibration wide.json --colmap colmap.txt ;;
undistort)
	mkdir photos; cp "$photos/scene/untilted.jpg" photos/a.jpg; cp "$photos/scene/plus5.jpg" photos/b.jpg; echo text >photos/notes.txt
	expect 0 undistort photos $c --out flat --overscan auto; prints "100.0 % of the photograph"
	grep -q "2 of 2: flat/b.png" err || fail "no progress"
	[ "$(ls flat | tr '\n' ' ')" = "a.png b.png " ] || fail "written: $(ls flat)"
	expect 0 undistort flat/a.png $c --out back --overscan auto --redistort --format exr
	expect 0 undistort photos/a.jpg $c --out exr --format exr
	# There and back again it is the photograph, but for what two interpolations smooth; without the way back corners lie 80 px off.
	expect 0 undistort photos/a.jpg $c --out same
	error() { expect 0 profile photos/a.jpg "$1" --line 0,60,1799,60 --out compared --json error.json; "$python" -c 'import json; print(json.load(open("error.json"))["lines"][0]["mean_abs_error"])'; }
	error back/a.exr >there_and_back; error same/a.png >there
	paste there_and_back there | awk '{ print; good = NF == 2 && $1 < 0.25 * $2 } END { exit !good }' || fail "not undone"
	refuses 1 "a.jpg is 1800 x 1200 pixels; the undistorted picture has 1980 x 1320" undistort photos/a.jpg $c --out x --overscan 5 --redistort
	# Light above white is lost in a PNG, and said to be.
	expect 0 undistort exr/a.exr $c --out dark; ! grep -q "brighter than white" err || fail "it is not"
	# TIFF of floats: its header, ten entries, then the pixels.
	"$python" -c 'import struct
entry = lambda tag, kind, value: struct.pack("<HHII", tag, kind, 1, value)
entries = [entry(256, 4, 1800), entry(257, 4, 1200), entry(258, 3, 32), entry(259, 3, 1), entry(262, 3, 1), entry(273, 4, 134), entry(277, 3, 1), entry(278, 4, 1200), entry(279, 4, 8640000), entry(339, 3, 3)]
open("bright.tif", "wb").write(b"II*\0" + struct.pack("<IH", 8, 10) + b"".join(entries) + bytes(4) + struct.pack("<1800f", *1350 * [0.5], *450 * [2]) * 1200)'
	expect 0 undistort bright.tif $c --out cut; grep -q "bright.tif: 25 % of it is brighter than white.*--format exr keeps it" err || fail "not said"
	expect 0 undistort bright.tif $c --out kept --format exr; ! grep -q "brighter than white" err || fail "nothing is lost"
	refuses 2 "would write over what PICTURE reads" undistort flat/a.png $c --out flat
	mkdir other; cp photos/a.jpg other/; refuses 2 "two pictures would become" undistort photos/a.jpg other/a.jpg $c --out x
	refuses 2 "--format jpg" undistort photos/a.jpg $c --out x --format jpg
	mkdir empty; : >empty/notes.txt; refuses 3 "empty: holds no pictures" undistort empty $c --out x
	refuses 3 "no file matches" undistort 'nowhere*.jpg' $c --out x
	ln -s round round; refuses 3 "round" undistort round $c --out x
	nothing_left ;;
*) echo "unknown case $case"; exit 99 ;;
esac
