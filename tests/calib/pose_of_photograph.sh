#!/bin/sh
# usage: pose_of_photograph.sh TILTCAL CALIBRATION PHOTO STATE NUMBER WORK
# The corners of one calibration photograph, given to `tiltcal pose` as points of a scene: the camera must be found where
# the calibration itself put it (the .inc's TiltCal_<STATE>_Photo_<NUMBER>_Location).
set -eu
tiltcal=$1 calibration=$2 photo=$3 state=$4 number=$5 work=$6
rm -rf "$work" && mkdir -p "$work" && cd "$work"

"$tiltcal" detect --board 12x9 "$photo" --csv corners.csv
awk -F, 'NR == 1 { print "u_px,v_px,x,y,z" } NR > 1 { printf "%s,%s,%d,%d,0\n", $4, $5, 25 * $2, -25 * $3 }' corners.csv >points.csv
"$tiltcal" pose --thin-lens --calibration "$calibration/calibration.json" --state "$state" --points points.csv --out camera.inc | tail -2
location() { sed -n "s/^[^<]*$1[ =]*<\(.*\)>;*\$/\1/p" "$2" | head -1; }
# 1.5 mm of some 800: the calibration shares its poses between the states, whose pupils differ by parts of a millimetre.
near() {
	echo "$1, $2" | awk -F, '{ d = sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2); print d " mm apart"; exit !(NF == 6 && d < 1.5) }'
}
near "$(location '	location' camera.inc)" "$(location "_Photo_${number}_Location" "$calibration/camera-$state.inc")"

# The same through the real lens, whose part of the .inc comes last and is taken where nothing is said.
"$tiltcal" pose --calibration "$calibration/calibration.json" --state "$state" --points points.csv --out real.inc | tail -2
grep -q 'aberrations {' real.inc || { echo "no aberrations in real.inc"; exit 1; }
"$tiltcal" pose --real-lens --calibration "$calibration/calibration.json" --state "$state" --points points.csv --out asked.inc >/dev/null
cmp real.inc asked.inc
tac "$calibration/camera-$state.inc" >backwards.inc
near "$(location '	location' real.inc)" "$(location "_Photo_${number}_Location" backwards.inc)"

# The overlay draws the fit that is written: the same crossings, how far off they are through either lens.
for lens in real thin; do
	"$tiltcal" pose --$lens-lens --calibration "$calibration/calibration.json" --state "$state" --points points.csv --photo "$photo" --overlay $lens.png --out $lens-photo.inc >/dev/null
done
! cmp -s real.png thin.png || { echo "one overlay for two lenses"; exit 1; }
# A photograph is not drawn over.
cp "$photo" mine.jpg
if "$tiltcal" pose --calibration "$calibration/calibration.json" --state "$state" --points points.csv --photo mine.jpg --overlay ./mine.jpg --out x.inc 2>err; then exit 1; fi
grep -q -- '--overlay ./mine.jpg: would write over what --photo reads' err && cmp "$photo" mine.jpg && [ ! -e x.inc ]
grep -q 'aberrations {' real-photo.inc && ! grep -q 'aberrations {' thin-photo.inc
