#!/bin/sh
# The scenes of povray-patch/COMING-FROM.md, small, and what they say of their own statistics.
#
#   coming_from.sh CASE STOCK OURS COMPARE WORK
#
# CASE is `scenes`: all of them.
. "$(dirname "$0")/common.sh"
. "$here/examples.sh"
render_examples "$root/povray-patch/COMING-FROM.md"
[ "$(grep -c . names.txt)" -ge 5 ] || fail "no scenes in COMING-FROM.md"

# An opening that is half as wide as high blurs less across: not the same picture as with the round one.
cp "arnold-anamorphic.pov" round.pov
sed -i 's/scale <0.25, 0.5, 1>/scale <0.5, 0.5, 1>/' round.pov
"$ours" +Iround.pov "+L$root/scenes/first-tilt" +Oround.png -D +W64 +H36 +WT1 > raw.log 2>&1 < /dev/null || fail "round.pov"
check "the shape of the opening matters" python3 "$here/../support/png_pixels.py" --differ round.png arnold-anamorphic.png
finish
