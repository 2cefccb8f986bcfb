# SPDX-License-Identifier: AGPL-3.0-or-later
"""One table of all cameras of a batch: as text, CSV, JSON and a page."""
import csv
import html
import io
import os

from batch_line import error_of, is_done, record_of, result_file
from common import read_json, write_json, write_whole

LENS = ("focal_length", "image_distance", "focus_distance", "aperture_diameter")
COLUMNS = ["camera", "status", "verdict", "model", "photographs"] + [f"{name}{what}_mm" for name in LENS for what in ("", "_sigma")] + \
	["rms_reprojection_px", "state", "lens_tilt_deg", "lens_tilt_sigma_deg", "tilt_direction_deg", "tilt_direction_sigma_deg", "rms_blur_px", "seconds", "error", "command"]
STATE = ("lens_tilt_deg", "lens_tilt_sigma_deg", "tilt_direction_deg", "tilt_direction_sigma_deg", "rms_blur_px")


def rows_of(batch, folder, again):
	"""A dictionary a camera; `again(name)` is the command that runs it alone."""
	return [_row(batch, folder, line, again) for line in batch["lines"]]


def _row(batch, folder, line, again):
	name, record = line["name"], record_of(batch, folder, line)
	row = {"camera": name, "status": "done" if is_done(batch, folder, line) else "failed" if record and record["exit"] != 0 else "missing"}
	if record:
		row["seconds"] = round(record["seconds"], 1)
	if row["status"] != "done":
		row["error"] = error_of(folder, name) if row["status"] == "failed" else "its results were changed" if record else \
			"it has not run with these options and photographs, or was ended from outside"
		row["command"] = again(name)
		return row
	found = read_json(result_file(folder, name))
	# The model paper is not judged.
	verdict = found.get("verdict", {"grade": "not judged", "remarks": []})
	row.update({"verdict": verdict["grade"], "model": found["model"], "photographs": sum(len(s["photos"]) for s in found["states"]),
		"rms_reprojection_px": found["rms_reprojection_px"]})
	for quantity in LENS:
		row[f"{quantity}_mm"], row[f"{quantity}_sigma_mm"] = found[f"{quantity}_mm"], found[f"{quantity}_sigma_mm"]
	row["states"] = [{"state": s["name"], **{key: s[key] for key in STATE}} for s in found["states"]]
	row["remarks"] = [remark["text"] for remark in verdict["remarks"] if remark["grade"] != "good"]
	return row


def with_sigma(value, sigma):
	"""Two digits of sigma, as many of the value."""
	if value is None or sigma is None:
		return "-"
	if not sigma:
		return f"{value:.6g}"
	digits = min(9, max(0, 1 - int(f"{sigma:.1e}".partition("e")[2])))
	return f"{value:.{digits}f} ± {sigma:.{digits}f}"


def cells_of(row):
	tilts = ", ".join(f"{s['state']} {with_sigma(s['lens_tilt_deg'], s['lens_tilt_sigma_deg'])}" for s in row.get("states", [])[1:])
	return [row["camera"], row.get("verdict", row["status"])] + [with_sigma(row.get(f"{q}_mm"), row.get(f"{q}_sigma_mm")) for q in LENS] + \
		[f"{row['rms_reprojection_px']:.3f}" if "rms_reprojection_px" in row else "-", tilts or "-"]


HEAD = ["camera", "verdict", "f mm", "w mm", "focus mm", "d mm", "corners px", "lens tilt deg"]


def text_of(rows):
	table = [HEAD] + [cells_of(row) for row in rows]
	widths = [max(len(line[k]) for line in table) for k in range(len(HEAD))]
	lines = ["  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in table]
	bad = [row for row in rows if row["status"] != "done"]
	lines += ["", f"{len(rows) - len(bad)} of {len(rows)} cameras are done"]
	for row in bad:
		lines += [f"{row['camera']} {'failed' if row['status'] == 'failed' else 'is missing'}: {row['error']}", f"  alone: {row['command']}"]
	return "\n".join(lines) + "\n"


def csv_of(rows):
	"""A line a state; a camera without results has one."""
	out = io.StringIO()
	writer = csv.DictWriter(out, COLUMNS, extrasaction="ignore", lineterminator="\n")
	writer.writeheader()
	for row in rows:
		for state in row.get("states", [{}]):
			writer.writerow({**row, **state})
	return out.getvalue()


def page_of(rows, title, folder):
	def cell(text, tag="td", kind=""):
		return f"<{tag}{kind}>{html.escape(text)}</{tag}>"
	body = []
	for row in rows:
		cells = cells_of(row)
		grade = cells[1] if row["status"] == "done" else "failed"
		name = html.escape(cells[0])
		if os.path.exists(f"{folder}/{row['camera']}/report.html") and row["status"] == "done":
			name = f'<a href="{name}/report.html">{name}</a>'
		body.append(f"<tr><td>{name}</td>" + cell(cells[1], kind=f' class="{html.escape(grade)}"') + "".join(cell(text) for text in cells[2:]) + "</tr>")
		notes = row.get("remarks", []) or ([f"{row['error']}; alone: {row['command']}"] if row["status"] != "done" else [])
		if notes:
			body.append(f'<tr><td></td><td colspan="{len(HEAD) - 1}" class="note">' + "<br>".join(html.escape(note) for note in notes) + "</td></tr>")
	done = sum(row["status"] == "done" for row in rows)
	return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title><style>
body {{ font: 15px/1.5 sans-serif; margin: 2em; color: #222 }} table {{ border-collapse: collapse }}
td, th {{ padding: 0.3em 0.9em; border-bottom: 1px solid #ddd; text-align: left; white-space: nowrap }} .note {{ color: #555; white-space: normal; font-size: 13px }}
.good {{ background: #d9f2d9 }} .fair {{ background: #fff3c4 }} .poor, .failed {{ background: #f9d0cc }}
</style></head><body><h1>{html.escape(title)}</h1><p>{done} of {len(rows)} cameras are done.</p>
<table><tr>{"".join(cell(text, "th") for text in HEAD)}</tr>
{chr(10).join(body)}
</table></body></html>
"""


def write_summary(batch, folder, again):
	"""The four files; how many cameras are not done."""
	rows = rows_of(batch, folder, again)
	write_json(f"{folder}/summary.json", {"cameras": rows})
	write_whole(f"{folder}/summary.csv", csv_of(rows))
	write_whole(f"{folder}/summary.html", page_of(rows, f"Calibrations of {os.path.basename(batch['list'])}", folder))
	write_whole(f"{folder}/summary.txt", text_of(rows))
	print(text_of(rows), end="")
	print(f"{folder}/summary.html")
	return sum(row["status"] != "done" for row in rows)
