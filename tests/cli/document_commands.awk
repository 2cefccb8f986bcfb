# SPDX-License-Identifier: AGPL-3.0-or-later
#
# Lines that may be commands in Markdown documents: DOCUMENT, a tab, the line. From blocks that are set in by four spaces or
# fenced (scenes, ```pov, aside), with continued lines joined and comments taken off; and from `code` in the text that has a
# space in it.
#
#   awk -f document_commands.awk DOCUMENT...

function put(line)
{
	sub(/^ +/, "", line)
	sub(/[ \t]+#[ \t].*$/, "", line)
	gsub(/[ \t]+/, " ", line)
	sub(/ $/, "", line)
	if (line != "")
		print FILENAME "\t" line
}

FNR == 1 { fence = ""; joined = "" }
/^```/ {
	fence = fence == "" ? ($0 == "```pov" ? "scene" : "commands") : ""
	next
}
fence == "scene" { next }
fence == "commands" || /^    / {
	if ($0 ~ /\\$/)
	{
		joined = joined substr($0, 1, length($0) - 1) " "
		next
	}
	put(joined $0)
	joined = ""
	next
}
{
	# A code span may go on in the next line.
	text = text $0 " "
	while (match(text, /`[^`]+`/))
	{
		span = substr(text, RSTART + 1, RLENGTH - 2)
		text = substr(text, RSTART + RLENGTH)
		if (span ~ / /)
			put(span)
	}
	if ($0 == "" || text !~ /`/)
		text = ""
}
