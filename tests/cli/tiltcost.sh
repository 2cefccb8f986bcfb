#!/bin/sh
# usage: tiltcost.sh CASE TILTCOST POVRAY WORK
# Runs one case in a fresh folder WORK; exits 0 when the program behaved as documented.
set -u
here=$(cd "$(dirname "$0")" && pwd)
case=$1 tiltcost=$2 povray=$3 work=$4
rm -rf "$work" && mkdir -p "$work/tmp" && cd "$work" || exit 99
# Temporary folders must be gone afterwards.
TMPDIR=$work/tmp; export TMPDIR

. "$here/tiltcost_says.sh"

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
	refuses 2 "--csv s.pov: would write over what SCENE reads" s.pov --csv s.pov
	cp s.pov t.pov; printf '[fast]\n' >"my film.ini"
	for own in t.pov "my film.ini"; do refuses 2 "would write over what SCENE reads" "my film.ini[fast]" t.pov s.pov --csv "$own"; done
	refuses 2 "is the file of --plot too" s.pov --plot x.svg --csv ./x.svg
	refuses 3 blocked s.pov --csv blocked/table.csv; refuses 3 nowhere s.pov --plot nowhere/plot.svg
	# A folder that one may not write into; root may, so nobody tries.
	mkdir locked; chmod 555 locked; chmod 777 tmp; as=
	[ "$(id -u)" -ne 0 ] || as="setpriv --reuid=65534 --regid=65534 --clear-groups"
	$as test -x "$tiltcost" -a -x "$povray" || { echo "SKIPPED: nobody cannot reach $tiltcost, and this is root: a locked folder is not tested"; exit 77; }
	$as "$tiltcost" --povray "$povray" s.pov --csv locked/table.csv >out 2>err
	[ $? = 3 ] || fail "a locked folder is written into"
	says "locked/table.csv: cannot be written"; silent ;;
table)
	scene s.pov "$lens"
	expect 0 s.pov $small --csv table.csv --plot plot.svg --setting 16,64,0.0001
	prints "8-bit"; prints "96 x 72 pixels, 1 thread"; prints "blur_samples [0-9]*, [0-9]*  variance"; prints "stops paying"
	prints "= .*blur_samples 16, 64  variance 0.0001"
	grep -q '^"s.pov",own,' table.csv || fail "no row of its own in the CSV"
	[ "$(head -1 table.csv | tr -cd , | wc -c)" = "$(tail -1 table.csv | tr -cd , | wc -c)" ] || fail "the CSV's rows are ragged"
	awk -F, 'NR > 1 && !($15 > 0) { exit 1 }' table.csv || fail "denoise takes no time"
	grep -q '<svg' plot.svg || fail "there is no plot, or it is no SVG"
	# What POV-Ray would have written for itself.
	[ ! -e s.png ] || fail "the user's picture was written"
	# What the scene says holds for all rows, but for one that names its own.
	scene s.pov "$lens blur_samples 4, 16 variance 0.001 confidence 0.99"
	expect 0 s.pov $small --csv table.csv --setting 4,16,0.001 --setting 4,16,0.001,0.5
	prints "= .*blur_samples 4, 16  variance 0.001  confidence 0.99$"; prints "= .*blur_samples 4, 16  variance 0.001  confidence 0.5$"
	[ "$(grep -c ',0\.99,' table.csv)" = $(($(wc -l <table.csv) - 2)) ] || fail "not all rows but one have the scene's confidence" ;;
questions)
	scene s.pov "$lens"
	expect 0 s.pov $small --error 1/100; prints "^blur_samples"; prints "RMS error 0.00"
	expect 0 s.pov $small --levels 2; prints "^blur_samples"
	expect 0 s.pov $small --time 1h; prints "^blur_samples"
	refuses 1 "coarsest" s.pov $small --time 0.001s
	# An answer of few blocks does not look surer than one of many: 4 are always traced.
	expect 0 s.pov +W640 +H480 +WT1 --pilot-time 0.001s --error 0.02; prints "^Predicted from [0-9]* blocks, too few to say how surely"
	! grep -q "is known to" out || fail "sure of what few blocks say"
	# The best of all settings with denoise and without, within the time; then the best without. Time enough for 20 blocks also under sanitizers.
	expect 0 s.pov +W640 +H480 +WT1 --pilot-time 4s --time 10s
	[ "$(grep -c 'error is known to [1-9][0-9]* %, the time to [1-9][0-9]* % (one standard deviation)' out)" = 2 ] || fail "an answer does not say how sure it is"
	prints "^Without denoise:"; head -1 out | grep -q 'tilt_lens { denoise }' || fail "the first answer is not denoised"
	sed -n 's/^ *RMS error \([0-9.]*\).* per pixel; \([0-9.]*\) s .*/\1 \2/p' out |
		awk '{ print; e[NR] = $1; late += $2 > 10 } END { exit !(NR == 2 && e[1] < e[2] && !late) }' || fail "late, or not the best first"
	refuses 1 "finest" s.pov $small --error 0.0000001
	expect 0 s.pov $small --error 0.02 --setting 16,64,0.0001; [ "$(grep -c '^Named by --setting:' out)" = 1 ] && prints "^blur_samples 16, 64  variance 0.0001" || fail "the setting that was named is not there" ;;
own_picture)
	# Output that the user's options name stays as it is.
	scene s.pov "$lens"; echo precious >mine.png
	expect 0 s.pov $small +Omine.png --error 0.02
	[ "$(cat mine.png)" = precious ] || fail "mine.png was overwritten" ;;
ini)
	scene s.pov "$lens"; printf 'Input_File_Name=s.pov\nWidth=64\nHeight=48\nDeclare=Colour=0.3\n' >s.ini
	expect 0 s.ini +WT1 --pilot-time 0.5s; prints "64 x 48" ;;
ini_in_path)
	# A path that contains ".ini" is not an ini file for that; and an ini file may lie in such a folder.
	mkdir my.ini.d; scene my.ini.d/s.pov "$lens"; printf 'Input_File_Name=my.ini.d/s.pov\nWidth=64\nHeight=48\n' >my.ini.d/s.ini
	expect 0 my.ini.d/s.pov $small --error 0.02; prints "^blur_samples"
	expect 0 my.ini.d/s.ini +WT1 --pilot-time 0.5s; prints "64 x 48" ;;
no_plot)
	# Without gnuplot no plot can be made: said before the work, and an error.
	scene s.pov "$lens"; mkdir bin; for tool in sh cat; do ln -s "$(command -v $tool)" bin; done
	path=$PATH; PATH=$work/bin
	"$tiltcost" --povray "$povray" s.pov $small --plot plot.svg >out 2>err
	got=$?; PATH=$path
	[ $got = 3 ] || fail "exit code $got, expected 3"
	says "install gnuplot-nox"; silent
	# One that fails: no plot, no success.
	printf '#!/bin/sh\n[ "$1" = --version ]\n' >bin/gnuplot; chmod +x bin/gnuplot; PATH=$work/bin:$path
	refuses 3 "plot.svg: not plotted" s.pov $small --plot plot.svg
	PATH=$path
	[ ! -e plot.svg ] || fail "a plot is left" ;;
writes)
	# A scene that writes files is not parsed twice unasked, and what it would have overwritten stays.
	for how in write append; do
		scene s.pov "$lens"; printf '#fopen Log "log.txt" %s\n#write (Log, "parsed\\n")\n#fclose Log\n' $how >>s.pov
		echo precious >log.txt
		refuses 1 "opens a file for writing" s.pov $small --error 0.02; says "scene-may-write"; says log.txt
		[ "$(cat log.txt)" = precious ] || fail "log.txt was written"
	done
	expect 0 s.pov $small --error 0.02 --scene-may-write; prints "^blur_samples"
	[ "$(grep -c parsed log.txt)" = 2 ] || fail "log.txt is not written twice: $(cat log.txt)"
	# A film's frames are asked for by a process that writes nothing.
	expect 0 s.pov $small +KFI1 +KFF3 --frames 1 --error 0.02 --scene-may-write; prints "^blur_samples"
	# Reading is no writing.
	scene s.pov "$lens"; echo '1, 2' >numbers.txt; printf '#fopen In "numbers.txt" read\n#read (In, A, B)\n#fclose In\n' >>s.pov
	expect 0 s.pov $small --error 0.02; prints "^blur_samples" ;;
keeps)
	# Photons and radiosity that the scene or the user's options save stay as they are.
	scene s.pov "$lens"; echo 'global_settings { photons { count 2000 save_file "caustics.ph" } } sphere { <1, 0, -1>, 0.4 pigment { rgbt 1 } interior { ior 1.5 } photons { target refraction on } }' >>s.pov
	echo precious >caustics.ph; echo precious >light.rca
	echo precious >frozen.ini
	expect 0 s.pov $small --error 0.02 +RFO +RFlight.rca +GIfrozen.ini
	[ "$(cat frozen.ini)" = precious ] || fail "frozen.ini was overwritten"
	[ "$(cat caustics.ph)" = precious ] || fail "caustics.ph was overwritten"
	[ "$(cat light.rca)" = precious ] || fail "light.rca was overwritten"
	# Which a render does overwrite.
	"$povray" s.pov -D +W8 +H6 +Os.png >log.txt 2>&1 || fail "the scene does not render"
	[ "$(head -c 8 caustics.ph)" != precious ] || fail "the scene saves no photons: nothing shown" ;;
radiosity)
	# A pretrace of several seconds, whose pixels POV-Ray counts before there is any block.
	scene s.pov "$lens"; echo 'global_settings { radiosity { count 80 pretrace_start 0.04 pretrace_end 0.004 nearest_count 20 error_bound 0.2 low_error_factor 0.3 } }' >>s.pov
	expect 0 s.pov +W160 +H120 +WT1 --pilot-time 0.5s; prints "blur_samples [0-9]*, [0-9]*  variance"
	# tiltcost's patience with cameras that have no lens is 3 s.
	sed -n 's/.*Before the first ray: \([0-9.]*\) s.*/\1/p' out | awk '{ good = $1 > 3 } END { exit !(NR == 1 && good) }' || fail "too short a pretrace: nothing shown"
	scene s.pov perspective; echo 'global_settings { radiosity { count 100 } }' >>s.pov; refuses 1 "tilt_lens" s.pov $small ;;
pilot_time)
	# By the clock, also where two threads share one processor: 1 s for both pilots, and what a block lasts that has begun.
	scene s.pov "$lens"
	one=$(command -v taskset) && one="$one -c 0" || fail "no taskset (util-linux)"
	$one "$tiltcost" --povray "$povray" s.pov +W160 +H120 +WT8 --pilot-time 1s >out 2>err || fail "tiltcost on one processor"
	prints "8 threads"
	# Wall seconds of both pilots, of which the start was there twice: above them 1 s, and the blocks of 8 threads that were begun, which
	# were planned as if 8 threads had 8 processors: a pilot of 1024 samples lasts 8 times as long without the bound.
	sed -n 's/^Pilot: \([0-9]*\) blocks.*, in \([0-9.]*\) s. Before the first ray: \([0-9.]*\) s.*/\1 \2 \3/p' out |
		awk '{ print "one processor:", $0; good = NF == 3 && $1 >= 4 && $2 - 2 * $3 < 3 } END { exit !(NR == 1 && good) }' || fail "longer than its time: $(sed -n 2p out)" ;;
spaces)
	mkdir "a folder"; scene "a folder/a scene.pov" "$lens"
	expect 0 "a folder/a scene.pov" $small --error 0.02; prints "^blur_samples" ;;
rows)
	# Where the time goes, for what the scene says: seconds of every row, which povray-strips reads.
	scene s.pov "$lens blur_samples 8, 64 variance 0.001"
	expect 0 s.pov $small --rows rows.json; silent
	python3 -c 'import json; r = json.load(open("rows.json")); t = r["row_s"]
assert len(t) == 72 and min(t) > 0 and r["margin_rows"] == 2 and r["setting"].startswith("blur_samples 8, 64"), r' || fail "rows.json"
	expect 0 s.pov $small --rows rows.json --setting 0,4,0
	python3 -c 'import json; r = json.load(open("rows.json")); assert r["margin_rows"] == 0 and r["setting"].startswith("blur_samples 4 "), r' || fail "--setting"
	# Margins are of more than one number of samples, wider where the first is below 4, and of denoise, which is the scene's word.
	scene s.pov "tilt_lens { aperture_diameter 0.4 focal_distance 5 denoise } blur_samples 8"
	for told in 4,16,0=24 3,16,0.001=26 2,16,0.001=27; do
		expect 0 s.pov $small --rows rows.json --setting ${told%=*}
		grep -q "\"margin_rows\":${told#*=}," rows.json || fail "margins of $told: $(head -c 300 rows.json)"
	done
	refuses 2 "MIN,MAX" s.pov --setting 1,64,5
	refuses 2 "goes with none of" s.pov $small --rows rows.json --time 3s
	refuses 3 nowhere s.pov --rows nowhere/rows.json ;;
part)
	scene s.pov "$lens"
	expect 0 s.pov $small +SR1 +ER36; prints "3.46 k of them"
	# Parts in which the whole picture's first blocks do not lie, or none begins.
	expect 0 s.pov +W960 +H720 +SC100 +EC139 +SR100 +ER131 --pilot-time 1s; prints "1.28 k of them"; prints "Pilot: [4-9] blocks"
	expect 0 s.pov +W96 +H72 +SR5 +ER12 --pilot-time 1s; prints "768 of them" ;;
not_tilted) scene s.pov perspective; refuses 1 "tilt_lens" s.pov $small ;;
pinhole) scene s.pov tilt_lens; refuses 1 "aperture 0" s.pov $small ;;
broken) scene s.pov "$lens ["; refuses 1 "s.pov' line 4: Parse Error" s.pov $small ;;
missing) refuses 1 "nowhere.pov" nowhere.pov $small ;;
animation) scene s.pov "$lens"; refuses 1 "--frames 5.*+SF" s.pov $small +KFI1 +KFF2 ;;
frames)
	# A film whose sphere grows from nothing: all frames' figures together, and those of the frames that had pilots.
	scene s.pov "$lens"; sed -i 's/sphere { 0, 1/sphere { 0, 0.01 + 2 * clock/' s.pov
	expect 0 s.pov $small +KFI1 +KFF24 --frames 4 --csv film.csv
	prints "A film of 24 frames, 1 to 24"
	for frame in 4 10 16 22; do prints "^ *$frame  *0\.[0-9]* "; done
	# Of a part of it, the middle frames of its parts; its time is a part of the whole's.
	expect 0 s.pov $small +KFI1 +KFF24 +SF9 +EF12 --frames 9 --error 0.02
	for frame in 9 10 11 12; do prints "^ *$frame  *0\.0[0-9]* "; done
	prints "^blur_samples"
	refuses 1 "no animation" s.pov $small --frames 3
	printf 'Input_File_Name=s.pov\nInitial_Frame=1\nFinal_Frame=24\nSubset_Start_Frame=3\nSubset_End_Frame=7\n' >s.ini
	refuses 1 "5 of 24 frames; say on the command line which" s.ini $small --frames 3
	expect 0 s.ini $small +SF3 +EF7 --frames 1 --error 0.02; prints "^ *5  *0\.0"
	refuses 2 "one picture" s.pov $small --frames 3 --rows rows.json
	# A busy machine's POV-Ray: which frames there are comes long after how many.
	cat >late <<END
#!/bin/bash
set -o pipefail
"$povray" "\$@" 2>&1 | while IFS= read -r line; do printf '%s\n' "\$line"; case \$line in "Rendering frame 1 of"*) sleep 1 ;; esac; done >&2
END
	chmod +x late; povray=$PWD/late
	expect 0 s.pov $small +KFI1 +KFF24 --frames 1 --error 0.02; prints "^ *13  *0\.0" ;;
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
