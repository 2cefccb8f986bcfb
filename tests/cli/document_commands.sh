#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Every command in a document is run by a test or stands in document_commands.list with the reason why not.
#
#   document_commands.sh listed|run ROOT BUILD WORK
#
# listed: holds the list against the documents, and names of presets, targets and tests against what there is
# run:    runs those of the list that no other test does
set -u
case=$1 root=$2 build=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99
tab=$(printf '\t')
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

sed -n 's/^\(run\|test\|not\) | \(.*\) |[ ]*\(.*\)$/\1\t\2\t\3/p' "$here/document_commands.list" > list.txt
[ "$(grep -c . list.txt)" = "$(grep -c '^[^#]' "$here/document_commands.list")" ] || fail "document_commands.list: a line that is not KIND | COMMAND | NOTE"

# is_command WORD: whether a line that begins with WORD is a command and not a piece of a scene, a table or the map.
is_command() {
	case $1 in
		build/* | povray-patch/*.sh | tiltcal | tiltcost | povray-tilt | cd | [A-Z]=* | PYTHONPATH=*) return 0 ;;
		apt* | chromium | ffmpeg | git | sudo | cmake | ctest | ninja | make | python3) return 0 ;;
		-* | *[!a-zA-Z0-9_.+-]*) return 1 ;;
	esac
	case $(command -v "$1" 2> /dev/null) in /*) return 0 ;; esac
	# The programs of the build, the tests' own included.
	grep -q "^build $1: phony [^ ]*/$1\$" "$build/build.ninja"
}

# rendered DOCUMENT: whether documents.sh renders its commands.
rendered() {
	name=$(printf '%s\n' "$1" | sed 's,^scenes/,,; s,/README\.md$,,')
	grep -qx "render.documents.$name" tests.txt
}

# exists COMMAND: what it asks CMake or CTest for is there.
exists() {
	for preset in $(printf '%s\n' "$1" | grep -o -e '--preset [a-z-]*' | sed 's/.* //'); do
		grep -q "\"name\": \"$preset\"" "$root/CMakePresets.json" || fail "$1: no preset $preset"
	done
	case $1 in
		*build/asan*) ;; # configured elsewhere
		*) for target in $(printf '%s\n' "$1" | grep -o -e '--target [a-z-]*' | sed 's/.* //'); do
			grep -q "^build $target: " "$build/build.ninja" || fail "$1: no target $target"
		done ;;
	esac
	pattern=$(printf '%s\n' "$1" | sed -n "s/^ctest --preset release -R '*\([^ ']*\).*/\1/p")
	[ -z "$pattern" ] || grep -Eq -e "$pattern" tests.txt || fail "$1: no such test"
	case $1 in ctest\ -*) case $1 in "ctest --preset "*) ;; *) fail "$1: finds no tests at the repository's top: give --preset" ;; esac ;; esac
	label=$(printf '%s\n' "$1" | sed -n 's/^ctest --preset release -L \([^ ]*\).*/\1/p')
	[ -z "$label" ] || (cd "$build" && ctest -N -L "$label") | grep -q 'Test *#' || fail "$1: no test has the label"
}

listed() {
	(cd "$build" && ctest -N) | sed -n 's/^ *Test *#[0-9]*: //p' > tests.txt
	[ -s tests.txt ] || fail "ctest -N lists no test in $build"
	# Neither the build's nor a helper's copies of documents.
	(cd "$root" && find . -name '*.md' ! -path './build/*' ! -path './out/*' ! -path './.*' | sed 's,^\./,,' | sort) > documents.txt
	(cd "$root" && xargs awk -f "$here/document_commands.awk" < "$work/documents.txt") > lines.txt
	: > commands.txt
	while IFS="$tab" read -r document command; do
		is_command "${command%% *}" && printf '%s\t%s\n' "$document" "$command" >> commands.txt
	done < lines.txt
	while IFS="$tab" read -r document command; do
		grep -qF -e "$tab$command$tab" list.txt && continue
		case $command in
			"build/release/bin/povray scenes/"*) rendered "$document" && continue ;;
			"man "*) grep -qx "cli\.man\.${command#man }" tests.txt && continue ;;
		esac
		fail "$document: '$command' is neither run by a test nor listed in tests/cli/document_commands.list"
	done < commands.txt
	while IFS="$tab" read -r kind command note; do
		grep -qF -e "$tab$command" commands.txt && cut -f 2 commands.txt | grep -qxF -e "$command" ||
			fail "no document has '$command' any more; take it out of document_commands.list"
		exists "$command"
		case $kind in
			test) grep -qxF -e "$note" tests.txt || fail "$command: no test $note" ;;
			not) [ -n "$note" ] || fail "$command: no reason" ;;
		esac
	done < list.txt
	echo "$(grep -c . commands.txt) commands in $(grep -c . documents.txt) documents"
}

# points: corners of a photograph of the board, tilted by 5 degrees, with their places on it.
points() {
	build/release/bin/tiltcal detect --board 12x9 scenes/boxes/photos/target/plus5-1.jpg --csv corners.csv > log.txt 2>&1 || return
	awk -F, 'NR == 1 { print "u_px,v_px,x,y,z" } NR > 1 { printf "%s,%s,%d,%d,0\n", $4, $5, 25 * $2, -25 * $3 }' corners.csv > points.csv
	awk -F, 'NR == 1 { print "u_px,v_px" } NR > 1 { print $4 "," $5 }' corners.csv > pixels.csv
	awk -F, 'NR == 1 { print "x,y,z" } NR > 1 { printf "%d,%d,600\n", 25 * $2, -25 * $3 }' corners.csv > places.csv
}

run() {
	# The repository's top, as the commands see it: what they write goes elsewhere.
	mkdir -p tree/build/release tree/out/demo && cd tree || exit 99
	ln -s "$root/scenes" scenes
	mkdir tests && ln -s "$root/tests/accuracy" tests/accuracy
	ln -s "$build/bin" build/release/bin
	ln -s "$build/povray" build/release/povray
	ln -s ../calibration out/demo/calibration
	cp -r "$root/povray-patch" povray-patch
	mkdir cmake && cp "$root"/cmake/*.cmake cmake/
	TMPDIR=$work
	export TMPDIR
	points || fail "no points.csv: $(tail -3 log.txt)"
	while IFS="$tab" read -r kind command note; do
		[ "$kind" = run ] || continue
		small=$(printf '%s\n' "$command" | sed "$note")
		start=$(date +%s)
		if sh -c "$small" > log.txt 2>&1 < /dev/null; then
			echo "$(($(date +%s) - start)) s: $small"
		else
			fail "$small: $(tr '\r' '\n' < log.txt | tail -5)"
		fi
	done < ../list.txt
	for file in board.pdf out/calibration/camera-plus5.inc out/profile/profile.png board.png plus5.png out/sketch.html out/sketch-plus5.jpg cost.svg; do
		[ -s $file ] || fail "no $file was written"
	done
	grep -q '</svg>' out/sketch.html || fail "no sketch in out/sketch.html"
	diff -r "$root/povray-patch/patches" povray-patch/patches > log.txt && cmp -s "$root/povray-patch/series" povray-patch/series ||
		fail "the patches do not come back as they went: $(head -5 log.txt)"
	cd "$work" && rm -rf tree
}

case $case in
listed | run) $case ;;
*) fail "no such case: $case" ;;
esac
[ $failures -eq 0 ] && echo "all well" && exit 0
echo "$failures failures"
exit 1
