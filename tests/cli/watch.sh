#!/bin/bash
# usage: watch.sh CASE TILTCAL PHOTOS WORK
# tiltcal calibrate --watch, and interrupts. Runs one case in a fresh folder WORK. bash: a job of sh has Ctrl-C ignored.
set -mu
case=$1 tiltcal=$2 photos=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99
target=$photos/target
pid=
trap '[ -z "$pid" ] || kill -KILL -- -$pid 2>/dev/null' EXIT

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }
# until COMMAND...: ten minutes; what fails is told by a process that ended, or by ctest's limit, which knows the sanitizers
until_true() { for k in $(seq 3000); do "$@" >/dev/null 2>&1 && return; kill -0 $pid 2>/dev/null || fail "ended before: $*"; sleep 0.2; done; fail "never: $*"; }
temporaries() { find . -name '.tiltcal-*' | grep -q .; }
none_left() { ! temporaries || fail "temporary files left: $(find . -name '.tiltcal-*')"; }
# Plane and few edges: quick. One thread: sums in one order, the same to the last digit.
common="--board 12x9 --square 25 --pitch 0.02 --model plane --edges-per-photo 40 --threads 1"
start() { "$tiltcal" calibrate $common "$@" >out 2>err & pid=$!; }
# The last one that was written.
of() { [ "$(sed -n 's/.*calibrated from \([0-9]*\) photographs.*/\1/p' err | tail -n 1)" = "$1" ] && tail -n 3 err | grep -q 'writing report' && ! temporaries; }

# Of w, mm^2, from the covariance.
variance() { python3 -c 'import json; print(json.load(open("result/calibration.json"))["covariance"]["image_distance_mm"]["image_distance_mm"])'; }

case $case in
watch)
	mkdir -p in
	start --watch in --untilted 'untilted-*.jpg' --tilted plus5='plus5-*.jpg' --out result
	until_true grep -q 'waiting for the first photograph' result/report.html
	grep -q 'http-equiv="refresh"' result/report.html || fail "the page does not load itself"
	# A picture of one pixel; not a picture; a name of what is not finished: told or left alone, not fatal.
	printf '\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\001\000\000\000\001\010\000\000\000\000\072\176\233\125\000\000\000\012\111\104\101\124\170\234\143\250\000\000\000\172\000\171\263\141\265\173\000\000\000\000\111\105\116\104\256\102\140\202' >in/untilted-0.jpg
	echo hello >in/untilted-9.jpg
	cp "$target/untilted-1.jpg" in/untilted-8.jpg.part
	until_true grep -q 'skipped: .*untilted-0.jpg' err
	until_true grep -q 'skipped: .*untilted-9.jpg' err
	cp "$target/untilted-1.jpg" "$target/untilted-2.jpg" in
	# Slowly, in two halves.
	half=$(($(stat -c %s "$target/plus5-1.jpg") / 2))
	head -c $half "$target/plus5-1.jpg" >in/plus5-1.jpg
	sleep 0.7
	tail -c +$((half + 1)) "$target/plus5-1.jpg" >>in/plus5-1.jpg
	cp "$target/plus5-2.jpg" in
	until_true of 4
	! grep -q 'skipped: .*plus5-1.jpg' err || fail "a half file was read"
	early=$(variance)
	cp "$target/plus5-3.jpg" "$target/untilted-3.jpg" "$target/plus5-4.jpg" "$target/untilted-4.jpg" in
	until_true of 8
	grep -q 'How the sigmas fall' result/report.html || fail "no history on the page"
	rm in/plus5-4.jpg in/untilted-4.jpg
	until_true grep -q 'plus5-4.jpg: is gone' err
	until_true of 6
	# A copy that comes first in order takes the place of the photograph, which is back when the copy goes.
	calibrated() { [ "$(grep -c 'calibrated from 6' err)" = $1 ] && of 6; }
	until_true calibrated 1
	cp "$target/untilted-1.jpg" in/untilted-0.jpg
	until_true grep -q 'skipped: .*untilted-1.jpg' err
	until_true calibrated 2
	rm in/untilted-0.jpg
	until_true calibrated 3
	kill -INT $pid; wait $pid; got=$?
	[ $got = 0 ] || fail "exit code $got, expected 0"
	none_left
	! grep -q 'http-equiv="refresh"' result/report.html || fail "the page still loads itself"
	# Of what residuals tell: the sum of information over photographs grows. The whole sigma need not fall: it also holds how far parts of the edges, and
	# photographs left out, put this lens, whose aberrations are not in a plane model, apart.
	late=$(variance)
	echo "variance of w: $early -> $late"
	awk "BEGIN { exit !($late > 0 && $late < $early) }" || fail "the variance did not fall"
	# The same as without watching.
	"$tiltcal" calibrate $common --untilted 'in/untilted-[1-3].jpg' --tilted plus5='in/plus5-*.jpg' --out plain >out 2>err || fail "plain"
	# But for the last digits: Ceres sums in the order of addresses. Of what is nearly 0 a millionth of its unit is taken for it.
	python3 "$here/same_numbers.py" result/calibration.json plain/calibration.json 1e-8 || fail "not what a plain calibration says" ;;
watch_refused) # frontal or too few: a page that says so, exit code 1
	mkdir in
	start --watch in --untilted 'untilted-*.jpg' --tilted plus5='plus5-*.jpg' --out result
	cp "$target/plus5-1.jpg" in
	until_true grep -q 'no untilted photograph' result/report.html
	kill -INT $pid; wait $pid; got=$?
	[ $got = 1 ] || fail "exit code $got, expected 1"
	grep -q 'state untilted has 0 photographs' result/report.html || fail "the page does not say what is missing"
	none_left
	# Without a pitch it says so, on the page too, and as a wrong option at the end. Beside an earlier calibration the page says whose the other files are.
	mkdir other; : >other/calibration.json
	common="--board 12x9 --square 25 --model plane --edges-per-photo 40 --threads 1"
	start --watch in --untilted 'plus5-*.jpg' --out other
	until_true grep -q 'No calibration yet</b>: --pitch is required' other/report.html
	grep -q 'no calibration of 1 photograph yet: --pitch is required' err || fail "not said"
	grep -q 'other files of this folder are of an earlier calibration' other/report.html || fail "whose are they?"
	! grep -q 'earlier calibration' result/report.html || fail "there was none"
	kill -INT $pid; wait $pid; got=$?
	[ $got = 2 ] || fail "exit code $got, expected 2"
	"$tiltcal" calibrate $common --watch nowhere --untilted x --out result >out 2>err; [ $? = 3 ] || fail "a folder that is not there"
	ln -s round round; "$tiltcal" calibrate $common --watch round --untilted x --out result >out 2>err; [ $? = 3 ] || fail "a folder that leads nowhere" ;;
watch_field) # a flat field that comes last, in two halves; is gone; is no picture
	python3 -c 'import struct, zlib
chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
rows = (b"\0" + b"\xb0\xb1" * 900) * 1200   # a step from column to column for its noise
open("wall.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1800, 1200, 8, 0, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))'
	calibrated() { [ "$(grep -c 'calibrated from 3' err)" = $1 ] && of 3; }
	told_by_field() { grep -q '"told_by": "flat fields"' result/calibration.json; }
	mkdir in
	start --watch in --untilted 'untilted-*.jpg' --flat-field untilted=wall.png --out result
	cp "$target/untilted-1.jpg" "$target/untilted-2.jpg" "$target/untilted-3.jpg" in
	until_true calibrated 1
	! told_by_field || fail "a flat field that is not there"
	half=$(($(stat -c %s wall.png) / 2))
	head -c $half wall.png >in/wall.png
	sleep 0.7
	tail -c +$((half + 1)) wall.png >>in/wall.png
	until_true calibrated 2
	told_by_field || fail "not told by the flat field that came last"
	rm in/wall.png
	until_true calibrated 3
	grep -q 'wall.png: is gone' err && ! told_by_field || fail "told by a flat field that is gone"
	echo hello >in/wall.png
	until_true grep -q 'no calibration of 3 photographs yet: .*wall.png' err
	cp wall.png in
	until_true calibrated 4
	kill -INT $pid; wait $pid; got=$?
	[ $got = 0 ] || fail "exit code $got, expected 0"
	told_by_field || fail "the last one is not there at the end"
	none_left ;;
watch_nohup) # logging out does not end it
	mkdir in
	cp "$target/untilted-1.jpg" in
	nohup "$tiltcal" calibrate $common --watch in --untilted 'untilted-*.jpg' --out result >out 2>err & pid=$!
	until_true grep -q 'no calibration of 1 photograph\|calibrated from 1' err
	kill -HUP $pid; sleep 1
	kill -0 $pid 2>/dev/null || fail "ended by the hang-up"
	kill -INT $pid; wait $pid; got=$?
	[ $got -le 1 ] || fail "exit code $got" ;;
interrupt_calibrate)
	start --untilted "$target/untilted-[1-3].jpg" --tilted plus5="$target/plus5-[1-3].jpg" --out result
	# In the middle of writing: some are under temporary names.
	until_true temporaries
	kill -INT $pid; wait $pid; got=$?
	[ $got = 130 ] || fail "exit code $got, expected 130"
	none_left
	[ -z "$(ls result)" ] || fail "half of a set: $(ls result)"
	grep -q interrupted err || fail "does not say so" ;;
interrupt_undistort)
	"$tiltcal" calibrate $common --effects distortion --untilted "$target/untilted-[1-3].jpg" --out result >out 2>err || fail "calibrate"
	# A picture takes some 0.4 s, of which the writing is a part: ended at several moments.
	for moment in 0 0.1 0.2 0.3; do
		rm -rf flat
		"$tiltcal" undistort "$target" --calibration result/calibration.json --out flat >out 2>err & pid=$!
		until_true eval 'ls flat/*.png'
		sleep $moment
		kill -INT $pid; wait $pid; got=$?
		[ $got = 130 ] || fail "exit code $got, expected 130"
		none_left
		for png in flat/*.png; do tail -c 8 "$png" | grep -q IEND || fail "$png is half a picture"; done
	done ;;
*) echo "no such case: $case"; exit 99 ;;
esac
