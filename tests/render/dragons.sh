#!/bin/sh
# The claims of scenes/dragons, at a small size.
. "$(dirname "$0")/common.sh"
scenes=$(cd "$here/../../scenes/dragons" && pwd)

case $case in
oblique)
	# The statistics: pixels whose focus is in front of the lens, nowhere, and behind it. By the formula, kappa = q . v
	# vanishes on a nearly upright line at 38 % of the width (scenes/dragons/plan.pov draws it), so that one column or
	# two of 96 hold the zero: 1 to 2 %.
	render "$ours" oblique.exr "$scenes/oblique.pov" "+L$scenes" +W96 +H54 Declare=Denoise=0
	grep 'Pixels in Focus' oblique.exr.log
	sed -n 's/%//g; s/.*in front \([0-9.]*\)  at infinity \([0-9.]*\)  behind \([0-9.]*\)  empty.*/\1 \2 \3/p' oblique.exr.log |
		awk '{ n++; bad = $1 < 59 || $1 > 64 || $2 <= 0.5 || $2 > 2.1 || $3 < 35 || $3 > 40 } END { exit bad || n != 1 }' ||
		fail "not the shares of the plan"
	;;
sharp)
	# The heads against those of a pinhole (with the lens's own samples over the pixel: an aperture of 1e-6). Each head is
	# rendered in a box of its own (heads.pov says where: 800 wide, here 240), everything outside is black in all pictures.
	# Without tilt the near and the far head are blurred over 6 and 5 of these pixels, all three are sharp with it.
	head() {
		name=$1 left=$2 right=$3 top=$4 bottom=$5
		for lens in pinhole untilted tilted; do
			scene=$lens aperture=
			[ $lens = pinhole ] && scene=untilted && aperture=Declare=Aperture=0.000001
			# $aperture: a word or none.
			render "$ours" "$name-$lens.exr" "$scenes/$scene.pov" "+L$scenes" +W240 +H135 Declare=Denoise=0 \
				"+SC$left" "+EC$right" "+SR$top" "+ER$bottom" $aperture
		done
		untilted=$("$compare" differ 0 "$name-untilted.exr" "$name-pinhole.exr" | sed 's/RMS difference \([0-9.]*\).*/\1/')
		tilted=$("$compare" differ 0 "$name-tilted.exr" "$name-pinhole.exr" | sed 's/RMS difference \([0-9.]*\).*/\1/')
		echo "$name head: RMS difference to the pinhole $untilted untilted, $tilted tilted"
	}
	# A third: an edge's RMS difference grows about as its blur does, and what is left in the plane is the depth of a head
	# (up to 1.4 pixels) and the grain of 32 samples.
	sharper() {
		awk "BEGIN { exit !($tilted > 0 && $tilted < $untilted / 3) }" || fail "$name head: not sharper by a factor of three"
	}
	head near 25 56 38 69
	sharper
	blurred=$untilted
	head far 180 196 28 45
	sharper
	# The middle head is sharp in both: by the same third, of the near one's blur.
	head middle 106 130 21 45
	for difference in $untilted $tilted; do
		awk "BEGIN { exit !($difference > 0 && $difference < $blurred / 3) }" || fail "middle head: not sharp"
	done
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
