# SPDX-License-Identifier: AGPL-3.0-or-later
"""batch_tables.py FOLDER NAME:STATUS:STATES...: whether a batch's four tables say the same of its cameras, and what their calibration.json says."""
import csv
import json
import sys

folder = sys.argv[1]
with open(f"{folder}/summary.json", encoding="utf-8") as file:
	rows = {row["camera"]: row for row in json.load(file)["cameras"]}
with open(f"{folder}/summary.csv", encoding="utf-8", newline="") as file:
	table = list(csv.DictReader(file))
with open(f"{folder}/summary.html", encoding="utf-8") as file:
	page = file.read()
with open(f"{folder}/summary.txt", encoding="utf-8") as file:
	text = file.read()
assert list(rows) == [word.split(":")[0] for word in sys.argv[2:]], f"cameras {list(rows)}"
for name, status, states in (word.split(":") for word in sys.argv[2:]):
	row, lines = rows[name], [line for line in table if line["camera"] == name]
	assert row["status"] == status, row
	assert name in text and name in page
	assert len(lines) == max(int(states), 1), lines
	assert all(line["status"] == status for line in lines)
	if status != "done":
		assert row["command"] in text and f"--line {name} " in row["command"] and lines[0]["command"] == row["command"]
		assert row["error"] and row["error"] in text
		continue
	with open(f"{folder}/{name}/calibration.json", encoding="utf-8") as file:
		found = json.load(file)
	assert row["focal_length_mm"] == found["focal_length_mm"] == float(lines[0]["focal_length_mm"])
	assert f'href="{name}/report.html"' in page
	for line, state in zip(lines, found["states"]):
		assert line["state"] == state["name"] and float(line["lens_tilt_deg"]) == state["lens_tilt_deg"], line
	# The lens of scenes/boxes: 45 mm, tilted by 5 degrees; three photographs a state tell that to some per cent.
	assert abs(row["focal_length_mm"] - 45) < 2 and abs(abs(row["states"][1]["lens_tilt_deg"]) - 5) < 0.5, row
