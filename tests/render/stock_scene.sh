#!/bin/sh
# Renders one scene with stock POV-Ray and with ours, and says whether the pixels
# are the same. One line on stdout: same, DIFFERENT, skipped (stock fails or takes
# more than LIMIT seconds of a processor, or a sanitizer in ours stops at a fault of stock's that
# faults-of-others.txt names), or FAILED (ours does, stock does not).
#
#   stock_scene.sh STOCK OURS INCLUDE_DIR WORK LIMIT SCENE

stock=$1 ours=$2 include=$3 work=$4 limit=$5 scene=$6
id=$(printf '%s' "$scene" | cksum | cut -d' ' -f1)
folder=$(dirname "$scene")
here=$(cd "$(dirname "$0")" && pwd)
cd "$folder" || exit 1
# One thread and no gamma surprises: some of stock's features (radiosity, jitter)
# depend on the order of pixels.
# Seconds of a processor: a machine that does other things beside must not skip a scene. By the clock only against one that hangs.
render() (
	exec 2> /dev/null # what the shell says of one that is killed
	ulimit -t "$3"
	timeout 300 "$1" "+I$(basename "$scene")" "+O$work/$id-$2.ppm" +FP16 +W80 +H60 -D +WT1 -GA \
		"+L$include" "+L$folder" < /dev/null > "$work/$id-$2.log" 2>&1
)

# The header of a PPM carries the date; the pixels are its last 80 x 60 x 6 bytes. Files that are not there are not alike.
pixels() {
	[ "$(tail -c 28800 "$work/$id-$1.ppm" | wc -c)" = 28800 ] || { echo "no picture of $1"; return; }
	tail -c 28800 "$work/$id-$1.ppm" | cksum
}

# known_fault: whether ours stopped where the list says that stock itself errs in this scene.
known_fault() {
	while IFS='|' read -r file summary; do
		case $scene in */"${file% }") grep -qE -e "^SUMMARY: ${summary# }" "$work/$id-ours.log" && return ;; esac
	done < "$here/faults-of-others.txt"
	return 1
}

if ! render "$stock" stock "$limit"; then
	echo "skipped $scene"
elif ! render "$ours" ours $((limit * 10)); then
	known_fault && echo "skipped $scene" || echo "FAILED $scene (log $work/$id-ours.log)"
elif [ "$(pixels stock)" = "$(pixels ours)" ]; then
	echo "same $scene"
	rm -f "$work/$id"-*
else
	echo "DIFFERENT $scene"
fi
