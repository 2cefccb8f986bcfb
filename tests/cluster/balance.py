# SPDX-License-Identifier: AGPL-3.0-or-later
"""balance.py POVRAY-STRIPS TIMES FOLDER: the longest part of a submission over the mean, in CPU seconds, each the least of TIMES renders."""
import glob
import json
import os
import subprocess
import sys

strips, times, folder = sys.argv[1], int(sys.argv[2]), sys.argv[3]
least = {}
for turn in range(times):
	if turn:
		for record in glob.glob(f"{folder}/parts/*.json"):
			os.unlink(record)
		subprocess.run([strips, "--resume", folder, "--local", "2"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
	for record in glob.glob(f"{folder}/parts/*.json"):
		with open(record, encoding="utf-8") as file:
			seconds = json.load(file)["cpu_seconds"]
		least[record] = min(seconds, least.get(record, seconds))
print(f"{max(least.values()) * len(least) / sum(least.values()):.3f}")
