# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Sourced by the tests of tiltcal-batch: the list of two cameras, and of one whose photographs are not there. $photos is their folder.
common='--board 12x9 --square 25 --pitch 0.02 --edges-per-photo 16 --model plane --refine none --effects none'
write_list() {
	cat <<END
# of scenes/boxes
plus   --untilted '$photos/untilted-[135].jpg' --tilted plus5='$photos/plus5-[135].jpg'

minus  --untilted "$photos/untilted-[135].jpg" --tilted "minus5=$photos/minus5-[135].jpg"
absent --untilted '$photos/untilted-[135].jpg' --tilted plus5='nowhere/*.jpg'
END
}
