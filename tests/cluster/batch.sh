#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# tiltcal-batch on one machine; the third argument is the folder of photographs.
. "$(dirname "$0")/common.sh"
photos=$compare strips=$bin/tiltcal-batch
. "$here/batch_list.sh"

case $case in
usage)
	expect 0 --help; prints "Usage: tiltcal-batch"; expect 0 --version; grep -Eq '^tiltcal-batch [0-9]+\.[0-9]+\.[0-9]+$' out || fail "version"
	expect 2; says "LIST is required"
	expect 2 a b; says "one of them"
	expect 2 list --frobnicate; says "no option --frobnicate"
	expect 2 list --local 1 --nodes 2; says "exclude each other"
	expect 2 list --local 0; says "'0' is no number"
	expect 2 --line a; says "NAME FOLDER"
	expect 2 --summary a b; says "and nothing else"
	expect 3 nowhere.txt --local 1; says "nowhere.txt: cannot be read"
	expect 3 --summary nowhere; says "no batch of tiltcal-batch"
	# A wrong line by its file and number.
	check() { printf "$1\n" > list.txt; expect 2 list.txt --local 1; says "list.txt:$2"; }
	check '# cameras\n\n/up --board 12x9' "3: '/up' cannot be a camera's name"
	check 'a --square 25\na --square 26' "2: a is the name of line 1 too"
	check 'a --untilted "x' "1: No closing quotation"
	check 'a --out b' "1: leave out --out"
	check 'log --square 25' "1: 'log' cannot be"
	printf '#\n' > list.txt; expect 2 list.txt --local 1; says "no line names a camera"
	echo 'a --square 25' > list.txt
	expect 2 list.txt --local 1 --out list.txt; says "the results need a folder"
	expect 3 list.txt --local 1 --tiltcal ./nowhere; says "cannot be run"
	expect 0 list.txt --dry-run; prints "1 cameras, 1 to calibrate"; [ ! -e list ] || fail "a dry run leaves a folder"
	# Jobs of a run before: none where there is no Slurm or they are forgotten; not known where it does not answer.
	mkdir path list; for tool in sh env; do ln -s "$(command -v $tool)" path/; done; ln -s "$(python3 -c "import sys; print(sys.executable)")" path/python3
	echo '["7"]' > list/jobs.json
	here_only() { (PATH=$work/path "$strips" list.txt --local 1 > out 2> err); [ $? = 1 ] || fail "exit code, expected 1"; }
	here_only; prints "0 of 1 cameras are done"
	squeue() { printf '#!/bin/sh\necho "slurm_load_jobs error: %s" >&2\nexit 1\n' "$1" > path/squeue; chmod +x path/squeue; }
	squeue "Invalid job id specified"; here_only; prints "0 of 1 cameras are done"
	squeue "Unable to contact slurm controller (connect failure)"; here_only; says "squeue does not say whether job 7 .*Unable to contact" ;;
names)
	# Folders and photographs of Latin-1 (\351), as in strips.sh.
	export LC_ALL=C PYTHONIOENCODING=utf-8:strict
	there=$(printf 'd\351 x'); mkdir "$there"; cd "$there"
	cp "$photos"/untilted-1.jpg "$there-1.jpg"; cp "$photos"/untilted-3.jpg "$there-3.jpg"; cp "$photos"/plus5-[135].jpg .
	echo "plus --untilted '$there-*.jpg' --tilted plus5='plus5-*.jpg'" > list.txt; echo "absent --untilted '$there/*.jpg' --tilted plus5='plus5-*.jpg'" >> list.txt
	expect 1 list.txt --options "$common" --local 2; prints "1 of 2 cameras are done"; prints "^absent failed: .*$there"; prints "$there/list/summary.html"
	alone=$(sed -n 's/^  alone: //p' list/summary.txt); (cd / && sh -c "$alone") > out 2> err && fail "it fails, its command does not"
	prints "^absent failed"; grep -q "$there" list/summary.csv || fail "no name"
	expect 1 list.txt --options "$common" --local 2; prints "2 cameras, 1 to calibrate"
	cp "$photos"/untilted-5.jpg "$there-3.jpg"; expect 0 list.txt --options "$common" --dry-run; prints "2 cameras, 2 to calibrate" ;;
real)
	# Two cameras, and one whose photographs are not there: one table, the third named with the command that calibrates it alone.
	write_list > list.txt
	printf '#!/bin/sh\n[ "$1" = --version ] || echo "$*" >> %s/calls\nexec %s "$@"\n' "$work" "$bin/tiltcal" > cal; chmod +x cal
	batch() { expect "$1" list.txt --options "$common" --tiltcal ./cal --local 2; }
	batch 1; prints "3 cameras, 3 to calibrate"; prints "2 of 3 cameras are done"; prints "absent failed: .*nowhere"
	[ -s list/plus/report.html ] || fail "no report"
	prints '^plus  *[a-z]*  *4[0-9.]* ± '
	python3 "$here/batch_tables.py" list plus:done:2 minus:done:2 absent:failed:0 > out 2>&1 || fail "the tables disagree"
	alone=$(sed -n 's/^  alone: //p' list/summary.txt)
	# Nothing is calibrated twice, but what failed; then that too.
	: > calls; batch 1; prints "3 cameras, 1 to calibrate"; [ "$(grep -c . calls)" = 1 ] || fail "calibrated again: $(cat calls)"
	mkdir nowhere; cp "$photos"/plus5-[12].jpg nowhere/
	: > calls; (cd / && sh -c "$alone") > out 2> err || fail "its command"
	prints "3 of 3 cameras are done"; [ "$(grep -c . calls)" = 1 ] || fail "more than one: $(cat calls)"
	: > calls; batch 0; prints "3 cameras, 0 to calibrate"; [ ! -s calls ] || fail "calibrated again: $(cat calls)"
	# Another photograph, another option, a damaged result: these lines, and no other.
	cp "$photos"/plus5-3.jpg nowhere/2.jpg
	sed -i 's/^minus .*/& --effects none/' list.txt
	echo ' ' >> list/plus/calibration.json
	expect 0 list.txt --options "$common" --tiltcal ./cal --dry-run; prints "3 cameras, 3 to calibrate"
	printf '%s\n' "$(grep -v '^plus' list.txt)" > list.txt
	expect 0 list.txt --options "$common" --tiltcal ./cal --dry-run; prints "2 cameras, 2 to calibrate"
	# A camera of the model paper has no verdict; photographs after a second = count too.
	mkdir two; cp "$photos"/plus5-[12].jpg two/
	echo "old --untilted '$photos/untilted-[12].jpg' --tilted=plus5='two/*.jpg'" > old.txt
	paper="--board 12x9 --square 25 --pitch 0.02 --edges-per-photo 16 --model paper"
	expect 0 old.txt --options "$paper" --local 1; prints '^old  *not judged  *4[0-9.]* ± '
	expect 0 old.txt --options "$paper" --dry-run; prints "1 cameras, 0 to calibrate"
	cp "$photos"/plus5-3.jpg two/2.jpg
	expect 0 old.txt --options "$paper" --dry-run; prints "1 cameras, 1 to calibrate" ;;
*) echo "no such case: $case"; exit 99 ;;
esac
echo "all well"
