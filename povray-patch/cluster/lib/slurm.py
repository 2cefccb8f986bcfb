# SPDX-License-Identifier: AGPL-3.0-or-later
"""Slurm's own commands. What schedules, watches and requeues is Slurm."""
import contextlib
import re
import subprocess
import sys

from common import NAMES, Failure, read_json, refused, signals_wait, write_json


def call(command):
	try:
		done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, **NAMES, check=False)
	except FileNotFoundError:
		raise refused(f"{command[0]}: no such program; is this the cluster's login node? Without Slurm: --local N") from None
	if done.returncode != 0:
		raise refused(f"{command[0]} refused: {(done.stderr or done.stdout).strip()}")
	return done.stdout


def largest_array():
	"""The highest index that an array may have."""
	found = re.search(r"^MaxArraySize\s*=\s*(\d+)", call(["scontrol", "show", "config"]), re.M)
	return int(found.group(1)) - 1 if found else 1000


def index_list(numbers):
	"""[0, 1, 2, 5] as 0-2,5."""
	ranges = []
	for number in sorted(numbers):
		if ranges and ranges[-1][1] == number - 1:
			ranges[-1][1] = number
		else:
			ranges.append([number, number])
	return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in ranges)


def sbatch(jobs, name, folder, log, command, options, array=None, at_once=0, after=None, after_any=None):
	"""Submits; the job's id, which is in `jobs` (all_or_none) and in jobs.json then. `command` is words, `log` a name below the folder's log/."""
	words = ["sbatch", "--parsable", "--requeue", "--open-mode=append", f"--job-name={name}", f"--chdir={folder}",
		f"--output={folder.replace('%', '%%')}/log/{log}", "--kill-on-invalid-dep=yes"]
	if array is not None:
		words.append(f"--array={index_list(array)}" + (f"%{at_once}" if at_once else ""))
	if after:
		words.append(f"--dependency=afterok:{after}")
	if after_any:
		words.append(f"--dependency=afterany:{after_any}")
	script = "#!/bin/sh\nexec " + " ".join(command) + "\n"
	# A job whose id is not heard could not be cancelled: a signal waits, and Ctrl-C does not reach sbatch.
	with signals_wait("waiting for sbatch's answer"):
		done = subprocess.run(words + options, input=script, capture_output=True, **NAMES, check=False, start_new_session=True)
		if done.returncode != 0:
			raise refused(f"sbatch refused: {(done.stderr or done.stdout).strip()}")
		jobs.append(done.stdout.strip().split(";")[0])
		write_json(f"{folder}/jobs.json", jobs)
	return jobs[-1]


@contextlib.contextmanager
def all_or_none():
	"""A list for the ids of jobs that belong together. Where one is refused, or a signal comes, those before it are cancelled."""
	jobs = []
	try:
		yield jobs
	except BaseException:
		if jobs:
			_cancel(jobs)
		raise


def _cancel(jobs):
	try:
		call(["scancel"] + jobs)
		print(f"cancelled what was submitted: {' '.join(jobs)}", file=sys.stderr)
	except Failure as error:
		print(f"submitted and not cancelled ({error}); do it: scancel {' '.join(jobs)}", file=sys.stderr)


def refuse_active(folder, place, whose):
	"""Refuses while jobs of jobs.json wait or run, and where Slurm does not say."""
	still = _active(read_json(f"{folder}/jobs.json") or [], folder)
	if still:
		raise refused(f"{place}jobs {' '.join(still)} of {whose} still wait or run; cancel them first: scancel {' '.join(still)}")


def _active(jobs, folder):
	"""Those of the jobs that wait or run; none where there is no Slurm."""
	found = []
	for job in jobs:
		try:
			done = subprocess.run(["squeue", "--noheader", "--format=%i", f"--jobs={job}"], stdin=subprocess.DEVNULL,
				capture_output=True, **NAMES, check=False)
		except FileNotFoundError:
			return []
		if done.returncode != 0 and "Invalid job id" not in done.stderr:    # so it calls what ended long ago
			raise refused(f"squeue does not say whether job {job} still waits or runs ({done.stderr.strip()}); try again when it does, "
				f"or remove {folder}/jobs.json if nothing runs")
		if done.returncode == 0 and done.stdout.strip():
			found.append(job)
	return found
