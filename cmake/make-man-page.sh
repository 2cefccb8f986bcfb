#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# A program's man page from what its own --help says and a hand-written frame, so that the page cannot lag behind the program.
#
#   make-man-page.sh PROGRAM FRAME OUTPUT [SUBCOMMAND...]
#
# Lines of FRAME that are replaced: @SYNOPSIS@, the usage lines; @OPTIONS@, PROGRAM's help; @SUBCOMMANDS@, a section of
# each subcommand's help. @VERSION@ within a line is the program's version. (help2man makes a page a subcommand, and takes
# CLI11's long option names and their meanings for one name.)
set -eu
program=$1 frame=$2 output=$3
shift 3
here=$(cd "$(dirname "$0")" && pwd)
name=$(basename "$program")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM

# part KIND HELP: what awk makes of one help text.
part() {
	awk -v "part=$1" -f "$here/help-to-man.awk" "$2"
}

version=$("$program" --version)
"$program" --help > "$work/help"
part synopsis "$work/help" > "$work/@SYNOPSIS@"
part body "$work/help" > "$work/@OPTIONS@"
: > "$work/@SUBCOMMANDS@"
for command; do
	"$program" "$command" --help > "$work/help"
	printf '.br\n' >> "$work/@SYNOPSIS@"
	part synopsis "$work/help" >> "$work/@SYNOPSIS@"
	printf '.SS %s %s\n' "$name" "$command" >> "$work/@SUBCOMMANDS@"
	part body "$work/help" >> "$work/@SUBCOMMANDS@"
done

while IFS= read -r line; do
	case $line in
		@SYNOPSIS@ | @OPTIONS@ | @SUBCOMMANDS@) cat "$work/$line" ;;
		*) printf '%s\n' "$line" ;;
	esac
done < "$frame" | sed "s/@VERSION@/${version##* }/g" > "$output.new"
mv "$output.new" "$output"
