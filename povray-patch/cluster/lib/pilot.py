# SPDX-License-Identifier: AGPL-3.0-or-later
"""The first job: learns where the picture's time goes, by tiltcost's pilot, and cuts it."""
import os
import subprocess

from common import NAMES, read_json, refused, write_json
from cutting import FIRST_STRIP, cost_of, cut, equal_rows, frame_groups
from light import light_words, place
from submission import load_cut


def task_count(sub):
	"""How many tasks the array has; known before the pilot."""
	frames = len(sub["frames"] or [None])
	if sub["parts"] <= frames:
		return sub["parts"]
	return frames * strips_of_frame(sub)


def strips_of_frame(sub):
	frames = len(sub["frames"] or [None])
	return max(1, min(-(-sub["parts"] // frames), sub["height"] - FIRST_STRIP + 1))


def make_cut(sub):
	"""Writes cut.json, unless it is there: parts that are done belong to it."""
	if load_cut(sub) is not None:
		return
	frames = sub["frames"] or [None]
	height, count = sub["height"], strips_of_frame(sub)
	units, tasks, how, costs = [], [], "whole frames", {}
	if count == 1:
		for group in frame_groups(frames, sub["parts"]):
			tasks.append(list(range(len(units), len(units) + len(group))))
			units += [{"frame": frame, "first": 1, "last": height} for frame in group]
	else:
		costs, how = row_costs(sub)
		strips = cut(costs["row_s"], count, costs["margin_rows"]) if costs else equal_rows(height, count)
		for frame in frames:
			for strip in strips:
				tasks.append([len(units)])
				units.append({"frame": frame, "first": strip[0] + 1, "last": strip[1] + 1})
				if costs:
					units[-1]["predicted_s"] = costs["start_cpu_s"] + cost_of(costs["row_s"], strip, costs["margin_rows"])
	costs.pop("row_s", None)
	write_json(f"{sub['folder']}/cut.json", {"id": sub["id"], "how": how, "pilot": costs, "units": units, "tasks": tasks})
	print(f"{len(units)} parts: {how}")


def row_costs(sub):
	"""Seconds of every row, and how they were found; nothing where tiltcost cannot say, which is no reason not to render."""
	if sub["equal_rows"]:
		return {}, "equal rows, as asked"
	rows = f"{sub['folder']}/rows.json"
	folder, words = place(sub)
	command = [sub["tiltcost"], "--povray", sub["povray"], *words, "--rows", rows,
		"--pilot-time", sub["pilot_time"], "--pilot-blocks", str(sub["pilot_blocks"])]
	if sub["frames"]:
		middle = sub["frames"][len(sub["frames"]) // 2]
		command += [f"+SF{middle}", f"+EF{middle}"]
	command += light_words(sub)
	if sub["setting"]:
		command += ["--setting", sub["setting"]]
	if sub["may_write"]:
		command.append("--scene-may-write")
	try:
		done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **NAMES, check=False,
			cwd=folder)
	except OSError as error:
		return {}, f"equal rows, because {sub['tiltcost']} cannot be run ({error.strerror})"
	if done.returncode != 0:
		said = " ".join(done.stderr.split("error:", 1)[-1].split())
		return {}, f"equal rows, because tiltcost says: {said[:300]}"
	costs = read_json(rows)
	os.unlink(rows)
	if len(costs["row_s"]) != sub["height"]:
		raise refused(f"tiltcost saw {len(costs['row_s'])} rows, not {sub['height']}: does the scene choose its own size?")
	return costs, f"equal cost by the pilot, {costs['setting']}"
