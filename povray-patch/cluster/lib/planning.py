# SPDX-License-Identifier: AGPL-3.0-or-later
"""Before a cluster is asked: how long a picture takes on so many nodes, and where more of them stop paying (--plan). What a part costs is
measured here, on one picture of the scene; the rest is arithmetic. Waiting for nodes is Slurm's and is not in it."""
import os
import resource
import shutil
import sys
import tempfile

from common import duration, read_text, refused, run, usage, write_json
from cutting import longest
from pilot import row_costs
from plan_plot import plot
from povray_options import error_lines, quoted
from scene import command

NODES = (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000)
WIDTHS = (3840, 7680, 15360)
PAYS = 0.5      # of the nodes' hours, at least so much renders


def plan(sub, script):
	if sub["frames"]:
		raise usage("--plan is about one picture; a film's frames need nothing of each other: as many nodes as frames pay")
	measured = measure({**sub, "light": False}, script)
	sizes = [1] + [width / sub["width"] for width in WIDTHS if width > 1.2 * sub["width"]]
	curves = [curve(measured, scale) for scale in sizes]
	stem = os.path.splitext(sub["output"])[0]
	write_json(f"{stem}.plan.json", {"scene": sub["scene"], "measured": {key: value for key, value in measured.items() if key != "row_s"}, "pictures": curves})
	print(text_of(measured, curves), end="")
	print(f"{stem}.plan.json" + (f", {stem}.plan.svg" if plot(f"{stem}.plan.svg", curves, sub["scene"]) else ""))


def _cpu_of(words, log, cwd=None):
	"""CPU seconds of a child; its exit code is checked."""
	before = resource.getrusage(resource.RUSAGE_CHILDREN)
	code = run(words, log, cwd=cwd)
	after = resource.getrusage(resource.RUSAGE_CHILDREN)
	if code != 0:
		raise refused(f"{words[0]} failed:\n{error_lines(read_text(log))}")
	return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(sub, script):
	"""Seconds of processor time: a part's own (start, writing), by the picture's size; the join's; every row's."""
	folder = tempfile.mkdtemp(prefix="povray-strips-")
	try:
		costs, how = row_costs({**sub, "folder": folder})
		if not costs:
			raise refused(f"--plan needs the pilot, and there would be {how}")
		log, found = f"{folder}/log", {}
		for share in (1, 2):
			size = [f"+W{max(2, sub['width'] // share)}", f"+H{max(2, sub['height'] // share)}"]
			picture = f"{folder}/{share}{sub['suffix']}"
			more = size + ["+GA", "+WT1", "+SC2", "+EC2", "+SR2", "+ER2", "+O" + quoted(picture)]
			found[share] = _cpu_of(command(sub["povray"], sub["words"], more), log)
		join = _cpu_of([sub["picture_rows"], "cut", "1", str(sub["height"]), f"{folder}/1{sub['suffix']}", f"{folder}/joined{sub['suffix']}"], log)
		python = _cpu_of([sys.executable, script, "--version"], log)
	finally:
		shutil.rmtree(folder, ignore_errors=True)
	pixels = sub["width"] * sub["height"]
	by_pixel = max(0.0, found[1] - found[2]) / (0.75 * pixels)
	return {"width": sub["width"], "height": sub["height"], "start_s": max(costs["start_cpu_s"], found[1] - by_pixel * pixels), "python_s": python,
		"write_s_per_pixel": by_pixel, "join_s_per_pixel": join / pixels, "pilot_s": costs["pilot_wall_s"], "margin_rows": costs["margin_rows"],
		"setting": costs["setting"], "row_s": costs["row_s"]}


def scaled_rows(row_s, height, scale):
	"""As many pixels more in a row, and as many rows more."""
	rows = max(2, round(height * scale))
	return [row_s[min(height - 1, int(k / scale))] * scale for k in range(rows)]


def curve(m, scale):
	width, height = round(m["width"] * scale), round(m["height"] * scale)
	rows = scaled_rows(m["row_s"], m["height"], scale)
	pixels = width * height
	own = m["start_s"] + m["write_s_per_pixel"] * pixels
	alone = own + sum(rows)
	points = [{"nodes": 1, "seconds": alone, "efficiency": 1.0}]
	for nodes in NODES[1:]:
		# A part: POV-Ray's start, its rows with their margins, the whole picture's frame written and read to its rows; then the join.
		part = own + m["python_s"] + m["join_s_per_pixel"] * pixels / nodes + longest(rows, nodes, m["margin_rows"])
		seconds = m["pilot_s"] + part + m["python_s"] + m["join_s_per_pixel"] * pixels
		points.append({"nodes": nodes, "seconds": seconds, "longest_part_s": part, "efficiency": alone / (nodes * seconds)})
	return {"width": width, "height": height, "points": points, "pays_to": max(p["nodes"] for p in points if p["efficiency"] >= PAYS)}


def text_of(m, curves):
	lines = [f"A part's own time {m['start_s'] + m['python_s']:.2f} s and {1e6 * m['write_s_per_pixel']:.3f} s a million pixels; the pilot {duration(m['pilot_s'])}; "
		f"the join {1e6 * m['join_s_per_pixel']:.3f} s a million pixels; {m['margin_rows']} margin rows; {m['setting']}", "",
		"nodes  " + "".join(f"{c['width']} x {c['height']}".rjust(24) for c in curves)]
	for k, nodes in enumerate(NODES):
		cells = [f"{duration(c['points'][k]['seconds'])}  {100 * c['points'][k]['efficiency']:3.0f} %" for c in curves]
		lines.append(f"{nodes:5d}  " + "".join(cell.rjust(24) for cell in cells))
	lines += ["", "At least half of the nodes' time renders up to " + ", ".join(f"{c['pays_to']} nodes at {c['width']} x {c['height']}" for c in curves)]
	return "\n".join(lines) + "\n"
