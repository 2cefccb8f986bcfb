# SPDX-License-Identifier: AGPL-3.0-or-later
"""balance.py POVRAY-STRIPS TIMES FOLDER: the longest part of a submission over the mean, in CPU seconds, each the median of TIMES renders.

The median and not the least: a shared processor renders a part now and then at 1.5 times its usual speed, which the least takes for
the part's own cost where it met it."""
import glob
import json
import os
import statistics
import subprocess
import sys

strips, times, folder = sys.argv[1], int(sys.argv[2]), sys.argv[3]
seconds = {}
for turn in range(times):
	if turn:
		for record in glob.glob(f"{folder}/parts/*.json"):
			os.unlink(record)
		subprocess.run([strips, "--resume", folder, "--local", "2"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
	for record in glob.glob(f"{folder}/parts/*.json"):
		with open(record, encoding="utf-8") as file:
			seconds.setdefault(record, []).append(json.load(file)["cpu_seconds"])
typical = [statistics.median(of_part) for of_part in seconds.values()]
print(f"{max(typical) * len(typical) / sum(typical):.3f}")
