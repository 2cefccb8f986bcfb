# SPDX-License-Identifier: AGPL-3.0-or-later
"""tiltcal-batch's command line and its list. The help is laid out as the other programs' is: cmake/help-to-man.awk makes the man page of it."""
import os
import re

from common import Failure, read_text, usage
from words import parse as parse_words
from words import split

HELP = """tiltcal-batch: calibrates the cameras of a list by tiltcal calibrate: on a Slurm cluster, or on this machine with --local. At the end stands
one table of them all.
Usage: tiltcal-batch [OPTIONS] LIST

Positionals:
  LIST TEXT REQUIRED          the list: a line a camera, NAME and its options of tiltcal calibrate

Options:
  -h,--help                   Print this help message and exit
  --version                   Display program version information and exit
  --options TEXT              options of every line, such as '--board 12x9 --square 25'; repeatable; a line's own come after them
  --out TEXT                  the results' folder [LIST without its ending]
  --local INT                 no Slurm: so many calibrations at once on this machine
  --nodes INT                 at most so many at once on the cluster [as many as Slurm gives]
  --cpus INT                  threads of a calibration [1]
  --dry-run                   say what would be done, and do nothing
  --sbatch TEXT               words for sbatch, such as '--partition=long --time=2:00:00'; repeatable
  --tiltcal TEXT              tiltcal [the tiltcal beside tiltcal-batch]
  --line TEXT                 calibrate one camera of the batch in FOLDER again, here: --line NAME FOLDER
  --task INT                  the same by its number, for the array's tasks: --task NUMBER FOLDER
  --summary TEXT              write this batch's table again, of what is there

LIST is a text. A line that begins with '#' is a comment; quotes are the shell's; patterns of photographs are looked for from the
folder where tiltcal-batch is called. NAME is of letters, digits, '.', '_' and '-'. Options are those of tiltcal calibrate but --out.
A camera's results are in OUT/NAME, what tiltcal said in OUT/log/NAME.txt. The same command again calibrates what is missing, what
failed, and what has other options or photographs now; the rest is left alone.
The table is OUT/summary.txt, .csv, .json and .html; it names what failed, with the command that runs that line alone.

Examples:
  tiltcal-batch lenses.txt --local 4
  tiltcal-batch lenses.txt --options '--board 12x9 --square 25' --sbatch '--time=1:00:00'
  tiltcal-batch --line nikkor-35 lenses

Exit codes: 0 done or submitted, 1 a camera failed, 2 wrong usage, 3 unreadable or unwritable file, 128 + signal interrupted.
"""


def parse(words):
	values = parse_words("tiltcal-batch", words, {"--out", "--tiltcal", "--line", "--summary"}, {"--local", "--nodes", "--cpus", "--task"}, {"--dry-run"},
		lists=("--sbatch", "--options"), from_zero=("--task",))
	actions = [name for name in ("--line", "--task", "--summary") if name in values]
	if len(actions) > 1:
		raise usage(f"{actions[0]} and {actions[1]} are two things: do one after the other")
	if "--summary" in values:
		if values["own"]:
			raise usage("--summary FOLDER, and nothing else")
	elif actions and len(values["own"]) != 1:
		raise usage(f"{actions[0]} {'NAME' if actions[0] == '--line' else 'NUMBER'} FOLDER, and nothing else")
	elif not actions and len(values["own"]) != 1:
		raise usage("LIST is required, one of them; tiltcal-batch --help shows examples")
	if "--nodes" in values and "--local" in values:
		raise usage("--nodes and --local exclude each other")
	return values


def read_list(path, common):
	"""A dictionary a line: name, words, place (FILE:LINE)."""
	try:
		text = read_text(path)
	except OSError as error:
		raise Failure(3, f"{path}: cannot be read ({error.strerror})") from None
	lines, names = [], {}
	for number, line in enumerate(text.split("\n"), 1):
		place = f"{path}:{number}"
		if not line.strip() or line.lstrip().startswith("#"):
			continue
		words = split(place, line)
		name = words.pop(0)
		if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name) or name.lower() == "log":
			raise usage(f"{place}: '{name}' cannot be a camera's name: it begins the line and is of letters, digits, '.', '_' and '-' (and not log)")
		if name in names:
			raise usage(f"{place}: {name} is the name of line {names[name]} too")
		for word in common + words:
			if word == "--out" or word.startswith("--out="):
				raise usage(f"{place}: leave out --out; each camera gets the folder of its name")
		names[name] = number
		lines.append({"name": name, "words": common + words, "place": place})
	if not lines:
		raise usage(f"{path}: no line names a camera")
	return lines


def folder_for(path, out):
	folder = out or os.path.splitext(path)[0]
	if os.path.abspath(folder) == os.path.abspath(path):
		raise usage(f"--out: the results need a folder, and {path} is the list")
	return os.path.abspath(folder)
