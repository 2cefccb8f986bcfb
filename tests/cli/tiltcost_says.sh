# For tiltcost's tests, which set tiltcost, povray, TMPDIR=$work/tmp, and source this in $work.

fail() { echo "FAIL: $*"; echo "--- stdout"; cat out; echo "--- stderr"; cat err; exit 1; }
expect() { # expect CODE ARGUMENT...
	want=$1; shift
	"$tiltcost" --povray "$povray" "$@" >out 2>err
	got=$?
	[ "$got" = "$want" ] || fail "exit code $got, expected $want: tiltcost $*"
	[ -z "$(ls tmp)" ] || fail "a temporary folder is left"
}
says() { grep -q -e "$1" err || fail "stderr does not say '$1'"; }
prints() { grep -q -e "$1" out || fail "stdout does not say '$1'"; }
silent() { [ ! -s out ] || fail "an error must print nothing on stdout"; }
refuses() { want=$1 text=$2; shift 2; expect "$want" "$@"; says "$text"; silent; }
