# SPDX-License-Identifier: AGPL-3.0-or-later
"""The plot of --plan, by gnuplot, as tiltcost's."""
import os
import subprocess
import sys

from common import NAMES


def plot(path, curves, scene):
	"""Whether it is drawn; without gnuplot it is not, and that is said."""
	script = ["set terminal svg size 900,560 font 'sans,13' background 'white'", f"set output {_quoted(path + '.new')}",
		f"set title {_quoted(scene.encode(errors='replace').decode() + ': time on a cluster')} noenhanced", "set logscale xy", "set xrange [1:1000]", "set xlabel 'nodes'", "set ylabel 'seconds'",
		"set y2label 'efficiency, %'", "set y2range [0:100]", "set y2tics 0,25,100", "set ytics nomirror", "set grid xtics ytics lt 1 lc rgb '#dddddd'",
		"set key outside bottom center horizontal"]
	colours = ("#1f5fa8", "#c0504d", "#4f8f3a", "#7a4fa3")
	data, lines = [], []
	for k, curve in enumerate(curves):
		data.append(f"$c{k} << E\n" + "\n".join(f"{p['nodes']} {p['seconds']} {100 * p['efficiency']}" for p in curve["points"]) + "\nE")
		name, colour = f"{curve['width']} x {curve['height']}", colours[k % len(colours)]
		lines.append(f"$c{k} using 1:2 with linespoints pt 7 ps 0.5 lc rgb '{colour}' title '{name}'")
		lines.append(f"$c{k} using 1:3 axes x1y2 with lines dt 2 lc rgb '{colour}' title 'efficiency'")
	text = "\n".join(data + script + ["plot " + ", ".join(lines)]) + "\n"
	try:
		done = subprocess.run(["gnuplot"], input=text, capture_output=True, **NAMES, check=False)
	except OSError:
		print("note: no plot; it needs gnuplot", file=sys.stderr)
		return False
	if done.returncode != 0 or not os.path.exists(path + ".new"):
		print(f"note: no plot; gnuplot says: {done.stderr.strip()[:300]}", file=sys.stderr)
		if os.path.exists(path + ".new"):
			os.unlink(path + ".new")
		return False
	os.replace(path + ".new", path)
	return True


def _quoted(text):
	return "'" + text.replace("'", "''") + "'"
