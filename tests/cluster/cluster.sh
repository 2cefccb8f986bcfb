#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
#
# povray-strips on a real Slurm of two virtual nodes, which the test cluster.slurm_start has started in the folder of the fifth
# argument (slurm.sh, common.sh). The tests take turns.
. "$(dirname "$0")/common.sh"
. "$here/slurm.sh"
slurm=$5

last_job() { tr -dc '0-9\n' < "$1/jobs.json" | grep . | tail -1; }
job_state() { scontrol show job "$1" 2> /dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | sort -u | tr '\n' ' '; }
ended() { # FOLDER: its last job has
	case $(job_state "$(last_job "$1")") in COMPLETED* | FAILED* | CANCELLED*) return 0 ;; *) return 1 ;; esac
}
parts() { ls "$1"/parts/*.json 2> /dev/null | wc -l; }
await() { slurm_wait "$@" || fail "no $1"; }
at_least() { [ "$(parts "$1")" -ge "$2" ]; }

[ $case = guard ] || slurm_use "$slurm"

case $case in
picture)
	# The pixels of one process from two nodes, cut by the pilot.
	scene s.pov "$blur"; size="+W64 +H49 +FN16 +UA"
	expect 0 s.pov $size --parts 4 --pilot-time 0.5s; dir=$(folder)
	prints "^Jobs: pilot [0-9]*, parts [0-9]*, join [0-9]*$"; prints "^Watch:  squeue --jobs=[0-9,]*;"; prints "^Cancel: scancel [0-9 ]*$"
	one one.png s.pov $size
	await "end of the join" ended "$dir"
	[ -s s.png ] || fail "no picture: $(cat "$dir"/log/*)"
	pixels one.png s.png "two nodes"
	[ "$(grep -ho '"node": "n[12]"' "$dir"/parts/*.json | sort -u | wc -l)" = 2 ] || fail "one node did it all"
	grep -q "^parts: .* times the mean; equal cost by the pilot" "$dir/log/join.txt" || fail "$(cat "$dir/log/join.txt")" ;;
node)
	# A node dies in the middle, with all that runs on it: Slurm gives its part to the other one, and nothing is rendered twice.
	scene s.pov "$lens blur_samples 500"
	expect 0 s.pov +W96 +H72 --parts 4 --equal-rows; dir=$(folder)
	await "POV-Ray on n2" slurm_runs "$slurm" n2 povray
	slurm_kill_node "$slurm" n2
	await "end of the join" ended "$dir"
	[ -s s.png ] || fail "no picture: $(cat "$dir"/log/*) $(scontrol show job | grep -E 'JobId|State')"
	one one.png s.pov +W96 +H72; pixels one.png s.png "a node died"
	grep -q 'requeue job .* due to failure of node n2' "$slurm/slurmctld.log" || fail "Slurm requeued nothing: $(tail -20 "$slurm/slurmctld.log")"
	[ "$(grep -h '"node"' "$dir"/parts/*.json | grep -c n1)" -ge 3 ] || fail "n2 did more than it lived for" ;;
fails)
	# A part that fails, and fails again after --resume: named, with its command; no picture; the rest is not rendered again.
	scene s.pov "$blur"
	printf '#!/bin/sh\ncase "$*" in *"+ER49 "*) [ ! -e %s/bad ] || { echo "Fatal error: as told" >&2; exit 1; } ;; esac\necho "$*" >> %s/calls\nexec %s "$@"\n' "$work" "$work" "$bin/povray" > pov
	chmod +x pov; touch bad
	expect 0 s.pov +W64 +H49 --parts 4 --equal-rows --povray ./pov; dir=$(folder)
	for time in 1 2; do
		await "end of the join" ended "$dir"
		[ "$(job_state "$(last_job "$dir")")" = "FAILED " ] || fail "the join did not fail"
		[ ! -e s.png ] || fail "an incomplete set was joined"
		alone=$(sed -n 's/^ *\([^ ]*povray-strips --part 3 [^( ]*\) *(.*/\1/p' "$dir/log/join.txt" | tail -1)
		[ -n "$alone" ] || fail "the failed part's command is not named: $(cat "$dir/log/join.txt")"
		[ $time = 2 ] || { : > calls; expect 0 --resume "$dir" --sbatch --nice=7; prints "1 of 4 parts are missing"; prints "^Jobs: parts"
			scontrol show job "$(last_job "$dir")" | grep -q "Nice=7" || fail "not as --resume says: $(scontrol show job "$(last_job "$dir")")"; }
	done
	[ "$(grep -c as.told "$dir/log/part-3.txt")" -ge 2 ] || fail "it did not fail twice"
	rm bad; sh -c "$alone" > out 2> err || fail "its command"
	[ "$(wc -l < calls)" = 1 ] || fail "others were rendered again: $(cat calls)"
	expect 0 --join "$dir"; one one.png s.pov +W64 +H49; pixels one.png s.png "failed twice" ;;
film)
	# Eight frames, and the same film a second time at once: two folders, two films.
	scene s.pov "$blur"
	film="+W32 +H24 +KFI1 +KFF8 +KI-1 +KF1"
	mkdir a b one other
	expect 0 s.pov $film +Oa/f.png; first=$(folder); prints "8 frames in 8 parts"
	expect 0 s.pov $film Declare=Colour=0.1 +Ob/f.png --parts 2; second=$(folder)
	one one/f.png s.pov $film
	one other/f.png s.pov $film Declare=Colour=0.1
	await "end of the first film" ended "$first"
	await "end of the second film" ended "$second"
	for i in 1 2 3 4 5 6 7 8; do
		[ -s a/f$i.png ] && [ -s b/f$i.png ] || fail "no frame $i: $(cat "$first/log/join.txt" "$second/log/join.txt")"
		pixels one/f$i.png a/f$i.png "frame $i"
		pixels other/f$i.png b/f$i.png "frame $i of the second film"
		other_pixels a/f$i.png b/f$i.png "the films are the same: nothing shown"
	done ;;
cancel)
	# What is printed ends all three, and what runs; nothing is joined, nothing is left on the node.
	scene s.pov "$lens blur_samples 4000"
	expect 0 s.pov +W320 +H240 --parts 6 --equal-rows; dir=$(folder)
	await "running parts" sh -c "[ \"\$(squeue --noheader --states=RUNNING --format=%j | grep -c parts)\" = 2 ]"
	expect 1 --resume "$dir"; says "still wait or run; cancel them first: scancel"
	sh -c "$(sed -n 's/.*first: \(scancel [0-9 ]*\)$/\1/p' err)" || fail "scancel"
	await "end of all" sh -c "[ -z \"\$(squeue --noheader)\" ]"
	await "end of POV-Ray" sh -c "! ps -eo args | grep -v grep | grep -q '$work/s[.]strips\|$work/tmp/povray-strips'"
	[ ! -e s.png ] || fail "a cancelled picture was joined"
	[ "$(parts "$dir")" = 0 ] || fail "parts of a second each"
	await "empty TMPDIR" sh -c "[ -z \"\$(ls '$work/tmp')\" ]"
	expect 0 --status "$dir"; prints "0 of 6 parts are there" ;;
submit)
	# A signal while jobs are submitted, between Slurm's taking the first, second or third and sbatch's saying so: all are cancelled.
	scene s.pov "$blur"
	mkdir path; real=$(command -v sbatch)
	printf '#!/bin/sh\necho >> %s/count\nid=$(%s "$@")\n[ $(grep -c "" %s/count) != $at ] || kill -$signal $PPID\necho "$id"\n' "$work" "$real" "$work" > path/sbatch
	chmod +x path/sbatch
	PATH=$work/path:$PATH
	export at signal
	submit() { # AT SIGNAL CODE ARGUMENT...
		at=$1 signal=$2 code=$3
		shift 3
		rm -f count; expect $code "$@"
	}
	size="+W32 +H24 --parts 2 --equal-rows"
	for at_signal in "1 TERM 143" "2 INT 130" "3 HUP 129"; do
		submit $at_signal s.pov $size --sbatch --hold; dir=$(folder); says "waiting for sbatch's answer"
		says "^cancelled what was submitted: [0-9 ]*$"; [ "$(grep -c '[0-9]' "$dir/jobs.json")" = "$at" ] || fail "not all are recorded: $(cat "$dir/jobs.json")"
		await "end of all" sh -c "[ -z \"\$(squeue --noheader)\" ]"
		[ "$(ls "$dir/parts" "$dir/log" | grep -c txt)" = 0 ] || fail "something ran"
	done
	# Killed outright: what was submitted is recorded, and named.
	rm -r s.strips; submit 2 KILL 137 s.pov $size --sbatch --hold; dir=$(echo s.strips/*)
	expect 1 --resume "$dir"; says "still wait or run; cancel them first: scancel $(last_job "$dir")$"
	squeue --noheader --format=%i | xargs scancel    # the second among them: nobody heard its id
	# A list of cameras.
	strips=$bin/tiltcal-batch; echo 'a --square 25' > list.txt
	submit 2 INT 130 list.txt --sbatch --hold; says "^cancelled what was submitted: [0-9]* [0-9]*$"
	await "end of all" sh -c "[ -z \"\$(squeue --noheader)\" ]" ;;
names)
	# A folder of Latin-1: sbatch's words and script, logs, the command of the part that is missing.
	export LC_ALL=C PYTHONIOENCODING=utf-8:strict
	there=$(printf 'd\351 100%%j x'); mkdir "$there"; cd "$there"
	scene s.pov "$blur"; one one.png s.pov +W32 +H24
	expect 0 s.pov +W32 +H24 --parts 2 --equal-rows; dir=$(folder); prints "$there/s.strips.*/log/"
	await "end of the join" ended "$dir"
	[ -s s.png ] || fail "no picture: $(cat "$dir"/log/*)"
	pixels one.png s.png "no UTF-8"; grep -q "$there/s.png: joined" "$dir/log/join.txt" || fail "$(cat "$dir/log/join.txt")"
	expect 1 s.pov +W32 +H24 --parts 2 --equal-rows --sbatch "--partition=$there"; says "sbatch refused"
	# And a list of cameras.
	strips=$bin/tiltcal-batch; echo "a --square 25 --untilted '$there.jpg'" > list.txt
	expect 0 list.txt; await "end of the table" ended list
	grep -q "alone: .*$there/list" list/log/table.txt || fail "$(cat list/log/table.txt)" ;;
batch)
	# A list of cameras as an array, with the table at the end; one of them fails.
	photos=$here/../../scenes/boxes/photos/target strips=$bin/tiltcal-batch
	. "$here/batch_list.sh"
	write_list > list.txt
	expect 0 list.txt --options "$common"
	prints "^Jobs: cameras [0-9]*, table [0-9]*$"; prints "^Watch:  squeue --jobs=[0-9,]*$"; prints "^Cancel: scancel [0-9 ]*$"
	expect 1 list.txt --options "$common"; says "still wait or run; cancel them first"
	await "end of the table" ended list
	[ "$(job_state "$(last_job list)")" = "FAILED " ] || fail "a failed camera is no failure"
	python3 "$here/batch_tables.py" list plus:done:2 minus:done:2 absent:failed:0 > out 2>&1 || fail "the tables disagree"
	grep -q "2 of 3 cameras are done" list/log/table.txt || fail "$(cat list/log/table.txt)" ;;
guard)
	# Its ports are taken when it comes to use them: it takes others. Whoever started it is killed: it ends, and leaves nothing.
	slurm_programs
	python3 -c 'import socket, sys, time
held = [socket.socket() for i in range(3)]
for s in held: s.bind(("127.0.0.1", 0)); s.listen()
print(*[s.getsockname()[1] for s in held], flush=True)
time.sleep(120)' > ports &
	holder=$!
	trap 'kill $holder 2> /dev/null' EXIT
	slurm_prepare "$work/slurm"
	await "ports" test -s ports
	SLURM_TEST_PORTS=$(cat ports) sh -c 'sh "$0" start "$1" $$ > out 2>&1; kill -KILL $$' "$here/slurm.sh" "$work/slurm" 2> err
	prints "started at attempt 2"
	await "end of the guard" test -e slurm/ended
	slurm_gone "$work/slurm" || fail "left: $(slurm_processes "$work/slurm")" ;;
*) echo "no such case: $case"; exit 99 ;;
esac
echo "all well"
