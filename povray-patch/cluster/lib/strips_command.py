# SPDX-License-Identifier: AGPL-3.0-or-later
"""povray-strips: what is asked for, and in which order it is done."""
import os
import re
import shlex
import sys

import local
import slurm
from common import DONE, program, read_text, refused, usage
from join import command, join, status_text
from light import make_light
from part import render_task
from planning import plan
from pilot import make_cut, task_count
from scene import files_of, frame_name, inspect
from strips_options import HELP, parse
from submission import create, load, load_cut, missing_units, stamp


def main(words, script):
	return program("povray-strips", HELP, words, lambda: _do(parse(words), script))


def _do(values, script):
	if "--part" in values:
		render_task(load(values["own"][0]), values["--part"])
	elif "--cut" in values:
		sub = load(values["--cut"])
		make_light(sub)
		make_cut(sub)
	elif "--join" in values:
		join(load(values["--join"]), script)
	elif "--status" in values:
		print(status_text(load(values["--status"]), script))
	elif "--resume" in values:
		return _resume(load(values["--resume"]), values, script)
	elif "--plan" in values:
		plan(_describe(values, script), script)
	else:
		return _submit(values, script)
	return DONE


def _describe(values, script):
	"""The submission, all but its folder; every reason to refuse it is found here."""
	beside = os.path.dirname(script)
	povray = values.get("--povray", os.path.join(beside, "povray"))
	povray = os.path.abspath(povray) if "/" in povray else povray
	scene, words = values["own"][0], values["all"]
	found = inspect(povray, scene, words + (["Declare=Strips_Light=0"] if "--light" in values else []), os.getcwd(), "--scene-may-write" in values)
	if any(re.match(r"[+-]WT|Work_Threads=", word, re.I) for word in words):
		print(f"note: threads of a part: {values.get('--cpus', 1)}, by --cpus, in place of +WT", file=sys.stderr)
	output = os.path.abspath(found["output"])
	frames = found["frames"]
	if frames and "--light" in values:
		print(f"note: --light: all frames have the radiosity and photons of frame {frames[0]}", file=sys.stderr)
	targets = [frame_name(output, frame, found["digits"]) for frame in frames or [None]]
	return {"cwd": os.getcwd(), "scene": scene, "words": words, "povray": povray, "tiltcost": os.path.join(beside, "tiltcost"),
		"picture_rows": os.path.join(beside, "..", "lib", "tilt-lens", "picture_rows"), "parts": values.get("--parts", len(frames) if frames else 40),
		"frames": frames, "digits": found["digits"], "width": found["width"], "height": found["height"], "suffix": found["suffix"],
		"cpus": values.get("--cpus", 1), "at_once": values.get("--nodes", 0), "sbatch": values["--sbatch"], "light": "--light" in values,
		"pilot_time": values.get("--pilot-time", "10s"), "pilot_blocks": values.get("--pilot-blocks", 400), "setting": values.get("--setting", ""),
		"equal_rows": "--equal-rows" in values, "may_write": "--scene-may-write" in values, "files": files_of(scene, words, found, targets),
		"input": found["input"], "libraries": [os.path.abspath(path) for path in found["libraries"]],
		"before": {target: stamp(target) for target in targets if stamp(target)}, "output": output}


def _submit(values, script):
	sub = _describe(values, script)
	count = task_count(sub)
	if "--local" not in values and "--dry-run" not in values and count - 1 > slurm.largest_array():
		raise usage(f"--parts: {count} are more than this cluster's arrays may have ({slurm.largest_array() + 1}, MaxArraySize)")
	film = f", {len(sub['frames'])} frames" if sub["frames"] else ""
	print(f"{sub['scene']}: {sub['width']} x {sub['height']}{film} in {count} parts, {len(sub['files'])} files of the scene; into {sub['output']}")
	if "--dry-run" in values:
		print("Not submitted (--dry-run). It would be: the pilot, 1 task" + (", with the light" if sub["light"] else "") +
			f"; the array, {count} tasks of {sub['cpus']} processors" + (f", {sub['at_once']} at once" if sub["at_once"] else "") + "; the join, 1 task")
		for target in [sub["output"]] if not sub["frames"] else []:
			if target in sub["before"]:
				print(f"{target} is there and would be replaced")
		return DONE
	folder = create(sub["output"], {name: value for name, value in sub.items() if name != "output"})
	print(f"Folder: {folder}")
	return _start(load(folder), list(range(count)), values, script)


def _resume(sub, values, script):
	if "--local" not in values:
		slurm.refuse_active(sub["folder"], "", "this submission")
	cut = load_cut(sub)
	tasks = list(range(task_count(sub)))
	if cut is not None:
		missing = set(missing_units(sub, cut, thorough=True))
		tasks = [task for task, units in enumerate(cut["tasks"]) if missing & set(units)]
		print(f"{len(missing)} of {len(cut['units'])} parts are missing")
	return _start(sub, tasks, values, script)


def _start(sub, tasks, values, script):
	"""What --resume says anew counts: of two equal words for sbatch the last one does."""
	if "--resume" in values:
		sub = {**sub, "sbatch": sub["sbatch"] + values["--sbatch"], "at_once": values.get("--nodes", sub["at_once"])}
	return _run_here(sub, tasks, values["--local"], script) if "--local" in values else _run_there(sub, tasks, script)


def _run_here(sub, tasks, at_once, script):
	local.check(at_once)
	python = [sys.executable, script]
	log = f"{sub['folder']}/log"
	if load_cut(sub) is None and local.run_all([("pilot", python + ["--cut", sub["folder"]])], 1, log):
		raise refused("the pilot failed:\n" + read_text(f"{log}/pilot.txt").strip())
	tasks = [task for task in tasks if task < len(load_cut(sub)["tasks"])]
	local.run_all([(f"part-{task}", python + ["--part", str(task), sub["folder"]]) for task in tasks], at_once, log)
	join(sub, script)
	return DONE


def _run_there(sub, tasks, script):
	folder = sub["folder"]
	name = os.path.splitext(os.path.basename(sub["output"]))[0]
	words = [shlex.quote(script)]
	options = sub["sbatch"]
	threads = [f"--cpus-per-task={sub['cpus']}"]
	pilot = None
	with slurm.all_or_none() as jobs:
		if load_cut(sub) is None:
			pilot = slurm.sbatch(jobs, f"{name}-pilot", folder, "pilot.txt", words + ["--cut", shlex.quote(folder)], threads + options)
		array = None
		if tasks:
			array = slurm.sbatch(jobs, f"{name}-parts", folder, "part-%a.txt", words + ["--part", '"$SLURM_ARRAY_TASK_ID"', shlex.quote(folder)],
				threads + options, array=tasks, at_once=sub["at_once"], after=pilot)
		slurm.sbatch(jobs, f"{name}-join", folder, "join.txt", words + ["--join", shlex.quote(folder)], options, after_any=array)
	ids = ",".join(jobs)
	print(f"Jobs: {'pilot ' + pilot + ', ' if pilot else ''}{'parts ' + array + ', ' if array else ''}join {jobs[-1]}")
	print(f"Watch:  squeue --jobs={ids}; {command(script, '--status', sub)}")
	print(f"Cancel: scancel {' '.join(jobs)}")
	print(f"What was said: {folder}/log/; the last word is join.txt")
	return DONE
