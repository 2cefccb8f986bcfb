# SPDX-License-Identifier: AGPL-3.0-or-later
"""A task of the array: renders its units, each into a picture of its own rows with a record beside it."""
import os
import resource
import shutil
import socket
import tempfile
import time

from common import Failure, digest, read_text, refused, run, write_json
from light import light_words, place
from povray_options import error_lines, quoted
from scene import check_files, command
from submission import describe, is_done, load_cut, part_file, record_file


def render_task(sub, task):
	cut = load_cut(sub)
	if cut is None:
		raise refused(f"{sub['folder']}: not cut yet; the pilot's job failed or has not run: log/pilot.txt")
	if task >= len(cut["tasks"]):
		print(f"task {task}: nothing to do, the picture has {len(cut['tasks'])} parts")
		return
	here = socket.gethostname() if "SLURMD_NODENAME" not in os.environ else os.environ["SLURMD_NODENAME"]
	try:
		os.chdir(sub["cwd"])
	except OSError as error:
		raise Failure(3, f"{here} does not see the working folder {sub['cwd']} ({error.strerror}); it must be on a disk that all nodes share") from None
	for unit in cut["tasks"][task]:
		if is_done(sub, cut, unit, thorough=True):
			print(f"part {unit}: there already")
			continue
		check_files(sub["files"], here)
		_render(sub, cut["units"][unit], unit, here)


def _render(sub, rows, unit, here):
	start, began = time.monotonic(), time.time()
	# POV-Ray's picture has the whole size and stays on the node's own disk.
	folder = tempfile.mkdtemp(prefix="povray-strips-")
	try:
		picture, log = os.path.join(folder, "part" + sub["suffix"]), os.path.join(folder, "log")
		more = ["+O" + quoted(picture), "+GA", *light_words(sub)]
		if (rows["first"], rows["last"]) != (1, sub["height"]):
			more += [f"+SR{rows['first']}", f"+ER{rows['last']}"]
		if rows["frame"] is not None:
			more += [f"+SF{rows['frame']}", f"+EF{rows['frame']}"]
		if sub["cpus"]:
			more.append(f"+WT{sub['cpus']}")
		cpu = _children_cpu()
		place_, words = place(sub)
		code = run(command(sub["povray"], words, more), log, cwd=place_)
		cpu = _children_cpu() - cpu
		said = read_text(log)
		written = [name for name in os.listdir(folder) if name.endswith(sub["suffix"])]
		if code != 0 or len(written) != 1:
			_keep_log(log, f"{sub['folder']}/log/povray-{unit:05d}.txt")
			raise refused(f"part {unit} ({describe(rows)}): POV-Ray failed on {here} with exit code {code}:\n{error_lines(said)}")
		target = part_file(sub, unit)
		code = run([sub["picture_rows"], "cut", str(rows["first"]), str(rows["last"]), os.path.join(folder, written[0]), target], f"{folder}/cut")
		if code != 0:
			raise Failure(3, f"part {unit}: " + read_text(f"{folder}/cut").strip())
		write_json(record_file(sub, unit), {"id": sub["id"], "unit": unit, "frame": rows["frame"], "first": rows["first"], "last": rows["last"],
			"bytes": os.path.getsize(target), "sha256": digest(target), "node": here, "began": began,
			"seconds": time.monotonic() - start, "cpu_seconds": cpu})
		print(f"part {unit}: {describe(rows)}, {time.monotonic() - start:.1f} s on {here}")
	finally:
		shutil.rmtree(folder, ignore_errors=True)


def _children_cpu():
	"""Seconds, finer than os.times() has them."""
	used = resource.getrusage(resource.RUSAGE_CHILDREN)
	return used.ru_utime + used.ru_stime


def _keep_log(log, kept):
	try:
		shutil.copyfile(log, kept)
	except OSError:
		pass    # the message says the most of it
