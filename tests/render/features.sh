#!/bin/sh
# What POV-Ray does with a perspective camera goes on with tilt_lens: one scene of features/ each (common.sh).
#
# Without an aperture every pixel is that of `perspective`. With one and an upright plane of focus it is stock's
# focal blur, whose samples are others: with 256 each an RMS difference of 0.002 to 0.005 remains, stock's own
# unevenness included (render.peer.aperture says how large that is, and is the finer test of the blur itself). A plane
# of focus a third farther away gives 0.011, an aperture of half or twice the size 0.014 and 0.022 (scene no_image).
. "$(dirname "$0")/common.sh"

options= samples=256 limit=0.007
case $case in
	alpha) options=+UA ;;
	radiosity | photons) samples=64 limit=0.012 ;; # slow ones: four times fewer samples, which see another aperture, not another plane of focus
esac

picture() {
	program=$1 name=$2
	shift 2
	render "$program" "$name.exr" "$here/features/$case.pov" +W96 +H72 "+L$here/features" $options "$@"
}

picture "$stock" stock-sharp Declare=Tilt=0 Declare=Blur=0
picture "$ours" ours-sharp Declare=Tilt=1 Declare=Blur=0
check "pinhole" "$compare" same stock-sharp.exr ours-sharp.exr
picture "$stock" stock-blurred Declare=Tilt=0 Declare=Blur=$samples
picture "$ours" ours-blurred Declare=Tilt=1 Declare=Blur=$samples
check "blur" "$compare" rms $limit stock-blurred.exr ours-blurred.exr
# What is covered or not differs by 1, colours by about half of that.
if [ $case = alpha ]; then
	check "the blur of alpha" "$compare" alpha "$(awk "BEGIN { print 2 * $limit }")" stock-blurred.exr ours-blurred.exr
	"$compare" empty ours-blurred.exr | awk '{ exit !($1 > 20 && $2 > 20) }' || fail "empty and half covered, in percent: $("$compare" empty ours-blurred.exr)"
fi
check "the blur is one" "$compare" differ 0.02 stock-blurred.exr stock-sharp.exr
grep -q '^Tilt lens' ours-blurred.exr.log || fail "no tilt_lens in this picture"
finish
