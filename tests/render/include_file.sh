#!/bin/sh
# The include file tilt_lens.inc: the scenes of its page, and its numbers against the renderer's own formulas.
#
#   include_file.sh CASE STOCK OURS COMPARE WORK [NUMBERS]
#
# NUMBERS is include_file_numbers, which judges them.
. "$(dirname "$0")/common.sh"
. "$here/examples.sh"
include=$root/povray-patch/include/tilt_lens.inc
page=$root/povray-patch/TILT-LENS-INC.md

case $case in
examples)
	render_examples "$page"
	# Each name of the file is in a scene of the page, and each macro in its table or that of the lenses.
	cat ./*.pov > all-scenes
	sed -n 's/^ *#\(macro\|declare\) *\(TL_[A-Za-z0-9_]*\).*/\2/p' "$include" | sort -u > names
	[ "$(grep -c . names)" -ge 40 ] || fail "only $(grep -c . names) names found in $include"
	while IFS= read -r name; do
		grep -q "\\b$name\\b" all-scenes "$page" || fail "$name is not on the page"
	done < names
	sed -n 's/^#macro *\(TL_[A-Za-z0-9_]*\).*/\1/p' "$include" > macros
	while IFS= read -r name; do
		grep -q "\\b$name\\b" all-scenes || fail "no scene of the page has the macro $name"
	done < macros
	# What stands beside the program is what is in the repository.
	cmp "$include" "$(dirname "$ours")/../share/povray-3.7/include/tilt_lens.inc" || fail "the build has another tilt_lens.inc"
	# It is found whatever ini file the user has.
	printf '%s\n' 'Antialias=Off' > own.ini
	printf '%s\n' '#version 3.7;' 'global_settings { assumed_gamma 1 }' '#include "tilt_lens.inc"' > include.pov
	POVINI=$PWD/own.ini povray_to "$ours" include.png include.pov || fail "with an ini file of the user's: $(grep -A3 Error include.png.log)"
	# Slips are refused by name.
	for slip in 'TL_Focus_Line(<0,0,1>, <0,0,2>, z)=the direction must differ' 'TL_Focus_Objects(plane { y, 0 }, sphere { y, 1 }, sphere { z, 1 })=the object is endless' \
		'TL_Focus_Sweep(<0,2,-8>, <0,0,2>, z, <0,0,-18>, z, 0.5)=lies at infinity' 'TL_Focus_Sweep(<0,2,-8>, <0,2,2>, y, <0,0,0>, z, 0.5)=passes through the camera'; do
		printf '%s\n' '#version 3.7;' 'global_settings { assumed_gamma 1 }' '#include "tilt_lens.inc"' \
			"camera { tilt_lens { ${slip%=*} aperture_diameter 0.1 } location <0, 2, -8> look_at <0, 2, 0> }" > slip.pov
		if povray_to "$ours" slip.png slip.pov; then
			fail "${slip%=*} is accepted"
		elif ! tr -s '\n ' ' ' < slip.png.log | grep -q "${slip#*=}"; then
			fail "${slip%=*} does not say '${slip#*=}': $(grep -A3 Error slip.png.log)"
		fi
	done
	;;
numbers)
	# include_file.pov writes down what the macros find; the program finds it with povray-patch/lens.
	povray_to "$ours" numbers.png "$here/include_file.pov" || fail "include_file.pov: $(grep -A3 Error numbers.png.log)"
	check "numbers" "$6" numbers.txt
	;;
*)
	fail "no case '$case'"
	;;
esac
finish
