# Sourced, after common.sh, by the scripts that render the scenes of a document. A scene is a block between "```pov" and
# "```"; its first line is "// NAME: ...". Lines "// statistics: ..." are to be found in what POV-Ray reports, and so is
# what "// says: ..." has, wherever POV-Ray broke its lines; what "// never says: ..." has is not.

root=$(cd "$here/../.." && pwd)

# Runs of spaces are one.
plain() { tr -s ' \t' ' ' | sed 's/^ //'; }

# unbroken NAME: its lines "// says: ..." and "// never says: ...". POV-Ray breaks lines at the 80th character, within words too.
unbroken() {
	tr -d '\r\n ' < raw.log > said.txt
	sed -n 's,^// says: *,,p' "$1.pov" | tr -d ' ' > to-be-said.txt
	while IFS= read -r text; do
		grep -qF -e "$text" said.txt || fail "$1: does not say '$text' but: $(sed -n '/Parsing/,/Parser Statistics/p' "$1.log")"
	done < to-be-said.txt
	sed -n 's,^// never says: *,,p' "$1.pov" | tr -d ' ' > unto-be-said.txt
	while IFS= read -r text; do
		! grep -qF -e "$text" said.txt || fail "$1: says '$text': $(sed -n '/Parsing/,/Parser Statistics/p' "$1.log")"
	done < unto-be-said.txt
}

# render_examples DOCUMENT: NAME.pov, NAME.png and NAME.log of each scene, small, and the names in names.txt.
render_examples() {
	awk '/^```pov$/ { inside = 1; name = ""; next }
		/^```$/ { inside = 0; next }
		inside && name == "" { name = $2; sub(/:$/, "", name); print name > "names.txt" }
		inside { print > (name ".pov") }' "$1"
	[ -z "$(sort names.txt | uniq -d)" ] || fail "$1: more than one scene is called $(sort names.txt | uniq -d)"
	for name in $(cat names.txt); do
		if ! "$ours" "+I$name.pov" "+L$root/scenes/first-tilt" "+O$name.png" -D +W64 +H36 +WT1 > raw.log 2>&1 < /dev/null; then
			fail "$name: $(tr '\r' '\n' < raw.log | grep -i -A3 error | head -6)"
			continue
		fi
		tr '\r' '\n' < raw.log | plain > "$name.log"
		grep '^// statistics:' "$name.pov" | sed 's,^// statistics: *,,' | plain > wanted.txt
		[ -s wanted.txt ] || fail "$name says nothing of its statistics"
		while IFS= read -r line; do
			grep -qF -e "$line" "$name.log" || fail "$name: no '$line' in the statistics: $(sed -n '/^Tilt lens/,/^Estimated/p' "$name.log")"
		done < wanted.txt
		unbroken "$name"
		echo "$name: $(grep -c . wanted.txt) lines of statistics"
	done
}
