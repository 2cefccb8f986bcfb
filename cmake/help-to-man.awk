# SPDX-License-Identifier: AGPL-3.0-or-later
#
# One --help text of CLI11, with the footers of our programs, as the body of a man page's section: description, options,
# notes and examples. Lines with a name in the first 30 columns and its meaning from column 31 on are CLI11's lists.
#
#   awk -v part=synopsis|body -f help-to-man.awk HELP

# What roff would take for its own: backslashes, hyphens, quotes, accents, dots at the start of a line.
function escape(text)
{
	gsub(/\\/, "\\e", text)
	gsub(/-/, "\\-", text)
	gsub(/'/, "\\(aq", text)
	gsub(/`/, "\\(ga", text)
	gsub(/\^/, "\\(ha", text)
	gsub(/~/, "\\(ti", text)
	sub(/^\./, "\\\\\\&.", text)
	return text
}

# The name of a list's entry: options bold, kinds of value italic.
function tag(name,    words, n, i, word, out, value)
{
	n = split(name, words, " ")
	out = ""
	for (i = 1; i <= n; i++)
	{
		word = words[i]
		value = ""
		if (word ~ /^(TEXT|FLOAT|U?INT)(:[A-Z]+)?(=.*)?$/)
		{
			if (word ~ /=/)
			{
				value = word
				sub(/^[^=]*=/, "", value)
				value = " (default " escape(value) ")"
				sub(/=.*/, "", word)
			}
			sub(/:.*/, "", word)
			word = "\\fI" word "\\fR" value
		}
		else if (word == "REQUIRED")
			word = "(required)"
		else if (word ~ /^-/ || i == 1)
		{
			sub(/,/, ", ", word)
			word = "\\fB" escape(word) "\\fR"
		}
		else
			word = escape(word)
		out = out (i > 1 ? " " : "") word
	}
	return out
}

function literal(on)
{
	if (on == verbatim)
		return
	print on ? ".PP\n.RS 4\n.nf" : ".fi\n.RE"
	verbatim = on
}

/^Usage: / {
	usage = substr($0, 8)
	if (part == "synopsis")
	{
		program = usage
		sub(/ (\[OPTIONS\]|SUBCOMMAND).*/, "", program)
		sub(/^ /, "", usage)
		print ".B " escape(program)
		print escape(substr(usage, length(program) + 2))
	}
	next
}
part == "synopsis" { next }

# The heading of a list.
/^(Positionals|Options|Subcommands):$/ {
	list = 1
	next
}
/^$/ {
	list = 0
	literal(0)
	paragraph = 1
	next
}
# (mawk has no intervals in regular expressions.)
list && length($0) > 30 && substr($0, 1, 30) !~ /[^ ]/ {
	sub(/^ +/, "")
	print escape($0)
	next
}
list && /^  [^ ]/ {
	print ".TP"
	if (length($0) > 30 && substr($0, 30, 1) == " ")
	{
		print tag(substr($0, 1, 30))
		print escape(substr($0, 31))
	}
	else
		print tag($0)
	next
}
# Lines that are set in, outside lists, are commands to copy.
/^  / {
	literal(1)
	print escape(substr($0, 3))
	next
}
/^Examples?:$/ {
	literal(0)
	print ".PP\n.B " substr($0, 1, length($0) - 1)
	paragraph = 0
	next
}
{
	literal(0)
	if (paragraph || /^Exit codes:/)
		print ".PP"
	paragraph = 0
	print escape($0)
}

END { literal(0) }
