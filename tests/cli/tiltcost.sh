#!/bin/sh
# usage: tiltcost.sh CASE TILTCOST POVRAY WORK
# Runs one case in a fresh folder WORK; exits 0 when the program behaved as documented.
set -u
case=$1 tiltcost=$2 povray=$3 work=$4
rm -rf "$work" && mkdir -p "$work/tmp" && cd "$work" || exit 99
# Temporary folders must be gone afterwards.
TMPDIR=$work/tmp; export TMPDIR

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }
expect() { # expect CODE ARGUMENT...
	want=$1; shift
	"$tiltcost" --povray "$povray" "$@" >out 2>err
	got=$?
	[ "$got" = "$want" ] || fail "exit code $got, expected $want: tiltcost $*"
	[ -z "$(ls tmp)" ] || fail "a temporary folder is left"
}
says() { grep -q -e "$1" err || fail "stderr does not say '$1'"; }
prints() { grep -q -e "$1" out || fail "stdout does not say '$1'"; }
silent() { [ ! -s out ] || fail "an error must print nothing on stdout"; }
refuses() { want=$1 text=$2; shift 2; expect "$want" "$@"; says "$text"; silent; }

scene() { # scene FILE CAMERA
	cat >"$1" <<END
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Colour) #declare Colour = 1; #end
camera { $2 location -5*z look_at 0 }
light_source { <3, 5, -5> rgb 1 }
plane { z, 3 pigment { checker rgb 0.2 rgb 0.8 scale 0.3 } }
sphere { 0, 1 pigment { rgb Colour } }
END
}
lens='tilt_lens { aperture_diameter 0.4 focal_distance 5 }'
small="+W96 +H72 +WT1 --pilot-time 0.5s"

case $case in
help) expect 0 --help; prints Example; prints "Exit codes"; prints "stops paying" ;;
version) expect 0 --version; grep -Eq '^tiltcost [0-9]+\.[0-9]+\.[0-9]+$' out || fail "version line" ;;
no_scene) refuses 2 SCENE ;;
bad_option) scene s.pov "$lens"; refuses 2 frobnicate s.pov --frobnicate ;;
bad_values)
	scene s.pov "$lens"
	refuses 2 "60s" s.pov --time 3x; refuses 2 "1/255" s.pov --error 0; refuses 2 excludes s.pov --time 3s --error 0.1
	refuses 2 MIN,MAX s.pov --setting 16,256; refuses 2 MIN,MAX s.pov --setting 32,16,0.1
	refuses 2 ".svg" s.pov --plot plot.gif ;;
no_povray) scene s.pov "$lens"; povray=./nowhere; refuses 3 "nowhere: no such program" s.pov ;;
unwritable)
	scene s.pov "$lens"; : >blocked
	refuses 3 blocked s.pov --csv blocked/table.csv; refuses 3 nowhere s.pov --plot nowhere/plot.svg ;;
table)
	scene s.pov "$lens"
	expect 0 s.pov $small --csv table.csv --plot plot.svg --setting 16,64,0.0001
	prints "8-bit"; prints "96 x 72 pixels, 1 thread"; prints "blur_samples [0-9]*, [0-9]*  variance"; prints "stops paying"
	prints "= .*blur_samples 16, 64  variance 0.0001"
	grep -q '^"s.pov",own,' table.csv || fail "no row of its own in the CSV"
	[ "$(head -1 table.csv | tr -cd , | wc -c)" = "$(tail -1 table.csv | tr -cd , | wc -c)" ] || fail "the CSV's rows are ragged"
	[ ! -e plot.svg ] || grep -q '<svg' plot.svg || fail "the plot is no SVG"
	# What POV-Ray would have written for itself.
	[ ! -e s.png ] || fail "the user's picture was written" ;;
questions)
	scene s.pov "$lens"
	expect 0 s.pov $small --error 1/100; prints "^blur_samples"; prints "RMS error 0.00"
	expect 0 s.pov $small --levels 2; prints "^blur_samples"
	expect 0 s.pov $small --time 1h; prints "^blur_samples"
	refuses 1 "coarsest" s.pov $small --time 0.001s
	refuses 1 "finest" s.pov $small --error 0.0000001 ;;
own_picture)
	# Output that the user's options name stays as it is.
	scene s.pov "$lens"; echo precious >mine.png
	expect 0 s.pov $small +Omine.png --error 0.02
	[ "$(cat mine.png)" = precious ] || fail "mine.png was overwritten" ;;
ini)
	scene s.pov "$lens"; printf 'Input_File_Name=s.pov\nWidth=64\nHeight=48\nDeclare=Colour=0.3\n' >s.ini
	expect 0 s.ini +WT1 --pilot-time 0.5s; prints "64 x 48" ;;
spaces)
	mkdir "a folder"; scene "a folder/a scene.pov" "$lens"
	expect 0 "a folder/a scene.pov" $small --error 0.02; prints "^blur_samples" ;;
part)
	scene s.pov "$lens"
	expect 0 s.pov $small +SR1 +ER36; prints "3.46 k of them" ;;
not_tilted) scene s.pov perspective; refuses 1 "tilt_lens" s.pov $small ;;
pinhole) scene s.pov tilt_lens; refuses 1 "aperture 0" s.pov $small ;;
broken) scene s.pov "$lens ["; refuses 1 "s.pov' line 4: Parse Error" s.pov $small ;;
missing) refuses 1 "nowhere.pov" nowhere.pov $small ;;
animation) scene s.pov "$lens"; refuses 1 "+SF" s.pov $small +KFI1 +KFF2 ;;
interrupt)
	scene s.pov "$lens"
	"$tiltcost" --povray "$povray" s.pov +W640 +H480 +WT1 --pilot-time 60s --pilot-blocks 4000 >out 2>err &
	pid=$!
	sleep 3
	kill -TERM $pid; wait $pid; got=$?
	[ $got = 143 ] || fail "exit code $got, expected 143"
	[ -z "$(ls tmp)" ] || fail "a temporary folder is left"
	silent; says interrupted ;;
*) echo "no such case: $case"; exit 99 ;;
esac
