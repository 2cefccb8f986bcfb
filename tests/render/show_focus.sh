#!/bin/sh
# The numbers on the contours of `show focus` (common.sh).
. "$(dirname "$0")/common.sh"

# A wall whose inverse depth is linear over the picture: x + z = 5, so 1/z = (1 + v)/5 with v the slope of the column's ray. Focused at 5,
# with 180 pixels to a unit of slope in a picture 240 wide, the blur is 1.5 * 180 v/5 = 54 v = 0.3 (column - 119.5) pixels.
wall() {
	cat > "$1.pov" <<-EOF
		#version 3.7;
		global_settings { assumed_gamma 1 }
		camera {
			tilt_lens { focal_distance 5 aperture_diameter 1.5 $2 }
			location 0 right x * 4 / 3 up y direction z look_at z
		}
		plane { <1, 0, 1>, 5/sqrt(2) pigment { checker rgb <0.2, 0.6, 0.2> rgb <0.3, 0.2, 0.5> } finish { ambient 1 diffuse 0 } }
	EOF
}

case $case in
numbers)
	wall wall "show focus"
	render "$ours" wall.ppm wall.pov +W240 +H180
	# 2, 4, 8, 16, 32 on either side; the last stand at columns 12.8 and 226.2.
	check "labels of the wall" python3 "$here/read_labels.py" wall.ppm 0.3 119.5 10
	grep -q -e '-16, -2, -32, -4, -8, 16, 2, 32, 4, 8' check.txt || fail "not all numbers: $(cat check.txt)"
	# With show plane alone there are none.
	wall plane "show plane"
	render "$ours" plane.ppm plane.pov +W240 +H180
	python3 "$here/read_labels.py" plane.ppm 0.3 119.5 1 > none.txt && fail "show plane has numbers: $(cat none.txt)"
	grep -q 'only 0 numbers' none.txt || fail "$(cat none.txt)"
	;;
strips)
	# A tilted view of the oracle's scene: whole, by threads, in tiles of another size, in strips, in a part of it, the same pixels.
	printf '%s\n' '#include "oracle-scene.inc"' "camera { tilt_lens { focal_plane_tilt 60 tilt_direction 30 focal_distance 8 aperture_diameter 0.4 show focus 480 } $view }" > view.pov
	render "$ours" whole.ppm view.pov +W240 +H180
	for how in "+WT4" "+BS8" "+BS64 +WT3" "+SP16 +EP4"; do
		render "$ours" other.ppm view.pov +W240 +H180 $how
		check "$how" "$compare" same whole.ppm other.ppm
	done
	render "$ours" upper.ppm view.pov +W240 +H180 +ER77
	render "$ours" lower.ppm view.pov +W240 +H180 +SR78
	python3 - <<-'PYTHON' || fail "strips differ from the whole picture"
		import re
		def rows(name):
		    data = open(name, "rb").read()
		    header = re.match(rb"P6\s+(?:#.*\n)*(\d+)\s+(\d+)\s+(\d+)\s", data)
		    row = 6 * int(header.group(1))
		    return [data[i:i + row] for i in range(header.end(), len(data), row)]
		whole, upper, lower = rows("whole.ppm"), rows("upper.ppm"), rows("lower.ppm")
		assert len(whole) == 180 and upper[:77] == whole[:77], "upper"
		assert lower[77:] == whole[77:] or lower == whole[77:], "lower"
	PYTHON
	;;
width)
	# Counted in pixels of a picture twice as wide the blur is twice as many, in the same places.
	wall wide "show focus 480"
	render "$ours" wide.ppm wide.pov +W240 +H180
	check "labels of a wider picture" python3 "$here/read_labels.py" wide.ppm 0.6 119.5 8
	wall wide "show focus (2*240) seed 3"
	render "$ours" expression.ppm wide.pov +W240 +H180
	check "an expression" "$compare" same wide.ppm expression.ppm
	wall same "show focus 240"
	wall plain "show focus"
	render "$ours" same.ppm same.pov +W240 +H180
	render "$ours" plain.ppm plain.pov +W240 +H180
	check "its own width" "$compare" same plain.ppm same.ppm
	# A name that is a word of the block is the word; a width that is none is refused.
	wall named "show focus shift <0, 0>"
	sed -i 's/^camera/#declare shift = 3;\n&/' named.pov
	render "$ours" named.ppm named.pov +W240 +H180
	check "a word behind it" "$compare" same plain.ppm named.ppm
	wall zero "show focus 0"
	povray_to "$ours" zero.ppm zero.pov && fail "a width of 0 is accepted"
	tr -s '\n ' ' ' < zero.ppm.log | grep -q 'the width behind show focus is that of the picture to come, from 1 to 1e6 pixels, but is 0' || fail "$(grep -A3 Error zero.ppm.log)"
	wall typo "show focus banana"
	povray_to "$ours" typo.ppm typo.pov && fail "show focus banana is accepted"
	tr -s '\n ' ' ' < typo.ppm.log | grep -q "Unknown word 'banana'" || fail "$(grep -A3 Error typo.ppm.log)"
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
