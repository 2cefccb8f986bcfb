# SPDX-License-Identifier: AGPL-3.0-or-later
"""A line of a batch: its record, whether it is done, its run."""
import fcntl
import glob
import os
import re
import shlex
import socket
import time

from common import NAMES, Failure, digest, read_json, read_text, refused, run, write_json


def files_of(words):
	"""Digests of what the words name, by themselves, after any =, or as a pattern."""
	found = {}
	for word in words:
		for text in {word.split("=", k)[-1] for k in range(word.count("=") + 1)} - {""}:
			# A name with brackets is itself, as for tiltcal.
			for path in [text] if os.path.exists(text) else glob.glob(text):
				if os.path.isfile(path):
					found[path] = digest(path)
	return found


def record_file(folder, name):
	return f"{folder}/log/{name}.json"


def log_file(folder, name):
	return f"{folder}/log/{name}.txt"


def result_file(folder, name):
	return f"{folder}/{name}/calibration.json"


def record_of(batch, folder, line):
	"""What became of the line as it stands now; None where it has not run, or with other options, photographs or another tiltcal."""
	record = read_json(record_file(folder, line["name"]))
	if record is None or record["words"] != line["words"] or record["version"] != batch["version"] or record["files"] != files_of(line["words"]):
		return None
	return record


def is_done(batch, folder, line):
	record = record_of(batch, folder, line)
	if record is None or record["exit"] != 0:
		return False
	try:
		return digest(result_file(folder, line["name"])) == record["result_sha256"]
	except OSError:
		return False


def enter(batch):
	"""Into the folder from where photographs are named."""
	try:
		os.chdir(batch["cwd"])
	except OSError as error:
		raise Failure(3, f"{socket.gethostname()} does not see the working folder {batch['cwd']} ({error.strerror}); it must be on a disk that all nodes share") from None


def run_line(batch, folder, line):
	"""tiltcal's exit code. The record is written when all is done."""
	enter(batch)
	name, words = line["name"], line["words"]
	if is_done(batch, folder, line):
		print(f"{name}: done already")
		return 0
	files, start = files_of(words), time.monotonic()
	threads = [] if any(re.match(r"--threads(=|$)", word) for word in words) else ["--threads", str(batch["cpus"])]
	command = [batch["tiltcal"], "calibrate", *words, *threads, "--out", f"{folder}/{name}"]
	log = log_file(folder, name)
	with open(log, "a", **NAMES) as out:
		try:
			fcntl.flock(out, fcntl.LOCK_EX | fcntl.LOCK_NB)
		except OSError:
			raise refused(f"{name}: another tiltcal-batch calibrates it now") from None
		out.truncate(0)
		out.write(" ".join(map(shlex.quote, command)) + "\n")
		out.flush()
		code = run(command, log)
	record = {"words": words, "files": files, "version": batch["version"], "exit": code, "seconds": time.monotonic() - start,
		"node": os.environ.get("SLURMD_NODENAME", socket.gethostname())}
	if code == 0:
		record["result_sha256"] = digest(result_file(folder, name))
	write_json(record_file(folder, name), record)
	print(f"{name}: " + (f"done in {record['seconds']:.1f} s" if code == 0 else f"tiltcal ended with exit code {code}: {error_of(folder, name)}"))
	return code


def error_of(folder, name):
	"""tiltcal's last word."""
	try:
		lines = [line.strip() for line in read_text(log_file(folder, name)).split("\n") if line.strip()]
	except OSError:
		return "nothing was said"
	errors = [line for line in lines[1:] if "error:" in line.lower()]
	return re.sub(r"^tiltcal: *(error: *)?", "", (errors or lines[1:] or ["nothing was said"])[-1])
