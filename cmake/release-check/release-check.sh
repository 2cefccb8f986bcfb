#!/bin/sh
# usage: release-check.sh TABLE FOLDER [STEP...]
# Runs the steps of TABLE (lines "NAME | COMMAND", # for remarks) in this folder, one after the other, also after one that failed; all, or
# those named. FOLDER receives NAME.log of each, and release-check.md: what passed, how long it took, and the command of each. A command that
# exits with 77 could not be run here, and its last line says why. What passed for this very commit, without changes beside it, is not run
# again, unless it is named: an interrupted check goes on. Exit code 0: all passed or were skipped, 1: some failed, 2: usage.
set -u
[ $# -ge 2 ] || { sed -n '2,7s/^# *//p' "$0" >&2; exit 2; }
table=$1 folder=$2; shift 2
wanted=" $* "
[ -f "$table" ] || { echo "release-check: $table: no such table" >&2; exit 2; }
names=$(sed -n '/^[[:space:]]*#/d; s/^\([^ |]*\) *|.*/\1/p' "$table")
for name in "$@"; do
	echo "$names" | grep -qxF -e "$name" || { echo "release-check: no step $name; there are" $names >&2; exit 2; }
done
mkdir -p "$folder" || exit 2
page=$folder/release-check.md rows=$folder/rows
rm -f "$page"
: >"$rows"
for log in "$folder"/*.log; do [ -e "${log%.log}.passed" ] || rm -f "$log"; done
# The commit, or nothing where that does not say what is checked.
commit=$(git rev-parse HEAD 2>/dev/null) && [ -z "$(git status --porcelain)" ] || commit=
passed=0 failed=0 skipped=0 begun=$(date +%s) running=

took() { # SECONDS
	awk -v s="$1" 'BEGIN { printf s < 60 ? "%d s" : s < 3600 ? "%d:%02d min" : "%d:%02d h", s < 60 ? s : s < 3600 ? s / 60 : s / 3600, s < 3600 ? s % 60 : s % 3600 / 60 }'
}
cell() { tr -d '\r\033' | sed 's/|/\\|/g' | cut -c1-200; }

# The page is whole after every step: an interrupted check shows how far it came.
write_page() { # VERDICT
	{
		echo "# Release check: $1"
		echo
		echo "$passed passed, $failed failed, $skipped skipped, in $(took $(($(date +%s) - begun)))."
		echo "$(date -u '+%Y-%m-%d %H:%M') UTC, commit $(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown), $(nproc) processors, $(uname -sm)."
		echo
		echo "| step | result | time | command | last words |"
		echo "|---|---|---|---|---|"
		cat "$rows"
	} >"$page.new" && mv "$page.new" "$page"
}
trap 'write_page "interrupted in $running"; echo "release-check: interrupted; see $page" >&2; exit 130' INT TERM HUP

while IFS= read -r line <&3; do
	case $line in '#'* | '') continue ;; esac
	name=${line%% |*} command=${line#* | }
	case $wanted in '  ' | *" $name "*) ;; *) continue ;; esac
	running=$name
	if [ "$wanted" = '  ' ] && [ -n "$commit" ] && [ "$(head -n 1 "$folder/$name.passed" 2>/dev/null)" = "$commit $command" ]; then
		passed=$((passed + 1))
		sed -n 2p "$folder/$name.passed" >>"$rows"
		echo "release-check: $name: passed before"
		continue
	fi
	rm -f "$folder/$name.passed"
	echo "release-check: $name: $command"
	start=$(date +%s)
	sh -c "$command" >"$folder/$name.log" 2>&1 </dev/null
	code=$?
	case $code in
	0)
		# ctest's own word for a test that found it could not run here.
		not_run=$(grep -c '\*\*\*Skipped' "$folder/$name.log")
		result=passed passed=$((passed + 1))
		[ "$not_run" = 0 ] || result="passed, but for $not_run skipped"
		;;
	77) result=skipped skipped=$((skipped + 1)) ;;
	*) result="**failed** ($code)" failed=$((failed + 1)) ;;
	esac
	row="| [$name]($name.log) | $result | $(took $(($(date +%s) - start))) | <code>$(echo "$command" | cell)</code> | $(grep -v '^[[:space:]]*$' "$folder/$name.log" | tail -n 1 | cell) |"
	echo "$row" >>"$rows"
	[ $code != 0 ] || printf '%s\n%s\n' "$commit $command" "$row" >"$folder/$name.passed"
	write_page "running"
	echo "release-check: $name: $result"
done 3<"$table"

[ $((passed + skipped + failed)) -gt 0 ] || { echo "release-check: $table: has no steps" >&2; exit 2; }
if [ $failed = 0 ]; then verdict=passed; else verdict=FAILED; fi
write_page "$verdict"
rm -f "$rows"
echo "release-check: $verdict: $passed passed, $failed failed, $skipped skipped; $page"
[ $failed = 0 ]
