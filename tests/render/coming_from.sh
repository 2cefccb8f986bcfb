#!/bin/sh
# The scenes of povray-patch/COMING-FROM.md, small, and what they say of their own statistics.
#
#   coming_from.sh CASE STOCK OURS COMPARE WORK
#
# A scene is a block between "```pov" and "```"; its first line is "// NAME: ...". CASE is `scenes`: all of them.
. "$(dirname "$0")/common.sh"
root=$(cd "$here/../.." && pwd)

awk '/^```pov$/ { inside = 1; name = ""; next }
	/^```$/ { inside = 0; next }
	inside && name == "" { name = $2; sub(/:$/, "", name); print name > "names.txt" }
	inside { print > (name ".pov") }' "$root/povray-patch/COMING-FROM.md"
[ "$(grep -c . names.txt)" -ge 5 ] || fail "no scenes in COMING-FROM.md"

# Runs of spaces are one.
plain() { tr -s ' \t' ' ' | sed 's/^ //'; }
for name in $(cat names.txt); do
	if ! "$ours" "+I$name.pov" "+L$root/scenes/first-tilt" "+O$name.png" -D +W64 +H36 +WT1 > raw.log 2>&1 < /dev/null; then
		fail "$name: $(tr '\r' '\n' < raw.log | grep -i -A3 error | head -6)"
		continue
	fi
	tr '\r' '\n' < raw.log | plain > "$name.log"
	grep '^// statistics:' "$name.pov" | sed 's,^// statistics: *,,' | plain > wanted.txt
	[ -s wanted.txt ] || fail "$name says nothing of its statistics"
	while IFS= read -r line; do
		grep -qF -e "$line" "$name.log" || fail "$name: no '$line' in the statistics: $(sed -n '/^Tilt lens/,/^Estimated/p' "$name.log")"
	done < wanted.txt
	echo "$name: $(grep -c . wanted.txt) lines of statistics"
done

# An opening that is half as wide as high blurs less across: not the same picture as with the round one.
cp "arnold-anamorphic.pov" round.pov
sed -i 's/scale <0.25, 0.5, 1>/scale <0.5, 0.5, 1>/' round.pov
"$ours" +Iround.pov "+L$root/scenes/first-tilt" +Oround.png -D +W64 +H36 +WT1 > raw.log 2>&1 < /dev/null || fail "round.pov"
! cmp -s round.png arnold-anamorphic.png || fail "the shape of the opening does not matter"
finish
