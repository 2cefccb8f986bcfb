# SPDX-License-Identifier: AGPL-3.0-or-later
"""plan.py PLAN.json FOLDER...: the plan's longest part beside what a submission of so many parts took, relative to one part, in CPU seconds."""
import glob
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
	plan = json.load(file)
points = {point["nodes"]: point for point in plan["pictures"][0]["points"]}
took = {}
for folder in sys.argv[2:]:
	seconds = []
	for record in glob.glob(f"{folder}/parts/*.json"):
		with open(record, encoding="utf-8") as file:
			seconds.append(json.load(file)["cpu_seconds"])
	took[len(seconds)] = max(seconds)
assert sorted(took) == [1, 2, 4], took
said = {n: points[n].get("longest_part_s", points[n]["seconds"]) - (plan["measured"]["python_s"] if n > 1 else 0) for n in took}
for n in (1, 2, 4):
	print(f"{n} parts: said {said[n]:.3f} s, took {took[n]:.3f} s")
for n in (2, 4):
	ratio = said[n] / said[1] / (took[n] / took[1])
	# The longest part may be 1.3 times the mean (balance, issue 18); the model knows it no better.
	assert 1 / 1.3 < ratio < 1.3, f"{n} parts: {ratio:.2f} times what they took"
efficiency = [point["efficiency"] for point in plan["pictures"][0]["points"]]
assert efficiency == sorted(efficiency, reverse=True), "more nodes are never used better"
pays = [picture["pays_to"] for picture in plan["pictures"]]
assert pays == sorted(pays), "a larger picture pays for no fewer nodes"
