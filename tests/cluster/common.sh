# Sourced by the cluster tests: SCRIPT CASE PROGRAMS COMPARE WORK. PROGRAMS is the build's bin/, COMPARE compare_pictures, WORK a
# folder that is emptied first.
set -u
case=$1 bin=$2 compare=$3 work=$4
here=$(cd "$(dirname "$0")" && pwd)
strips=$bin/povray-strips
rm -rf "$work" && mkdir -p "$work/tmp" && cd "$work" || exit 99
# What is made on the way must be gone afterwards.
TMPDIR=$work/tmp
export TMPDIR

fail() {
	echo "FAILED: $*"
	for said in out err; do [ ! -s $said ] || { echo "--- $said"; cat $said; }; done
	exit 1
}
# expect CODE ARGUMENT...: povray-strips ends so.
expect() {
	want=$1
	shift
	"$strips" "$@" > out 2> err
	got=$?
	[ $got = "$want" ] || fail "exit code $got, expected $want: povray-strips $*"
	[ -n "${SLURM_CONF:-}" ] || [ -z "$(ls "$TMPDIR")" ] || fail "left in TMPDIR: $(ls "$TMPDIR")"   # on a cluster parts may be running
}
says() { grep -q -e "$1" err || fail "stderr does not say '$1'"; }
prints() { grep -q -e "$1" out || fail "stdout does not say '$1'"; }
folder() { sed -n 's/^Folder: //p' out; }
pixels() { python3 "$here/../support/png_pixels.py" "$1" "$2" > same.txt 2>&1 || fail "$3: $(tail -1 same.txt)"; echo "$3: $(cat same.txt)"; }
other_pixels() { python3 "$here/../support/png_pixels.py" --differ "$1" "$2" > same.txt 2>&1 || fail "$3: $(tail -1 same.txt)"; }

# scene FILE CAMERA-WORDS [MORE]
scene() {
	cat > "$1" <<END
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (Colour) #declare Colour = 1; #end
camera { $2 location -5*z look_at <0, 0.2, 0> }
light_source { <3, 5, -5> rgb 1 }
plane { z, 3 pigment { checker rgb 0.2 rgb 0.8 scale 0.3 } }
sphere { <clock, 0, 0>, 1 pigment { rgb <Colour, 0.5, 0.2> } }
${3:-}
END
}
lens='tilt_lens { aperture_diameter 0.4 focal_distance 5 focal_plane_tilt 40 }'
blur="$lens blur_samples 8, 64 variance 1/2000"

# one OUTPUT SCENE OPTIONS...: the picture of one process.
one() {
	one_out=$1 one_scene=$2
	shift 2
	"$bin/povray" "+I$one_scene" "+O$one_out" -D +WT1 "$@" > one.log 2>&1 < /dev/null || fail "POV-Ray: $(tail -5 one.log)"
}
