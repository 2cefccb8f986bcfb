#!/bin/sh
# The error that the statistics estimate against the error that the picture has: within what the estimate's own theory leaves open.
#
# What is estimated is the variance v(n) ~ n^-a of the mean, from v(n/2) - v(n) = v(n) (2^a - 1) (povray-patch/lens/convergence.h). a lies between 1, independent samples, and
# 1.8, nets in four dimensions of pictures with edges, and alternates from one power of two to the next, which the fit over five of them smooths: of the latest step it may be
# anywhere in between. So the error is known to a factor of sqrt((2^1.8 - 1) / (2^1 - 1)) = 1.576 either way.
#
#   estimate.sh SCENE STOCK OURS COMPARE WORK
#
# SCENE: a name of scenes/. The truth has 2048 samples per pixel of another seed, so its own error is a fifth of the
# smallest that is judged, which in quadrature is nothing. 72 x 54 pixels: the mean of 4,000 squared errors is itself uncertain by a few percent, which is little beside that.
here_accuracy=$(cd "$(dirname "$0")" && pwd)
. "$here_accuracy/../render/common.sh"
here=$here_accuracy/scenes
[ -f "$here/$case.pov" ] || { echo "no scene '$case' in $here"; exit 1; }

# picture NAME OPTIONS...
picture() {
	name=$1
	shift
	render "$ours" "$name.ppm" "$here/$case.pov" +W72 +H54 Declare=Race_Camera=1 "$@"
}

picture truth Declare=Race_Max=2048 Declare=Race_Variance=0 Declare=Race_Seed=1
for denoise in 0 1; do
	for setting in "0 32 0" "0 128 0" "1 64 0.001" "2 64 0.0003" "4 64 0.001" "8 256 0.0001"; do
		set -- $setting
		picture tested "Declare=Race_Min=$1" "Declare=Race_Max=$2" "Declare=Race_Variance=$3" "Declare=Race_Denoise=$denoise"
		estimate=$(sed -n 's/Estimated Error: [>= ]*\([0-9.]*\).*/\1/p' tested.ppm.log)
		true=$("$compare" rms 1 tested.ppm truth.ppm | sed -n 's/^[^0-9]*\([0-9.][0-9.e-]*\).*/\1/p' | head -1)
		what="$case, blur_samples $1, $2 variance $3, denoise $denoise"
		echo "$what $estimate $true" >> figures.txt
		most=1.576
		least=0.634
		# A bound may be as low as it likes.
		grep -q 'Estimated Error: >=' tested.ppm.log && least=0 what="$what, a bound"
		awk "BEGIN { r = $estimate / $true; printf \"$what: estimated $estimate, true $true, ratio %.2f\n\", r; exit !(r > $least && r < $most) }" ||
			fail "$what: the estimate is off by more than its theory leaves open"
	done
done
finish
