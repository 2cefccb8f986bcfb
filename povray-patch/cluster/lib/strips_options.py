# SPDX-License-Identifier: AGPL-3.0-or-later
"""povray-strips' command line. The help is laid out as the other programs' is: cmake/help-to-man.awk makes the man page of it."""
import re

from common import usage
from povray_options import is_switch
from words import parse as parse_words

HELP = """povray-strips: renders one picture, or a film, in parts: on a Slurm cluster, or on this machine with --local. The parts are strips of
rows of equal predicted cost; the joined picture has the pixels of one process (but where radiosity goes on sampling, or a camera
without an opening draws random numbers).
Usage: povray-strips [OPTIONS] SCENE...

Positionals:
  SCENE TEXT ... REQUIRED     the scene, and ini files

Options:
  -h,--help                   Print this help message and exit
  --version                   Display program version information and exit
  --parts INT                 so many parts [40; a film: one a frame]
  --local INT                 no Slurm: so many parts at once on this machine
  --nodes INT                 at most so many parts at once on the cluster [as many as Slurm gives]
  --cpus INT                  threads of a part, in place of +WT [1]
  --dry-run                   say what would be submitted, and submit nothing
  --plan                      measure, and say how long the picture takes on 1 to 1000 nodes, up to 16k: PICTURE.plan.json, .svg
  --sbatch TEXT               words for sbatch, such as '--partition=long --time=2:00:00 --mem=8G'; repeatable
  --light                     radiosity and photons once, for all parts, of a film those of its first frame; the scene must ask for it (see below)
  --pilot-time TEXT           how long tiltcost's pilot may trace [10s]
  --pilot-blocks INT          at most so many blocks of 16 x 16 pixels in the pilot [400]
  --setting TEXT              cost for blur_samples MIN,MAX,VARIANCE[,CONFIDENCE] [what the scene says]
  --equal-rows                strips of equally many rows, without a pilot
  --scene-may-write           let a scene that opens files for writing (#fopen) do so, in every part
  --povray TEXT               POV-Ray [the povray beside povray-strips]
  --status TEXT               which parts of this submission are missing, and the command that renders each alone
  --resume TEXT               submit again what is missing of this submission, or render it with --local; --sbatch and --nodes may say
                              what is to be another than then, such as the memory
  --part INT                  render one part of the submission in FOLDER, here: --part NUMBER FOLDER
  --join TEXT                 join this submission's parts, here
  --cut TEXT                  cut this submission's picture, here; the first job does so

SCENE is a .pov or .ini file; what begins with one + or -, and NAME=value, goes to POV-Ray (+W +H +L +O +KFF Declare=..),
in the order that they have here: an option after an ini file wins over it, and one before it does not.
Three jobs are submitted: the pilot, which cuts the picture; an array of the parts; and the join, which waits for all. Ids, how to watch and
how to cancel are printed. A submission has a folder of its own beside the picture, PICTURE.strips/TIME-NUMBER; the scene's
files, POV-Ray and that folder must be in the same place on all nodes.
A film (+KFI, +KFF) is an array of its frames; with more parts than frames each frame is cut too, by the pilot of the middle one.
A scene that tiltcost cannot judge (another camera, no aperture) is cut into equal rows; take several parts for each node then.

With --light the first job renders next to nothing with Declare=Strips_Light=1 and saves radiosity and photons; all parts load them, which
have Declare=Strips_Light=2 (and 0 where it is only looked at). The scene says what that means:
  global_settings {
    radiosity { #if (Strips_Light = 2) pretrace_start 1 pretrace_end 1 always_sample off #end }
    photons { count 20000 #if (Strips_Light = 1) save_file "strips.ph" #end #if (Strips_Light = 2) load_file "strips.ph" #end }
  }

Examples:
  povray-strips scene.pov +W7680 +H4320 +FN16 --parts 40 --sbatch '--time=2:00:00'
  povray-strips scene.pov +W640 +H360 --parts 4 --local 2
  povray-strips film.pov +KFI1 +KFF240 +W1920 +H1080 --parts 60
  povray-strips --resume scene.strips/20260101-120000-1a2b

Exit codes: 0 done or submitted, 1 refused or a part failed, 2 wrong usage, 3 unreadable or unwritable file, 128 + signal interrupted.
"""

TEXT = {"--sbatch", "--pilot-time", "--setting", "--povray", "--status", "--resume", "--join", "--cut"}
NUMBER = {"--parts", "--local", "--nodes", "--cpus", "--pilot-blocks", "--part"}
FLAG = {"--dry-run", "--plan", "--light", "--equal-rows", "--scene-may-write"}
ACTIONS = ("--status", "--resume", "--join", "--cut")


def parse(words):
	"""Values by option, and under "own" the plain words, under "other" POV-Ray's, under "all" both, in their order."""
	values = parse_words("povray-strips", words, TEXT, NUMBER, FLAG, lists=("--sbatch",), is_other=is_switch, from_zero=("--part",))
	return _checked(values)


def _checked(values):
	actions = [name for name in ACTIONS if name in values]
	if len(actions) > 1:
		raise usage(f"{actions[0]} and {actions[1]} are two things: do one after the other")
	if "--part" in values:
		if actions or len(values["own"]) != 1:
			raise usage("--part NUMBER FOLDER, and nothing else")
		_alone(values, "--part")
	elif actions:
		if values["all"]:
			raise usage(f"{actions[0]} FOLDER: the scene and its options are those of the submission")
		_alone(values, actions[0], ("--local", "--nodes", "--sbatch") if actions[0] == "--resume" else ())
	elif not values["own"]:
		raise usage("SCENE is required; povray-strips --help shows examples")
	if "--plan" in values and ("--local" in values or "--dry-run" in values):
		raise usage("--plan renders no picture: leave out --local and --dry-run")
	if "--plan" in values:
		_alone(values, "--plan", ("--light", "--pilot-time", "--pilot-blocks", "--setting", "--equal-rows", "--scene-may-write", "--povray"))
	if "--nodes" in values and "--local" in values:
		raise usage("--nodes and --local exclude each other")
	if values["--sbatch"] and "--local" in values:
		raise usage("--sbatch is for Slurm, and --local renders without it: leave one out")
	_check_pilot(values)
	return values


def _alone(values, action, but=()):
	for name, value in values.items():
		if name.startswith("--") and name not in (action, *but) and value not in ([], False):
			raise usage(f"{action} takes no {name}" + (f", only {', '.join(but)}" if but else ""))


def _check_pilot(values):
	"""What tiltcost would refuse in the first job, long after the submission."""
	if not re.fullmatch(r"(?=.*[1-9])(\d+\.?\d*|\.\d+)(s|m|min|h)?", values.get("--pilot-time", "10s")):
		raise usage(f"--pilot-time: '{values['--pilot-time']}' is not a time such as 10s, 2m or 1h")
	if values.get("--pilot-blocks", 1) > 1000000:
		raise usage(f"--pilot-blocks: '{values['--pilot-blocks']}' is no number from 1 to 1000000")
	if "--setting" not in values:
		return
	found = re.fullmatch(r"(\d+),(\d+),([\d.]+(?:[eE][+-]?\d+)?)(?:,(0?\.\d+))?", values["--setting"])
	if not found or not int(found[1]) <= int(found[2]) or int(found[2]) < 1 or found[3].count(".") > 1 or float(found[3]) > 1:
		raise usage(f"--setting: '{values['--setting']}' is not MIN,MAX,VARIANCE[,CONFIDENCE], such as 16,256,0.0001")
