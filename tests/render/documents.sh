#!/bin/sh
# The commands of the documents that render a scene of the repository, at a size that takes a second.
#
#   documents.sh DOCUMENT STOCK OURS COMPARE WORK
. "$(dirname "$0")/common.sh"
root=$(cd "$here/../.." && pwd)
count=0

grep -h '^    build/release/bin/povray scenes/' "$root/$case" | sed 's/ *#.*//' > commands.txt
while read -r program scene options; do
	case $options in
		*out/demo*) continue ;; # needs the demo's calibration: render.boxes and render.board run those scenes
	esac
	# Paths are from the top of the repository; size and the output's folder are ours, and later commands find there
	# what earlier ones made. $options: words.
	name=$(printf '%s\n' "$options" | sed -n 's/.*+O\([^ ]*\).*/\1/p')
	name=$(basename "${name:-picture}" | sed 's/\.[a-z]*$//')
	rm -f "$work/$name"*.png
	if (cd "$root" && "$ours" "$scene" $options -D +W48 +H27 "+L$work" "+O$work/$name.png" +FN8) > log.txt 2>&1 < /dev/null; then
		# One, or the frames of an animation.
		ls "$work/$name"*.png > pictures.txt 2> /dev/null || fail "$scene $options: no picture"
		echo "$program $scene $options"
		count=$((count + 1))
	else
		fail "$scene $options: $(tr '\r' '\n' < log.txt | grep -i -A3 error | head -6)"
	fi
done < commands.txt
[ $count -gt 0 ] || fail "no command found in $case"
finish
