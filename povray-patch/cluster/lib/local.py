# SPDX-License-Identifier: AGPL-3.0-or-later
"""The same jobs on this machine, so many at once."""
import os
import subprocess
import sys
import time


def run_all(commands, at_once, log_folder):
	"""Each (name, words) to its end, its words in log_folder/NAME.txt. Names of those that failed; none is tried twice."""
	waiting, running, failed, done = list(commands), {}, [], 0
	try:
		while waiting or running:
			while waiting and len(running) < at_once:
				name, words = waiting.pop(0)
				with open(f"{log_folder}/{name}.txt", "ab") as log:
					running[subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)] = name
			for child in [child for child in running if child.poll() is not None]:
				name = running.pop(child)
				done += 1
				if child.returncode != 0:
					failed.append(name)
				# Over the line before on a screen, a line each in a file.
				line = f"{done} of {len(commands)} done" + (f", {len(failed)} failed" if failed else "")
				print(f"\r{line}" if sys.stderr.isatty() else line, end="" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)
			time.sleep(0.02)
	except BaseException:
		for child in running:
			child.terminate()    # it ends its own POV-Ray
		for child in running:
			child.wait()
		raise
	finally:
		if commands and sys.stderr.isatty():
			print(file=sys.stderr)
	return failed


def check(at_once):
	"""More at once than there are processors only makes each slower; said, not refused."""
	processors = len(os.sched_getaffinity(0))
	if at_once > processors:
		print(f"note: {at_once} parts at once on {processors} processors", file=sys.stderr)
