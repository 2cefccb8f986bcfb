#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""CPU time of two POV-Rays, in turn, on scenes of the race; and whether their pixels are the same.

	two_builds.py A/bin/povray B/bin/povray [--scenes plain floor ...] [--size 160x120] [--samples 16] [--turns 5] [--denoise] [--stock-camera] [--at-most 1]

One thread. A ratio is the median of what B takes over what A takes in the same turn. Ends with 1 where pixels differ, or where the
mean of the ratios is above --at-most.
"""

import argparse
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"


def pixels(path):
	"""A PPM's bytes after its header, whose comment holds the date."""
	data = path.read_bytes()
	return data[data.index(b"\n255\n") :]


def seconds_of_children():
	used = resource.getrusage(resource.RUSAGE_CHILDREN)
	return used.ru_utime + used.ru_stime


def render(povray, scene, options, folder):
	"""CPU seconds and pixels."""
	picture = pathlib.Path(folder) / "picture.ppm"
	command = [povray, f"+I{SCENES}/{scene}.pov", f"+L{SCENES}", f"+O{picture}", f"+W{options.width}", f"+H{options.height}", "+FP", "+WT1", "-D", "-A", "-GA"]
	command += [f"Declare=Race_Camera={int(not options.stock_camera)}", f"Declare=Race_Max={options.samples}", f"Declare=Race_Denoise={int(options.denoise)}"]
	before = seconds_of_children()
	done = subprocess.run(command, capture_output=True, text=True)
	taken = seconds_of_children() - before
	if done.returncode:
		sys.exit(f"{povray} could not render {scene}.pov:\n{done.stderr}")
	return taken, pixels(picture)


def main():
	parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
	parser.add_argument("a")
	parser.add_argument("b")
	parser.add_argument("--scenes", nargs="+", default=sorted(p.stem for p in SCENES.glob("*.pov")))
	parser.add_argument("--size", default="160x120")
	parser.add_argument("--samples", type=int, default=16)
	parser.add_argument("--turns", type=int, default=5)
	parser.add_argument("--denoise", action="store_true")
	parser.add_argument("--stock-camera", action="store_true", help="stock's focal blur, without tilt_lens")
	parser.add_argument("--at-most", type=float, default=math.inf)
	options = parser.parse_args()
	options.width, options.height = map(int, options.size.split("x"))
	ratios, same = [], True
	with tempfile.TemporaryDirectory() as folder:
		for scene in options.scenes:
			turns = []
			for _ in range(options.turns):
				(a, of_a), (b, of_b) = render(options.a, scene, options, folder), render(options.b, scene, options, folder)
				turns.append(b / a)
				if of_a != of_b:
					same = False
					print(f"{scene}: pixels differ")
			ratios.append(statistics.median(turns))
			print(f"{scene:14} {ratios[-1]:.3f}   ({min(turns):.3f} to {max(turns):.3f})", flush=True)
	mean = math.exp(statistics.mean(map(math.log, ratios)))
	print(f"geometric mean {mean:.3f}; pixels {'the same' if same else 'DIFFER'}")
	return 0 if same and mean <= options.at_most else 1


if __name__ == "__main__":
	sys.exit(main())
