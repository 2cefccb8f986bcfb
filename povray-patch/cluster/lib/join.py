# SPDX-License-Identifier: AGPL-3.0-or-later
"""The last job: one picture, or a film's frames, when every part of this submission is there."""
import contextlib
import glob
import os
import shlex
import subprocess

from common import NAMES, Failure, file_error, read_json, refused, write_json
from scene import frame_name
from submission import describe, is_done, load_cut, missing_units, part_file
from submission import record_file, stamp


def join(sub, script):
	cut = load_cut(sub)
	if cut is None:
		raise refused(f"nothing was rendered: the pilot failed or was cancelled ({sub['folder']}/log/pilot.txt); then\n  {resume(sub, script)}")
	missing = missing_units(sub, cut, thorough=True)
	if missing:
		raise refused(missing_text(sub, cut, missing, script))
	frames = _frames(cut)
	# All are checked and made before one is moved: a film is replaced whole or not at all.
	joined = _joined(sub)
	made = {}
	try:
		for frame in frames:
			numbers = [i for i, unit in enumerate(cut["units"]) if unit["frame"] == frame]
			_check_rows([cut["units"][i] for i in numbers], sub["height"])
			target = frame_name(sub["output"], frame, sub["digits"])
			_check_target(sub, target, joined)
			made[target] = (f"{sub['folder']}/{os.path.basename(target)}", numbers)
		for picture, numbers in made.values():
			_make(sub, picture, numbers, script)
		for target in made:
			_check_target(sub, target, joined)
		_move({target: picture for target, (picture, _) in made.items()}, f"{sub['folder']}/joined.json")
	finally:
		for picture, _ in made.values():
			with contextlib.suppress(OSError):
				os.unlink(picture)
	print(balance_text(sub, cut))
	print(f"{sub['output'] if frames == [None] else frame_name(sub['output'], frames[0], sub['digits']) + ' and so on'}: joined from {len(cut['units'])} parts")


def _frames(cut):
	return sorted({unit["frame"] for unit in cut["units"]}, key=lambda frame: frame or 0)


def _make(sub, picture, numbers, script):
	for left in glob.glob(f"{glob.escape(picture)}.*.new"):    # a join before was ended
		os.unlink(left)
	done = subprocess.run([sub["picture_rows"], "join", str(sub["height"]), picture] + [part_file(sub, i) for i in numbers],
		stdin=subprocess.DEVNULL, capture_output=True, **NAMES, check=False)
	if done.returncode != 0:
		raise Failure(3, f"{done.stderr.strip()}; the parts stay, join again with\n  {command(script, '--join', sub)}")


def _move(pictures, record):
	"""What is there and what is to be there are both known as ours before, so that a join that is ended now may be done again."""
	new = {target: stamp(made) for target, made in pictures.items()}
	write_json(record, {target: [now for now in (stamp(target), new[target]) if now] for target in pictures})
	for target, made in pictures.items():
		try:
			os.replace(made, target)
		except OSError as error:
			raise file_error(target, error) from None
	write_json(record, {target: [new[target]] for target in pictures})


def _joined(sub):
	"""By picture, how this submission's joins left it: a list, of which one is right."""
	return read_json(f"{sub['folder']}/joined.json") or {}


def _check_rows(units, height):
	"""Strips that follow each other from the first row to the last."""
	at = 1
	for unit in units:
		if unit["first"] != at:
			raise refused(f"the parts do not fit: row {at} is missing or there twice")
		at = unit["last"] + 1
	if at != height + 1:
		raise refused(f"the parts do not fit: they end with row {at - 1} of {height}")


def _check_target(sub, target, joined):
	"""What somebody else wrote since the submission, such as a newer one, is not replaced by an older picture."""
	why = "it is a folder" if os.path.isdir(target) else "it was written since this submission began, by a newer one perhaps" \
		if stamp(target) not in (None, sub["before"].get(target), *joined.get(target, [])) else ""
	if why:
		raise refused(f"{target}: {why}; move it away and run\n  povray-strips --join {shlex.quote(sub['folder'])}")
	try:
		os.makedirs(os.path.dirname(target), exist_ok=True)
	except OSError as error:
		raise file_error(target, error) from None
	if not os.access(os.path.dirname(target), os.W_OK | os.X_OK):
		raise Failure(3, f"{target}: its folder cannot be written into")


def command(script, action, sub, *more):
	return " ".join([shlex.quote(script), action, *more, shlex.quote(sub["folder"])])


def resume(sub, script):
	return command(script, "--resume", sub)


def missing_text(sub, cut, missing, script):
	task_of = {unit: task for task, units in enumerate(cut["tasks"]) for unit in units}
	lines = [f"{len(missing)} of {len(cut['units'])} parts are missing, no picture is written:"]
	shown = set()
	for unit in missing[:20]:
		lines.append(f"  part {unit}, {describe(cut['units'][unit])}; alone:")
		task = task_of[unit]
		lines.append(f"    {command(script, '--part', sub, str(task))}    (log/part-{task}.txt says what happened)" if task not in shown else "    the same command")
		shown.add(task)
	if len(missing) > 20:
		lines.append(f"  and {len(missing) - 20} more")
	lines.append(f"All of them again, and only them:\n  {resume(sub, script)}")
	return "\n".join(lines)


def balance_text(sub, cut):
	seconds = [read_json(record_file(sub, i))["seconds"] for i in range(len(cut["units"]))]
	mean = sum(seconds) / len(seconds)
	return f"parts: {mean:.2f} s on average, the longest {max(seconds):.2f} s, {max(seconds) / mean:.2f} times the mean; {cut['how']}"


def status_text(sub, script):
	cut = load_cut(sub)
	if cut is None:
		return "not cut yet: the pilot has not run"
	there = [i for i in range(len(cut["units"])) if is_done(sub, cut, i)]
	missing = [i for i in range(len(cut["units"])) if i not in set(there)]
	if not missing:
		joined = _joined(sub)
		targets = [frame_name(sub["output"], frame, sub["digits"]) for frame in _frames(cut)]
		is_joined = all(target in joined and stamp(target) == joined[target][-1] for target in targets)
		return f"all {len(there)} parts are there, " + ("joined" if is_joined else f"not joined:\n  {command(script, '--join', sub)}")
	return f"{len(there)} of {len(cut['units'])} parts are there\n" + missing_text(sub, cut, missing, script)
