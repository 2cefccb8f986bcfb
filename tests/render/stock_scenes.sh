#!/bin/sh
# Stock stays stock: scenes without tilt_lens give the same pixels as an unpatched POV-Ray, on POV-Ray's own
# distribution/scenes (stock_scene.sh compares one) and on a scene of ours per camera type.
#
#   stock_scenes.sh STOCK OURS DISTRIBUTION WORK
#
# STOCK is the distribution's povray: the same version as ours, and the same flags for floating point (no fast-math, no
# -march), so that it stands for an unpatched build of the same source.
# Exit 0: at least MINIMUM scenes are the same, among them every camera type and every focal-blur scene; none differs
# and none fails.
stock=$1 ours=$2 distribution=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
MINIMUM=150
LIMIT=2 # seconds of a processor that stock may take
PROCESSES=8 # POV-Ray sleeps most of a short render
TYPES="perspective orthographic fisheye ultra_wide_angle omnimax panoramic spherical cylinder mesh_camera"

[ -x "$stock" ] || { echo "no stock POV-Ray at '$stock'"; exit 1; }
rm -rf "$work"
mkdir -p "$work"
scenes="$distribution/scenes"
failures=0

# scenes_with WORD: those that have it in the first lines of a camera.
scenes_with() {
	find "$scenes" -name '*.pov' | LC_ALL=C sort | while read -r scene; do
		# Comments out, one line.
		sed 's|//.*||' "$scene" | tr '\n\t\r' '   ' | grep -qE "camera *\{[^}]*[ {]$1[ }]" && echo "$scene"
	done
	true
}
for type in $TYPES; do
	scenes_with "$type" > "$work/type-$type"
done
scenes_with '(aperture|blur_samples)' > "$work/type-blur"

# Each type once more by itself.
for camera in 0 1 2 3 4 5 6 7 8 9 10 11 12; do
	mkdir "$work/camera$camera"
	printf '#declare Camera = %d;\n#include "%s/camera_types.pov"\n' $camera "$here" > "$work/camera$camera/camera.pov"
	cp "$here/oracle-scene.inc" "$work/camera$camera"
	echo "$work/camera$camera/camera.pov"
done > "$work/own"

find "$scenes" -name '*.pov' | LC_ALL=C sort | cat - "$work/own" | xargs -P $PROCESSES -I SCENE \
	"$here/stock_scene.sh" "$stock" "$ours" "$distribution/include" "$work" $LIMIT SCENE > "$work/results"

count() {
	grep -c "^$1 " "$2"
}
same=$(count same "$work/results") different=$(count DIFFERENT "$work/results")
failed=$(count FAILED "$work/results") skipped=$(count skipped "$work/results")
all=$(find "$scenes" -name '*.pov' | cat - "$work/own" | wc -l)
[ "$((same + different + failed + skipped))" -eq "$all" ] || { echo "FAILED: of $all scenes not each has one line of results"; failures=1; }
echo "$same scenes are the same, $different are not, $failed fail in ours alone, $skipped skipped (no scene, slow, or stock errs itself)"
grep -E '^(DIFFERENT|FAILED) ' "$work/results"
[ "$same" -ge $MINIMUM ] || { echo "FAILED: fewer than $MINIMUM"; failures=1; }
[ "$different" -eq 0 ] && [ "$failed" -eq 0 ] || failures=1

grep '^same ' "$work/results" | cut -d' ' -f2- > "$work/same"
for type in $TYPES blur; do
	occurs=$(wc -l < "$work/type-$type")
	alike=$(grep -cxFf "$work/type-$type" "$work/same")
	echo "$type: $occurs scenes, $alike of them compared and the same"
	[ "$type" = blur ] && { [ "$occurs" -eq 0 ] || [ "$alike" -ne "$occurs" ]; } && { echo "FAILED: not every focal-blur scene"; failures=1; }
	[ "$occurs" -eq 0 ] || [ "$alike" -gt 0 ] || { echo "FAILED: no $type"; failures=1; }
done
own=$(grep -cxFf "$work/own" "$work/same")
echo "our own scenes, one per camera type: $own of 13"
[ "$own" -eq 13 ] || { grep "$work/camera" "$work/results" | grep -v '^same'; failures=1; }
exit $failures
