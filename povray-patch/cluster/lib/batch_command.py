# SPDX-License-Identifier: AGPL-3.0-or-later
"""tiltcal-batch: what is done in which order. Of Slurm it knows what slurm.py offers."""
import os
import shlex
import subprocess
import sys

import local
import slurm
from batch_line import enter, is_done, run_line
from batch_options import HELP, folder_for, parse, read_list
from batch_summary import write_summary
from common import DONE, NAMES, REFUSED, Failure, file_error, program, read_json, usage, write_json


def main(words, script):
	return program("tiltcal-batch", HELP, words, lambda: _do(parse(words), script))


def _do(values, script):
	if "--summary" in values:
		return _summary(values["--summary"], script)
	if "--task" in values or "--line" in values:
		folder = os.path.abspath(values["own"][0])
		batch = load(folder)
		if "--task" in values:
			return REFUSED if run_line(batch, folder, _of_number(batch, values["--task"])) else DONE
		code = run_line(batch, folder, _of_name(batch, values["--line"]))
		_summary(folder, script)
		return REFUSED if code else DONE
	return _batch(values, script)


def load(folder):
	batch = read_json(f"{folder}/batch.json")
	if batch is None:
		raise Failure(3, f"{folder}: no batch of tiltcal-batch (there is no batch.json)")
	return batch


def _of_number(batch, number):
	if number >= len(batch["lines"]):
		raise usage(f"--task: the batch has {len(batch['lines'])} lines, counted from 0")
	return batch["lines"][number]


def _of_name(batch, name):
	for line in batch["lines"]:
		if line["name"] == name:
			return line
	raise usage(f"--line: no camera {name} in this batch; there are {', '.join(line['name'] for line in batch['lines'][:20])}")


def _summary(folder, script):
	folder = os.path.abspath(folder)
	batch = load(folder)
	enter(batch)

	def again(name):
		return " ".join(map(shlex.quote, [script, "--line", name, folder]))
	return REFUSED if write_summary(batch, folder, again) else DONE


def _version(tiltcal):
	try:
		return subprocess.run([tiltcal, "--version"], stdin=subprocess.DEVNULL, capture_output=True, **NAMES, check=True).stdout.strip()
	except OSError as error:
		raise Failure(3, f"{tiltcal}: cannot be run ({error.strerror}); give the tiltcal with --tiltcal") from None
	except subprocess.CalledProcessError:
		raise Failure(3, f"{tiltcal} --version fails; is it tiltcal?") from None


def _batch(values, script):
	path = values["own"][0]
	tiltcal = values.get("--tiltcal", os.path.join(os.path.dirname(script), "tiltcal"))
	tiltcal = os.path.abspath(tiltcal) if "/" in tiltcal else tiltcal
	folder = folder_for(path, values.get("--out"))
	batch = {"cwd": os.getcwd(), "list": os.path.abspath(path), "tiltcal": tiltcal, "version": _version(tiltcal), "cpus": values.get("--cpus", 1),
		"lines": read_list(path, values["--options"])}
	waiting = [number for number, line in enumerate(batch["lines"]) if not is_done(batch, folder, line)]
	print(f"{path}: {len(batch['lines'])} cameras, {len(waiting)} to calibrate; into {folder}")
	if "--dry-run" in values:
		for number in waiting:
			print(f"  {batch['lines'][number]['name']}")
		return DONE
	_check_nothing_runs(folder)
	if "--local" not in values and waiting and waiting[-1] > slurm.largest_array():
		raise usage(f"{path}: more cameras than this cluster's arrays may have ({slurm.largest_array() + 1}, MaxArraySize)")
	try:
		os.makedirs(f"{folder}/log", exist_ok=True)
	except OSError as error:
		raise file_error(folder, error) from None
	write_json(f"{folder}/batch.json", batch)
	return _run_here(folder, batch, waiting, values["--local"], script) if "--local" in values else _run_there(folder, batch, waiting, values, script)


def _check_nothing_runs(folder):
	"""Two at once would write into the same folders."""
	slurm.refuse_active(folder, f"{folder}: ", "this batch")


def _run_here(folder, batch, waiting, at_once, script):
	local.check(at_once)
	local.run_all([(f"task-{batch['lines'][n]['name']}", [sys.executable, script, "--task", str(n), folder]) for n in waiting], at_once, f"{folder}/log")
	return _summary(folder, script)


def _run_there(folder, batch, waiting, values, script):
	name, options = os.path.basename(folder), values["--sbatch"]
	own = [shlex.quote(script)]
	with slurm.all_or_none() as jobs:
		array = None
		if waiting:
			array = slurm.sbatch(jobs, name, folder, "task-%a.txt", own + ["--task", '"$SLURM_ARRAY_TASK_ID"', shlex.quote(folder)],
				[f"--cpus-per-task={batch['cpus']}"] + options, array=waiting, at_once=values.get("--nodes", 0))
		slurm.sbatch(jobs, f"{name}-table", folder, "table.txt", own + ["--summary", shlex.quote(folder)], options, after_any=array)
	print(f"Jobs: {'cameras ' + array + ', ' if array else ''}table {jobs[-1]}")
	print(f"Watch:  squeue --jobs={','.join(jobs)}")
	print(f"Cancel: scancel {' '.join(jobs)}")
	print(f"The table at the end: {folder}/summary.html, .txt, .csv, .json")
	return DONE
