#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Files of every kind that tiltcal writes, against calibration.schema.json.
#
#   json_schema.sh models|effects PYTHON SCHEMA WORK PROGRAM [PHOTOGRAPHS]
#
# models:  PROGRAM is tiltcal; `paper`, `rigid` with priors, one state with blades, a real lens at two stops, and what `import` writes
# effects: PROGRAM is test_tiltcal, whose tests leave files with colours, two rims and blades, without effects, and of circles
set -eu
case=$1 python=$2 schema=$3 work=$4 program=$5 photographs=${6:-}
check=$(cd "$(dirname "$0")" && pwd)/json_schema.py
rm -rf "$work" && mkdir -p "$work" && cd "$work"

calibrate() {
	"$program" calibrate --board 12x9 --square 25 --pitch 0.02 --untilted "$photographs/untilted-[1-3].jpg" --edges-per-photo 40 "$@" > log.txt 2>&1 ||
		{ tail -5 log.txt; exit 1; }
}

case $case in
models)
	calibrate --model paper --tilted plus5="$photographs/plus5-[1-3].jpg" --out paper
	calibrate --model rigid --tilted plus5="$photographs/plus5-[1-3].jpg" --fix f_number=2.8 --prior focal_length=45:0.5 --out rigid
	calibrate --model plane --effects none --fix blades=5 --out untilted
	"$program" calibrate --board 12x9 --square 25 --pitch 0.02 --edges-per-photo 40 --model lens --state untilted:f_number=2.8="$photographs/untilted-[1-3].jpg" \
		--state untilted:f_number=4="$photographs/untilted-[4-6].jpg" --out stops > log.txt 2>&1 || { tail -5 log.txt; exit 1; }
	"$program" export --calibration rigid/calibration.json --state plus5 --opencv plus5.yml
	"$program" import plus5.yml --pitch 0.02 --out imported.json
	set -- paper/calibration.json rigid/calibration.json untilted/calibration.json stops/calibration.json imported.json
	;;
effects)
	TEST_TMPDIR=$work "$program" --gtest_brief=1 \
		--gtest_filter=Effects.ReachTheIncAndThePoseThroughTheJson:Effects.NoneLeavesABareLens:CalibrateCircles.TiltFromASymmetricGrid > log.txt 2>&1 ||
		{ tail -5 log.txt; exit 1; }
	set -- effects-calibration.json none-calibration.json circles-calibration.json
	;;
esac
"$python" "$check" validate "$schema" "$@"
"$python" "$check" mutants "$schema" "$@"
