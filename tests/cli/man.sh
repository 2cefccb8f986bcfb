#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# A man page: man has nothing to complain of, and every option and subcommand of the program's --help stands in it.
#
#   man.sh PAGE PROGRAM|- [SUBCOMMAND...]
set -u
page=$1 program=$2
shift 2
fail() { echo "FAILED: $*"; exit 1; }
command -v man > /dev/null || fail "no man; cmake/setup.sh installs man-db"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

LC_ALL=C MANWIDTH=120 man --warnings --no-hyphenation --no-justification -l "$page" > "$work/text" 2> "$work/warnings" ||
	fail "man does not read $page: $(cat "$work/warnings")"
[ ! -s "$work/warnings" ] || fail "man complains of $page: $(cat "$work/warnings")"
for heading in NAME SYNOPSIS DESCRIPTION 'SEE ALSO'; do
	grep -qx "$heading" "$work/text" || fail "$page has no section $heading"
done
! grep -n '@[A-Z]*@' "$page" || fail "$page has places that nothing was put into"
[ "$program" != - ] || exit 0

# in_page WORD: as a word of its own, not as the beginning of another.
in_page() { grep -Eq -e "(^|[^-[:alnum:]])$1([^-[:alnum:]]|\$)" "$work/text"; }
count=0
"$program" --help > "$work/help" || fail "$program --help"
sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' "$work/help" > "$work/subcommands"
[ "$(echo $(cat "$work/subcommands"))" = "$*" ] || fail "the page is made for '$*', $program has '$(echo $(cat "$work/subcommands"))'"
for command in "" $(cat "$work/subcommands"); do
	# $command: none or one word.
	"$program" $command --help > "$work/help" || fail "$program $command --help"
	for option in $(grep -oE -e '(^|[ ,(])--[a-z][-a-z0-9]*' "$work/help" | sed 's/^[^-]*//' | sort -u); do
		in_page "$option" || fail "$page says nothing of $command $option"
		count=$((count + 1))
	done
done
# The subcommands have options of the same names: each has a section of its own, with as many of them.
for command; do
	"$program" "$command" --help | sed -n '/^Options:/,/^$/s/^  \(-[a-z],\)\{0,1\}\(--[-a-z0-9]*\).*/\2/p' | sort > "$work/wanted"
	sed -n "/^   $(basename "$program") $command\$/,/^   [^ ]\|^[A-Z]/p" "$work/text" | sed 1d |
		sed -n 's/^       \(-[a-z], \)\{0,1\}\(--[-a-z0-9]*\).*/\2/p' | sort > "$work/found"
	[ -s "$work/wanted" ] || fail "no options in $command --help"
	cmp -s "$work/wanted" "$work/found" || fail "options of $command: $(diff "$work/wanted" "$work/found")"
done
[ $count -gt 5 ] || fail "only $count options found in --help"
echo "$count options"
