#!/bin/sh
# The syntax files for editors: every word of the block is in them, VS Code's are JSON whose expressions match it, and Vim
# takes its own without a word and highlights inside the block alone.
#
#   editors.sh EDITORS REFERENCE WORK
#
# EDITORS is share/tilt-lens/editors of the build, REFERENCE is REFERENCE.md, which the test Words holds against the table of words.
editors=$1 reference=$2 work=$3
failures=0
fail() {
	echo "FAILED: $*"
	failures=$((failures + 1))
}
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1

# Code in the first cells of the tables of the block's words and of those of aberrations; what stands for a value is a capital.
awk '/^## / { inside = $0 == "## Words of the block" } /^### / { inside = $0 == "### aberrations" }
	inside && /^\| `/ { split($0, cells, "|"); print cells[2] }' "$reference" | grep -o '`[^`]*`' | grep -o '[a-z_]\{2,\}' | sort -u > words
[ "$(grep -c . words)" -ge 35 ] || fail "only $(grep -c . words) words found in $reference"

python3 - "$editors" <<'PYTHON' || fail "VS Code's files"
import json, re, sys
folder = sys.argv[1] + "/vscode/"
words = open("words").read().split()
package = json.load(open(folder + "package.json"))
for grammar in package["contributes"]["grammars"]:
    json.load(open(folder + grammar["path"]))
for language in package["contributes"]["languages"]:
    json.load(open(folder + language["configuration"]))
faults = []

def expressions(node):
    """Every expression of a grammar; they are Oniguruma's, and these are Python's too."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key in ("match", "begin", "end"):
                yield value
            else:
                yield from expressions(value)
    elif isinstance(node, list):
        for value in node:
            yield from expressions(value)

for grammar in package["contributes"]["grammars"]:
    for text in expressions(json.load(open(folder + grammar["path"]))):
        re.compile(text)
lens = json.load(open(folder + "tilt-lens.tmLanguage.json"))["repository"]
inner = [p["match"] for p in lens["block"]["patterns"] if p.get("name") == "keyword.other.tilt-lens"]
for word in words:
    found = re.search(inner[0], "{ %s 3 }" % word)
    if not found or found.group(0) != word:
        faults.append(word)
if re.search(inner[0], "focal_distances") or not re.search(lens["lens"]["begin"], "camera { tilt_lens {"):
    faults.append("begin, or the end of a word")
if faults:
    sys.exit("not matched: " + ", ".join(faults))
print("VS Code: %d words" % len(words))
PYTHON

while IFS= read -r word; do
	grep -q "^syn keyword povTiltLensWord .*\\b$word\\b" "$editors/vim/syntax/pov.vim" || fail "vim's file lacks $word"
done < words
if ! vim --version 2> /dev/null | grep -q '+syntax'; then
	# What failed before is no less a failure.
	[ $failures -gt 0 ] || { echo "skipped: no vim with syntax highlighting (vim-tiny has none); cmake/setup.sh installs it"; exit 77; }
else
	# Each word in the block, in braces within it, and outside.
	{
		echo 'camera { tilt_lens {'
		sed 's/$/ 3/' words
		echo '  aberrations { coma 1 } // shift'
		echo '} location -5*z TL_Sensor(TL_Full_Frame) }'
		echo '#declare shift = 3; #declare focal_distance = shift;'
	} > scene.pov
	cat > ask.vim <<'VIM'
set nocompatible
exe 'set runtimepath+=' . $EDITORS . '/vim'
syntax on
edit scene.pov
setf pov
let lines = []
for l in range(1, line('$'))
  for m in range(1, len(getline(l)))
    if m == 1 || getline(l)[m - 2] !~ '\w'
      let word = matchstr(getline(l), '\w\+', m - 1)
      if getline(l)[m - 1] =~ '\a'
        call add(lines, l . ' ' . word . ' ' . synIDattr(synID(l, m, 1), 'name'))
      endif
    endif
  endfor
endfor
call writefile(lines, 'groups')
call writefile([v:errmsg], 'errors')
qa!
VIM
	EDITORS=$editors vim -es -u NONE -i NONE -n -S ask.vim < /dev/null > vim.log 2>&1
	[ -f groups ] || fail "vim stopped: $(cat vim.log)"
	[ -z "$(tr -d '\n' < errors)" ] || fail "vim says: $(cat errors)"
	[ -s vim.log ] && fail "vim says: $(cat vim.log)"
	last=$(($(grep -c . words) + 1))
	while IFS= read -r word; do
		grep -q "^[0-9]* $word povTiltLensWord\$" groups || fail "vim does not show $word in the block: $(grep " $word " groups)"
	done < words
	for wanted in "1 tilt_lens povTiltLens" "$((last + 1)) coma povTiltLensWord" "$((last + 1)) shift povComment" "$((last + 2)) TL_Sensor povTiltLensMacro"; do
		grep -qx "$wanted" groups || fail "vim: no '$wanted' in $(grep "^${wanted%% *} " groups)"
	done
	grep "^$((last + 3)) " groups | grep -q povTiltLensWord && fail "vim shows words outside the block: $(grep "^$((last + 3)) " groups)"
	echo "vim: $(grep -c povTiltLensWord groups) words in the block"
fi
[ $failures -eq 0 ] && echo "all well" && exit 0
echo "$failures checks failed"
exit 1
