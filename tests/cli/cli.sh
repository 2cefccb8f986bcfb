#!/bin/sh
# usage: cli.sh CASE TILTCAL PHOTOS WORK
# Runs one case in a fresh folder WORK; exits 0 when the program behaved as documented.
set -u
case=$1 tiltcal=$2 photos=$3 work=$4
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99
target=$photos/target

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }

# expect CODE ARGUMENT...: runs the program and compares its exit code.
expect() {
	want=$1; shift
	"$tiltcal" "$@" >out 2>err
	got=$?
	[ "$got" = "$want" ] || fail "exit code $got, expected $want: tiltcal $*"
}
says() { grep -q -e "$1" err || fail "stderr does not say '$1'"; }
prints() { grep -q -e "$1" out || fail "stdout does not say '$1'"; }
silent() { [ ! -s out ] || fail "an error must print nothing on stdout"; }
refuses() { want=$1 text=$2; shift 2; expect "$want" "$@"; says "$text"; silent; }

calibrate() { # calibrate CODE TEXT UNTILTED EXTRA...
	want=$1 text=$2 untilted=$3; shift 3
	refuses "$want" "$text" calibrate --board 12x9 --square 25 --pitch 0.02 --untilted "$untilted" --out result "$@"
}

case $case in
help) expect 0 --help; prints calibrate; prints profile; prints "Exit codes" ;;
version) expect 0 --version; grep -Eq '^tiltcal [0-9]+\.[0-9]+\.[0-9]+$' out || fail "version line" ;;
no_command) refuses 2 subcommand ;;
unknown_option) calibrate 2 frobnicate "$target/untilted-1.jpg" --frobnicate ;;
help_of_each)
	for command in calibrate detect profile; do
		expect 0 $command --help; prints Example; prints "Exit codes"
	done ;;
missing_file) calibrate 3 nowhere.jpg "$target/nowhere.jpg" ;;
empty_glob) calibrate 3 "no file matches" "$target/*.webp" ;;
empty_file) : >zero.png; calibrate 3 "zero.png.*empty" zero.png ;;
not_an_image) echo hello >text.png; calibrate 3 "text.png.*not a picture" text.png ;;
truncated) head -c 100000 "$target/untilted-1.jpg" >cut.jpg; calibrate 3 "cut.jpg.*truncated" cut.jpg ;;
folder_as_photo) mkdir photo.jpg; calibrate 3 "photo.jpg.*folder" photo.jpg ;;
wrong_board_size)
	refuses 1 "squares" calibrate --board 10x7 --square 25 --pitch 0.02 --untilted "$target/untilted-1.jpg" --out result ;;
bad_board)
	for board in 12 12x 12x9x2 axb 2x2 -3x9; do
		refuses 2 board calibrate --board=$board --square 25 --pitch 0.02 --untilted "$target/untilted-1.jpg" --out result
	done ;;
bad_transfer) calibrate 2 transfer "$target/untilted-1.jpg" --transfer rec709 ;;
bad_pitch)
	refuses 2 pitch calibrate --board 12x9 --square 25 --pitch 0 --untilted "$target/untilted-1.jpg" --out result
	refuses 2 square calibrate --board 12x9 --square -1 --pitch 0.02 --untilted "$target/untilted-1.jpg" --out result ;;
bad_name) calibrate 2 NAME "$target/untilted-1.jpg" --tilted "$target/plus5-1.jpg"; calibrate 2 NAME "$target/untilted-1.jpg" --tilted "5deg=$target/plus5-1.jpg" ;;
same_name) calibrate 2 "already taken" "$target/untilted-1.jpg" --tilted "untilted=$target/plus5-1.jpg" ;;
unbuilt_model) calibrate 2 "plane" "$target/untilted-1.jpg" --model magic ;;
unwritable_folder)
	# A file in the way of the folder stops root too.
	: >blocked
	refuses 3 blocked calibrate --board 12x9 --square 25 --pitch 0.02 --untilted "$target/untilted-1.jpg" --out blocked/result ;;
no_board) calibrate 1 "untilted.jpg: no board" "$photos/scene/untilted.jpg" ;;
detect_csv)
	expect 0 detect --board 12x9 "$target/untilted-1.jpg" --csv corners.csv --overlay seen
	prints "88 corners, 157 edges.*of a square, median"
	[ -s seen/1-untilted-1.png ] || fail "no overlay"
	[ "$(head -n 1 corners.csv)" = "file,column,row,x_px,y_px,sigma_px" ] || fail "header of corners.csv"
	[ "$(head -n 1 corners-edges.csv)" = "file,x_px,y_px,nx,ny,blur_px,sigma_px" ] || fail "header of corners-edges.csv"
	[ "$(wc -l <corners.csv)" = 89 ] || fail "88 corners expected"
	[ "$(wc -l <corners-edges.csv)" = 158 ] || fail "157 edges expected" ;;
detect_unwritable) : >blocked; refuses 3 blocked detect --board 12x9 "$target/untilted-1.jpg" --csv blocked/x.csv ;;
profile_same)
	expect 0 profile "$photos/scene/plus5.jpg" "$photos/scene/plus5.jpg" --line 0,660,1799,660 --out result
	prints "line 1 (0,660,1799,660): mean absolute error 0.000" ; prints "match none" ;;
profile_sizes_differ)
	# A 1 x 1 PGM is a picture that OpenCV reads.
	printf 'P5\n1 1\n255\nx' >one.pgm
	refuses 1 "same size" profile "$photos/scene/plus5.jpg" one.pgm --line 0,0,0,0 --out result ;;
profile_line_outside)
	refuses 2 "leaves the picture" profile "$photos/scene/plus5.jpg" "$photos/scene/plus5.jpg" --line 0,0,1800,0 --out result
	refuses 2 "x0,y0,x1,y1" profile "$photos/scene/plus5.jpg" "$photos/scene/plus5.jpg" --line 0,0,5 --out result ;;
profile_bad_match) refuses 2 shading profile "$photos/scene/plus5.jpg" "$photos/scene/plus5.jpg" --match colour --out result ;;
profile_missing) refuses 3 nowhere profile "$photos/scene/plus5.jpg" nowhere.png --out result ;;
profile_files)
	expect 0 profile "$photos/scene/untilted.jpg" "$photos/scene/plus5.jpg" --line 0,660,1799,660 --line 900,0,900,1199 --match shading --out result --json result/r.json
	prints "match shading"
	[ "$(wc -l <result/profile-1.csv)" = 1801 ] || fail "1800 samples expected"
	[ "$(wc -l <result/profile-2.csv)" = 1201 ] || fail "1200 samples expected"
	grep -q '"mean_abs_error"' result/r.json || fail "no mean_abs_error in the JSON"
	[ -s result/side-by-side.png ] || fail "no side-by-side.png"
	left=$(find result -name '.*' -type f) ; [ -z "$left" ] || fail "temporary files left: $left" ;;
one_photo)
	# One photograph: an answer with large sigmas or a refusal, never a crash or a usage error.
	"$tiltcal" calibrate --board 12x9 --square 25 --pitch 0.02 --untilted "$target/untilted-1.jpg" --out result >out 2>err
	got=$?
	[ "$got" = 0 ] || [ "$got" = 1 ] || fail "exit code $got"
	[ "$got" = 1 ] || says "principal point" ;;
rigid_files)
	expect 0 calibrate --model rigid --board 12x9 --square 25 --pitch 0.02 --untilted "$target/untilted-[1-3].jpg" \
		--tilted plus5="$target/plus5-[1-3].jpg" --edges-per-photo 40 --out result
	prints '^plus5  *rigid'
	says 'plus5-1.jpg: 88 corners, 40 edges'
	grep -q '"model": "rigid"' result/calibration.json || fail "calibration.json does not name the model"
	grep -q '(model rigid)' result/camera-plus5.inc || fail "camera-plus5.inc does not name the model"
	[ -s result/overlay-plus5-3.png ] || fail "no overlay" ;;
bad_edges_per_photo)
	for n in -1 3 11 2.5 many; do calibrate 2 "--edges-per-photo.*$n" "$target/untilted-1.jpg" --edges-per-photo=$n; done ;;
few_edges) # twelve edges of one photograph do not make a calibration
	calibrate 1 "only 12 edges.*--edges-per-photo" "$target/untilted-1.jpg" --edges-per-photo 12 ;;
*) echo "unknown case $case"; exit 99 ;;
esac
