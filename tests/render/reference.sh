#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# The scenes of povray-patch/REFERENCE.md, small, and what they say of their own statistics. Every effect has its own.
#
#   reference.sh CASE STOCK OURS COMPARE WORK
#
# CASE is `examples`: all of them.
. "$(dirname "$0")/common.sh"
. "$here/examples.sh"
reference=$root/povray-patch/REFERENCE.md
render_examples "$reference"

# A heading of the third level is a word of the block or bokeh: a scene follows it.
awk '/^## / { heading = "" }
	/^### / { heading = substr($0, 5); print heading }
	/^```pov$/ && heading != "" { print heading > "with_scene.txt"; }' "$reference" | sort > headings.txt
sort -u with_scene.txt | comm -23 headings.txt - > without.txt
[ ! -s without.txt ] || fail "no scene under the headings: $(cat without.txt)"
# What the scenes' statistics name, and what the headings do: the same effects.
for effect in $(sed 's/ .*//' headings.txt | sort -u); do
	case $effect in
		denoise | area_light_grid | channels | show) continue ;; # no effects of the lens
	esac
	grep -h '^Effects: ' *.log | grep -q -e "$effect" || fail "no scene's statistics name $effect"
done
[ "$(grep -c . headings.txt)" -ge 11 ] || fail "only $(grep -c . headings.txt) headings of words in REFERENCE.md"
finish
