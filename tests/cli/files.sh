#!/bin/sh
# usage: files.sh CASE TILTCAL PHOTOS WORK [PYTHON] [COMMA_LOCALE] [WATCHED_DISK]
# Names, places and disks that files may have: names in other encodings, links, devices, full disks, more than 2 GB. Runs one case
# in a fresh folder WORK; exits 0 when the program behaved as documented.
set -u
case=$1 tiltcal=$2 photos=$3 work=$4 python=${5-python3} comma=${6-} watched=${7-}
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99
target=$photos/target

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }
expect() { # expect CODE ARGUMENT...
	want=$1; shift
	"$tiltcal" "$@" >out 2>err
	got=$?
	[ "$got" = "$want" ] || fail "exit code $got, expected $want: tiltcal $*"
}
says() { grep -a -q -e "$1" err || fail "stderr does not say '$1'"; }
refuses() { want=$1 text=$2; shift 2; expect "$want" "$@"; says "$text"; [ "$(wc -l <err)" = 1 ] || fail "not one line"; }
nothing_left() { left=$(find . -name '.tiltcal*'); [ -z "$left" ] || fail "temporary files left: $left"; }
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }

# Quick, and of all kinds of file.
calibrate="calibrate --model rigid --effects none --board 12x9 --square 25 --pitch 0.02 --edges-per-photo 40"

# camera.yml of OpenCV, camera.json imported from it, and points.csv seen by it (cli.sh has the formula).
camera() {
	printf '%s\n' '%YAML:1.0' --- 'image_width: 1800' 'image_height: 1200' 'camera_matrix: !!opencv-matrix' '   rows: 3' '   cols: 3' '   dt: d' \
		'   data: [ 2400., 0., 900., 0., 2400., 600., 0., 0., 1. ]' 'distortion_coefficients: !!opencv-matrix' '   rows: 5' '   cols: 1' '   dt: d' \
		'   data: [ 0.125, 0., 0., 0., 0. ]' >camera.yml
	expect 0 import camera.yml --pitch 0.02 --out camera.json
	printf '%s\n' u_px,v_px,x,y,z 420.5,840.25,-200,-100,0 1336.4,861.8,200,-120,100 600,300,-150,150,200 1380,226.7,180,140,-100 938.4,542.4,20,30,250 \
		730.6,374.1,-60,80,-150 >points.csv
}

# A name with Latin-1, a line end, quotes, and what would be SDL, HTML, JSON, YAML, XML or a second column.
hostile=$(printf 'h\344user\n#error "<b>\047&,;--{1}')
reads_json() { "$python" -c 'import json, sys; json.loads(open(sys.argv[1], "rb").read().decode("utf-8"))' "$1" || fail "$1 is not JSON"; }
is_utf8() { "$python" -c 'import sys; open(sys.argv[1], "rb").read().decode("utf-8")' "$1" || fail "$1 is not UTF-8"; }
injects() { if grep -a -n '^#error' "$1"; then fail "$1 has SDL from a name"; fi; }

case $case in
hostile_names)
	for k in 1 2 3; do cp "$target/untilted-$k.jpg" "$hostile$k.jpg"; cp "$target/plus5-$k.jpg" "$hostile-plus5-$k.jpg"; done
	out=$hostile'\\'; mkdir "$out"
	expect 0 $calibrate --untilted "$hostile"'[1-3].jpg' --tilted tilt37-az030="$hostile-plus5-[1-3].jpg" --out "$out"
	says "state tilt37-az030 is called tilt37_az030"
	for file in calibration.json report.html camera-untilted.inc camera-tilt37_az030.inc; do
		[ -s "$out/$file" ] || fail "no $file"
		is_utf8 "$out/$file"
		injects "$out/$file"
	done
	reads_json "$out/calibration.json"
	is_utf8 "$out/photographs.csv"
	"$python" -c 'import csv, sys; n = {len(row) for row in csv.reader(open(sys.argv[1], encoding="utf-8", newline=""))}; sys.exit(len(n) != 1)' "$out/photographs.csv" || fail "columns of photographs.csv"
	[ -s "$out/blur-tilt37_az030.png" ] || fail "no plot"
	! grep -a -q '<b>.*1}' "$out/report.html" || fail "report.html has tags from a name"
	grep -q '^#macro TiltCal_tilt37_az030_Pose(N)' "$out/camera-tilt37_az030.inc" || fail "the identifier is not the name with _"
	# The same state by either spelling.
	camera
	expect 0 export --calibration "$out/calibration.json" --state tilt37-az030 --opencv "$out/x.yml"; is_utf8 "$out/x.yml"
	expect 0 detect --board 12x9 "$hostile""1.jpg" --csv "$hostile.csv" --overlay "$out/seen"; is_utf8 "$hostile.csv"
	"$python" -c 'import csv, sys; sys.exit(any(len(row) != 6 for row in csv.reader(open(sys.argv[1], encoding="utf-8", newline=""))))' "$hostile.csv" || fail "columns"
	expect 0 profile "$hostile""1.jpg" "$hostile""1.jpg" --line 0,660,1799,660 --out "$out/profile" --json "$out/profile.json"
	reads_json "$out/profile.json"; [ -s "$out/profile/profile.png" ] || fail "no plot of profiles"
	expect 0 pose --calibration camera.json --points points.csv --photo "$hostile""1.jpg" --overlay "$hostile.png" --out "$hostile.inc"; injects "$hostile.inc"
	expect 0 target --board 12x9 --square 25 --out "$hostile.inc" --out "$hostile.svg" --out "$hostile.pdf"; injects "$hostile.inc"; is_utf8 "$hostile.svg"
	cp camera.yml "$hostile.yml"; expect 0 import "$hostile.yml" --pitch 0.02 --out "$hostile.json"; reads_json "$hostile.json"
	expect 3 pose --calibration "$hostile.nowhere" --points points.csv; says 'no such file'
	nothing_left ;;
hostile_state) # what anybody may have written into a calibration.json
	camera
	refuses 2 "call it x_error" import camera.yml --pitch 0.02 --state "$(printf 'x\n#error "y"')" --out bad.json
	"$python" - <<-'END' || exit 99
		import json
		c = json.load(open("camera.json"))
		c["states"][0]["name"] = c["model"] = 'x\n#error "injected"\n-->\r#error <b>\x7f'
		json.dump(c, open("hostile.json", "w"))
	END
	expect 0 pose --calibration hostile.json --points points.csv --out hostile.inc; injects hostile.inc
	! tr '\r' '\n' <hostile.inc | grep -q '^#error' || fail "SDL behind a carriage return"
	for suffix in yml xml; do
		expect 0 export --calibration hostile.json --opencv hostile.$suffix; injects hostile.$suffix
		expect 0 import hostile.$suffix --pitch 0.02 --out $suffix.json
		grep -v '"source"\|"model"' camera.json >a; grep -v '"source"\|"model"' $suffix.json | cmp -s a - || fail "$suffix: another camera"
	done
	for format in blender:py renderman:rib arnold:ass colmap:txt; do
		file=hostile.${format#*:}
		expect 0 export --calibration hostile.json --"${format%:*}" $file; injects $file
		! tr '\r' '\n' <$file | grep -q '^#error' || fail "$file: a line of its own behind a carriage return"
	done
	"$python" -c 'import ast; ast.parse(open("hostile.py").read())' || fail "hostile.py is not Python"
	"$python" -c 'import xml.dom.minidom; xml.dom.minidom.parse("hostile.xml")' || fail "hostile.xml is not XML"
	expect 2 pose --calibration hostile.json --state other --points points.csv; says "has the states x" ;;
state_names)
	for name in Rim Distortion Blur_Samples Pose Pose_Sky Target Target_White; do
		refuses 2 "'$name' is what the .inc files call something else by; call it state_$name" $calibrate --untilted "$target/untilted-1.jpg" --tilted "$name=$target/plus5-1.jpg" --out result
	done
	refuses 2 "call it state_5deg" $calibrate --untilted "$target/untilted-1.jpg" --tilted "5deg=$target/plus5-1.jpg" --out result
	refuses 2 "call it plus5_a" $calibrate --untilted "$target/untilted-1.jpg" --tilted "plus5+a=$target/plus5-1.jpg" --out result
	refuses 2 "'../up'.*call it up" $calibrate --untilted "$target/untilted-1.jpg" --tilted "../up=$target/plus5-1.jpg" --out result
	expect 2 $calibrate --untilted "$target/untilted-1.jpg" --tilted "up-1=$target/plus5-1.jpg" --tilted "up_1=$target/plus5-2.jpg" --out result; says "'up_1' is already taken"
	refuses 2 "'up_Pose' is what the .inc of state up calls" $calibrate --untilted "$target/untilted-1.jpg" --tilted "up=$target/plus5-1.jpg" --tilted "up_Pose=$target/plus5-2.jpg" --out result
	[ ! -e result ] || fail "something was written" ;;
links_devices)
	camera
	mkdir elsewhere; echo old >elsewhere/real.json; chmod 640 elsewhere/real.json; ln elsewhere/real.json elsewhere/kept.json
	ln -s elsewhere/real.json link.json; ln -s link.json twice.json; ln -s elsewhere/new.json dangling.json
	expect 0 import camera.yml --pitch 0.02 --out twice.json
	[ -h twice.json ] && [ -h link.json ] || fail "a link was replaced"
	same elsewhere/real.json camera.json
	[ "$(stat -c %a elsewhere/real.json)" = 640 ] || fail "the rights changed"
	[ "$(cat elsewhere/kept.json)" = old ] || fail "the old file was written into instead of being replaced"
	expect 0 import camera.yml --pitch 0.02 --out dangling.json; [ -h dangling.json ] || fail "the dangling link was replaced"; same elsewhere/new.json camera.json
	ln -s round.json round.json; refuses 3 "round.json.*link that leads nowhere" import camera.yml --pitch 0.02 --out round.json
	mkfifo pipe.json; cat pipe.json >got & expect 0 import camera.yml --pitch 0.02 --out pipe.json; wait
	[ -p pipe.json ] || fail "the pipe was replaced"; same got camera.json
	# Only root may make devices, and not everywhere: the machine's own must not be at stake.
	if mknod null.json c 1 3 2>/dev/null && echo x 2>/dev/null >null.json; then
		expect 0 import camera.yml --pitch 0.02 --out null.json; [ -c null.json ] || fail "the device was replaced"
	fi
	"$tiltcal" import camera.yml --pitch 0.02 --out /dev/stdout >got 2>err || fail "/dev/stdout"; same got camera.json; says "written to /dev/stdout"
	expect 0 export --calibration camera.json --colmap /dev/stdout --renderman camera.rib; grep -v '^#' out >got; [ "$(wc -l <got)" = 1 ] || fail "more than the camera"; says "not in it"
	expect 0 detect --board 12x9 "$target/untilted-1.jpg" --csv /dev/stdout; [ -z "$(grep -v '^[^,]*,[^,]*,' out)" ] || fail "more than the corners"
	expect 0 detect --board 12x9 "$target/untilted-1.jpg" --csv /dev/stderr; [ "$(grep -c ',' err)" -ge 89 ] || fail "no corners on /dev/stderr"
	mkdir folder.json; refuses 3 "folder.json.*is a folder" import camera.yml --pitch 0.02 --out folder.json
	nothing_left ;;
sets) # a folder has one run's files
	set -- profile "$target/untilted-1.jpg" "$target/untilted-2.jpg"
	expect 0 "$@" --line 0,0,99,0 --line 0,0,0,99 --line 5,5,5,5 --out profiles; [ -s profiles/profile-3.csv ] && [ -s profiles/profile.png ] || fail "no profiles"
	expect 0 "$@" --line 0,0,99,0 --out profiles; [ "$(echo profiles/*.csv)" = profiles/profile-1.csv ] || fail "profiles of two runs"
	expect 0 "$@" --out profiles; [ "$(ls profiles)" = side-by-side.png ] || fail "profiles of two runs: $(ls profiles)"
	mkdir elsewhere result; ln -s ../elsewhere/calibration.json result/calibration.json
	echo mine >result/camera-mine.inc; echo mine >result/overlay.txt
	expect 0 $calibrate --untilted "$target/untilted-[1-3].jpg" --tilted plus5="$target/plus5-[1-3].jpg" --out result
	says "camera-mine.inc: not of this run"; [ -h result/calibration.json ] && [ -s elsewhere/calibration.json ] || fail "the link was replaced"
	find result elsewhere -type f -exec cksum {} + | sort >before
	# Half-way: files are refused above 256 kB, as on a full disk; then one cannot take its place.
	(ulimit -f 256; "$tiltcal" $calibrate --untilted "$target/untilted-[1-2].jpg" --out result >out 2>err; echo $? >code)
	[ "$(cat code)" = 3 ] || fail "exit code $(cat code)"
	says "result/.*cannot be written (File too large)"; nothing_left
	find result elsewhere -type f -exec cksum {} + | sort >after; same before after
	mv result/report.html report.html; mkdir result/report.html
	expect 3 $calibrate --untilted "$target/untilted-[1-2].jpg" --out result; says "report.html: is a folder"; nothing_left
	rmdir result/report.html; mv report.html result
	find result elsewhere -type f -exec cksum {} + | sort >after; same before after
	# Ended while it draws: here in gnuplot, which waits for it.
	mkdir bin; printf '%s\n' '#!/bin/sh' ': >reached' 'exec sleep 60' >bin/gnuplot; chmod +x bin/gnuplot
	(export PATH="$PWD/bin:$PATH"; exec "$tiltcal" $calibrate --untilted "$target/untilted-[1-2].jpg" --out result >out 2>err) & run=$!
	for k in $(seq 3000); do [ -e reached ] && break; sleep 0.1; done
	kill -TERM $run; wait $run; code=$?
	[ $code = 143 ] || fail "exit code $code of a run that was ended"
	says interrupted; nothing_left
	find result elsewhere -type f -exec cksum {} + | sort >after; same before after
	# Another run: what was of the first alone goes, what is nobody's stays.
	expect 0 $calibrate --untilted "$target/untilted-[1-2].jpg" --out result
	says "of the earlier run in result"; says "camera-mine.inc: not of this run"; nothing_left
	[ "$(ls result | tr '\n' ' ')" = "blur-untilted.csv blur-untilted.png calibration.json camera-mine.inc camera-untilted.inc overlay-untilted-1.png overlay-untilted-2.png overlay.txt photographs.csv report.html report.txt " ] \
		|| fail "result has $(ls result | tr '\n' ' ')" ;;
crlf) # and a byte order mark
	camera
	expect 0 export --calibration camera.json --opencv camera.xml
	expect 0 pose --calibration camera.json --points points.csv --out plain.inc
	for file in camera.yml camera.xml camera.json points.csv; do { printf '\357\273\277'; sed 's/$/\r/' $file; } >dos-$file; tr '\n' '\r' <$file >mac-$file; done
	for kind in dos mac; do
		for suffix in yml xml; do
			expect 0 import $kind-camera.$suffix --pitch 0.02 --out $kind.json
			grep -v '"source"' camera.json >a; grep -v '"source"' $kind.json | cmp -s a - || fail "$kind-camera.$suffix: another camera"
		done
		expect 0 pose --calibration $kind-camera.json --points $kind-points.csv --out $kind.inc; same plain.inc $kind.inc
	done
	# What brought OpenCV's parsers down: zero bytes, lists without end, room for 50 GB (found by tests/fuzz/coverage.sh).
	printf '<?xml version=\000"1.0"?>%%\n<opencv_storage' >zero.xml; refuses 3 "zero.xml: is no text" import zero.xml --pitch 0.02 --out x.json
	{ printf '%%YAML:1.0\n---\na: '; head -c 100000 /dev/zero | tr '\0' '['; } >deep.yml; refuses 3 "deep.yml: has lists in lists" import deep.yml --pitch 0.02 --out x.json
	sed 's/rows: 3/rows: 2000000000/' camera.yml >large.yml; refuses 3 "large.yml: camera_matrix" import large.yml --pitch 0.02 --out x.json
	sed '4s/.*/nonsense\r/' dos-points.csv >bad.csv; refuses 3 "bad.csv:4: 'nonsense'" pose --calibration camera.json --points bad.csv ;;
two_gb) # sparse files. Nine refusals take 1 s, a slow machine with sanitizers 10; to read them takes longer
	camera
	for file in zero.jpg zero.json zero.csv zero.yml; do truncate -s 2200M $file; done
	printf '\377\330\377' >real.jpg; truncate -s 2200M real.jpg
	start=$(date +%s)
	refuses 3 "zero.jpg.*MB" $calibrate --untilted zero.jpg --out result
	refuses 3 "real.jpg.*MB" $calibrate --untilted real.jpg --out result
	refuses 3 "real.jpg.*MB" profile real.jpg real.jpg --out result
	expect 3 calibrate --board 12x9 --square 25 --untilted real.jpg --out result; says "real.jpg.*MB"
	refuses 3 "zero.json.*MB" pose --calibration zero.json --points points.csv
	refuses 3 "zero.csv.*MB" pose --calibration camera.json --points zero.csv
	refuses 3 "zero.json.*MB" export --calibration zero.json --opencv x.yml
	refuses 3 "zero.yml.*MB" import zero.yml --pitch 0.02 --out x.json
	truncate -s 1900M zero.jpg; refuses 3 "zero.jpg: not a picture" $calibrate --untilted zero.jpg --out result
	[ $(($(date +%s) - start)) -le 20 ] || fail "took $(($(date +%s) - start)) s"
	rm -f zero.* real.jpg ;;
full_disk)
	camera
	for suffix in json yml inc csv svg pdf png; do ln -s /dev/full full.$suffix; done
	refuses 3 "full.json: cannot be written (No space left on device)" import camera.yml --pitch 0.02 --out full.json
	refuses 3 "full.yml: cannot be written (No space left on device)" export --calibration camera.json --opencv full.yml
	refuses 3 "full.inc: cannot be written (No space left on device)" pose --calibration camera.json --points points.csv --out full.inc
	for suffix in inc svg pdf; do refuses 3 "full.$suffix: cannot be written (No space left on device)" target --board 12x9 --square 25 --out full.$suffix; done
	expect 3 detect --board 12x9 "$target/untilted-1.jpg" --csv full.csv; says "full.csv: cannot be written (No space left on device)"
	[ -h full.inc ] && [ -c /dev/full ] || fail "replaced"
	"$tiltcal" pose --calibration camera.json --points points.csv >/dev/full 2>err && fail "stdout is full"
	# A disk that becomes full on the way: the old files stay, nothing is left over.
	for suffix in inc svg pdf csv png; do echo old >old.$suffix; done
	small() { (ulimit -f 2; "$tiltcal" "$@" >out 2>err); [ $? = 3 ] || fail "tiltcal $*"; says "cannot be written\|File too large"; nothing_left; }
	for suffix in inc svg; do small target --board 30x20 --square 25 --out old.$suffix; [ "$(cat old.$suffix)" = old ] || fail "old.$suffix"; done
	small detect --board 12x9 "$target/untilted-1.jpg" --csv old.csv; [ "$(cat old.csv)" = old ] || fail "old.csv"
	small pose --calibration camera.json --points points.csv --photo "$target/untilted-1.jpg" --overlay old.png --out old.inc
	[ "$(cat old.inc old.png)" = "$(printf 'old\nold')" ] || fail "a set half-way"
	mkdir result; small profile "$target/untilted-1.jpg" "$target/untilted-1.jpg" --line 0,660,1799,660 --out result; [ -z "$(ls -A result)" ] || fail "profile half-way" ;;
synced) # what takes a name is on the disk before; a disk that fails leaves the old set
	on_disk() { # ARGUMENT... : with the disk's calls in the file calls
		: >calls
		(export WATCHED_DISK="$PWD/calls" LD_PRELOAD="$watched"; exec "$tiltcal" "$@" >out 2>err)
	}
	# Files that are put aside or come back were on the disk already; here every temporary name is one of new text.
	in_order() { # LEAST
		"$python" - "$1" <<-'END' || fail "not on the disk before it took its name"
		import os, sys
		synced, folders, renamed = set(), set(), 0
		for line in open("calls"):
		    call, _, rest = line.rstrip("\n").partition(" ")
		    if call == "fsync":
		        synced.add(os.path.realpath(rest))
		        continue
		    start, end = (os.path.realpath(name) for name in rest.split("\t"))
		    if os.path.basename(start).startswith(".tiltcal"):
		        renamed += 1
		        folders.add(os.path.dirname(end))
		        if start not in synced:
		            sys.exit(f"{end}: renamed before fsync")
		        synced -= folders
		if renamed < int(sys.argv[1]) or not folders <= synced:
		    sys.exit(f"{renamed} files; folders not synced after: {folders - synced}")
		END
	}
	camera; mkdir result
	on_disk import camera.yml --pitch 0.02 --out alone.json || fail "import"
	in_order 1
	on_disk $calibrate --untilted "$target/untilted-[1-3].jpg" --tilted plus5="$target/plus5-[1-3].jpg" --out result || fail "calibrate"
	in_order 10
	find result -type f -exec cksum {} + | sort >before
	syncs=$(grep -c '^fsync .*/\.tiltcal' calls)
	for failing in 1 $((syncs / 2)) "$syncs"; do
		(export WATCHED_DISK_FAILS=$failing; on_disk $calibrate --untilted "$target/untilted-[2-4].jpg" --tilted plus5="$target/plus5-[1-3].jpg" --out result; echo $? >code)
		[ "$(cat code)" = 3 ] || fail "exit code $(cat code) where fsync $failing failed"
		says "result/.*cannot be written (Input/output error)"; nothing_left
		find result -type f -exec cksum {} + | sort >after; same before after
	done ;;
locale) # of a decimal comma, in the environment and set by a preloaded library (test_locale.cpp: by a program that hosts ours)
	mkdir locales; localedef -i de_DE -f UTF-8 locales/de_DE.UTF-8 || fail "no locale could be made; cmake/setup.sh installs the package locales"
	camera
	everything() { # FOLDER
		mkdir -p "$1"
		expect 0 import camera.yml --pitch 0.02 --out "$1/camera.json"
		expect 0 export --calibration camera.json --opencv "$1/camera.yml"
		expect 0 export --calibration camera.json --opencv "$1/camera.xml"
		expect 0 pose --calibration camera.json --points points.csv --out "$1/pose.inc"
		expect 0 target --board 12x9 --square 25.5 --paper 420.5x297.5 --out "$1/target.inc" --out "$1/target.svg"
		expect 0 detect --board 12x9 "$target/untilted-1.jpg" --transfer 2.2 --csv "$1/corners.csv"
		expect 0 profile "$target/untilted-1.jpg" "$target/untilted-2.jpg" --line 0.5,660,1799,660 --match gain --out "$1" --json "$1/profile.json"
		expect 0 $calibrate --untilted "$target/untilted-[1-3].jpg" --prior focal_length=45.5:1.5 --out "$1"
		# gnuplot's, and the date's; and what has so many digits that the order of a sum shows (test_effects.cpp compares a .inc).
		rm "$1"/*.png "$1/report.html" "$1/camera-untilted.inc"
		"$python" -c 'import json, sys; print(json.dumps(json.loads(open(sys.argv[1]).read(), parse_float=lambda x: "%.4g" % float(x)), indent=1))' "$1/calibration.json" >"$1/rounded.json" || fail "not JSON"
		rm "$1/calibration.json"
	}
	everything plain
	(LOCPATH=$PWD/locales LC_ALL=de_DE.UTF-8 LD_PRELOAD=$comma; export LOCPATH LC_ALL LD_PRELOAD; everything comma) || exit 1
	[ -s plain/rounded.json ] || fail "nothing to compare"
	diff -r plain comma || fail "the locale changes files" ;;
*) echo "unknown case $case"; exit 99 ;;
esac
