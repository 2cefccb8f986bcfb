#!/bin/sh
# usage: release_check.sh CASE SOURCE WORK PYTHON
# cmake/release-check: the script with stand-ins for the steps, and the steps' names.
set -u
case=$1 source=$2 work=$3 python=$4
script=$source/cmake/release-check/release-check.sh steps=$source/cmake/release-check/steps.list
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 99

fail() { echo "FAIL: $*"; cat out; [ -f folder/release-check.md ] && cat folder/release-check.md; exit 1; }
check() { want=$1; shift; sh "$script" "$@" >out 2>&1; got=$?; [ $got = "$want" ] || fail "exit code $got, expected $want: $*"; }
page() { grep -qe "$1" folder/release-check.md || fail "the page does not say '$1'"; }

case $case in
runs)
	printf '%s\n' '# NAME | COMMAND' '' 'good | echo "well | done"; echo' 'bad | echo why >&2; exit 3' 'away | echo "skipped: no tool"; exit 77' 'eats | cat' \
		'last | sleep 1; test -f folder/bad.log && touch ran' >table
	check 1 table folder
	[ -f ran ] || fail "it did not go on after a failure"
	page '^# Release check: FAILED$'; page '^3 passed, 1 failed, 1 skipped, in [0-9]* s\.$'
	page '^| \[good\](good.log) | passed | [0-9]* s | <code>echo "well \\| done"; echo</code> | well \\| done |$'
	page '^| \[bad\](bad.log) | \*\*failed\*\* (3) | .* | why |$'; page '^| \[away\].* | skipped | .* | skipped: no tool |$'
	[ "$(grep -o '^| \[[a-z]*' folder/release-check.md | tr -d '|[ ' | tr '\n' ' ')" = "good bad away eats last " ] || fail "order"
	grep -q "FAILED: 3 passed, 1 failed, 1 skipped; folder/release-check.md" out || fail "last line"
	# Those named alone; nothing of the last check stays.
	check 0 table folder good away; page '^# Release check: passed$'; page '^1 passed, 0 failed, 1 skipped'; [ ! -e folder/bad.log ] || fail "an old log"
	# An interrupted one has its page.
	printf '%s\n' 'first | true' 'endless | exec sleep 60' >table
	sh "$script" table folder >out 2>&1 & pid=$!
	for k in 1 2 3 4 5 6 7 8 9 10; do grep -q '^release-check: endless' out && break; sleep 1; done
	# The shell notices when its step ends.
	kill -TERM $pid; kill $(ps -o pid= --ppid $pid)
	wait $pid; [ $? = 130 ] || fail "exit code of an interrupted check"
	page '^# Release check: interrupted in endless$'; page '\[first\]' ;;
goes_on)
	# What passed for this commit is not run again: not after a failure, but for another commit, with a change, or where it is named.
	calls() { [ "$(wc -l <calls)" = "$1" ] || fail "$2: $(cat calls)"; : >calls; }
	printf '%s\n' 'one | echo one >>calls; echo said' 'two | echo two >>calls; test -e good' >table
	printf '%s\n' folder calls out good >.gitignore
	git init -q . && git config user.email a@b && git config user.name a && git add table .gitignore && git commit -qm one || exit 99
	check 1 table folder; calls 2 "the first time"
	touch good; check 0 table folder; calls 1 "passed before"; page '^| \[one\](one.log) | passed | .* | said |$'; page '^2 passed, 0 failed'; [ -s folder/one.log ] || fail "its log"
	check 0 table folder one; calls 1 "named"
	echo '# more' >>table; check 0 table folder; calls 2 "a change beside the commit"
	git commit -qam two; check 0 table folder; calls 2 "another commit"
	check 0 table folder; calls 0 "all passed before" ;;
usage)
	: >out; check 2; check 2 nowhere folder; grep -q "nowhere: no such table" out || fail "nowhere"
	echo '# nothing' >empty; check 2 empty folder; grep -q "has no steps" out || fail "empty"
	echo 'one | true' >table; check 2 table folder two; grep -q "no step two; there are one" out || fail "two" ;;
steps) # what the real table runs exists
	: >out
	"$python" - "$source" "$steps" <<-'END' >out 2>&1 || fail "the table of steps"
		import json, re, sys
		source, steps = sys.argv[1:]
		presets = json.load(open(source + "/CMakePresets.json"))
		names = lambda kind: {p["name"] for p in presets[kind]}
		cmake = "".join(open(source + "/" + f).read() for f in ("tests/fuzz/CMakeLists.txt", "tests/accuracy/race/CMakeLists.txt", "tests/accuracy/calibrator/CMakeLists.txt", "tests/accuracy/cameras/CMakeLists.txt", "povray-patch/CMakeLists.txt"))
		lines = [l for l in open(steps).read().splitlines() if l and l[0] != "#"]
		for line in lines:
		    name, command = line.split(" | ", 1)
		    for part in command.split(" && "):
		        preset = re.search(r"--preset (\S+)", part)
		        kind = "workflowPresets" if "--workflow" in part else "buildPresets" if "--build" in part else "testPresets" if part.startswith("ctest") else "configurePresets"
		        assert not preset or preset[1] in names(kind), line
		        target = re.search(r"--target (\S+)", part)
		        assert not target or "add_custom_target(%s\n" % target[1] in cmake.replace(" ", "\n"), line
		        script = re.match(r"(?:sh|python3) (\S+)", part)
		        assert not script or open(source + "/" + script[1]), line
		found = {line.split(" ")[0] for line in lines}
		wanted = {"release-build", "profile", "dev-build", "dev-tests", "asan-build", "asan-unit", "asan-calib", "asan-cli", "asan-render", "asan-cluster", "asan-slow", "fuzz-blocks", "fuzz-pictures", "fuzz-inputs", "fuzz-coverage", "package", "race", "tiltcost-predictions", "calibrator-coverage", "simulated-cameras", "calibrator-cost", "paper", "long", "no-harm"}
		assert wanted == found, wanted ^ found
		# What is tested is built in the same step: not what an earlier commit left.
		for line in lines:
		    tested = re.search(r"ctest --preset (\S+)", line)
		    assert not tested or "cmake --build --preset %s && ctest" % tested[1] in line, line
		steps = [p["steps"] for p in presets["workflowPresets"] if p["name"] == "release-check"]
		assert steps and steps[0][-1] == {"type": "test", "name": "release-check"}, steps
	END
	;;
*) echo "unknown case $case"; exit 99 ;;
esac
