# SPDX-License-Identifier: AGPL-3.0-or-later
"""Radiosity and photons once for all parts (--light), in the way that the scene says by Strips_Light (see the help)."""
import os
import re

from common import refused, run
from scene import command, error_lines

PHOTONS, RADIOSITY = "strips.ph", "strips.rca"


def light_folder(sub):
	return f"{sub['folder']}/light"


def make_light(sub):
	"""Saves them, unless it is done. One thread, so that the photons are the same every time."""
	folder = light_folder(sub)
	done = f"{folder}/done"
	if not sub["light"] or os.path.exists(done):
		return
	os.makedirs(folder, exist_ok=True)
	for old in os.listdir(folder):
		os.unlink(os.path.join(folder, old))
	log = f"{sub['folder']}/log/light.txt"
	# A pilot of one block: the pretrace is done for the whole picture, and then hardly a pixel. Photons are saved by another
	# process, of one pixel, because a pilot does not save them.
	pilot = {"TILT_LENS_PILOT": f"1,2,0.001,{folder}/pilot", **({"TILT_LENS_PILOT_WRITES": "1"} if sub["may_write"] else {})}
	words = ["+WT1", "+GA", f"+O{folder}/pixel"]
	if sub["frames"]:
		words += [f"+SF{sub['frames'][0]}", f"+EF{sub['frames'][0]}"]
	_run(sub, _words(sub, 1) + words + ["+SC2", "+EC2", "+SR2", "+ER2"], log, {})
	if re.search(r"\bradiosity\b", _text(sub)):
		photons = os.path.exists(f"{folder}/{PHOTONS}")
		_run(sub, _words(sub, 2 if photons else 1) + words + ["+RFO", f"+RF{folder}/{RADIOSITY}"], log, pilot)
	if not any(os.path.exists(f"{folder}/{name}") for name in (PHOTONS, RADIOSITY)):
		raise refused("--light: the scene saved neither photons (photons { save_file \"strips.ph\" } with Strips_Light = 1) nor radiosity; "
			"povray-strips --help shows what to write")
	with open(done, "w", encoding="utf-8"):
		pass


def _text(sub):
	text = ""
	for path in sub["files"]:
		if re.search(r"\.(pov|inc|mac)$", path, re.I):
			with open(path, encoding="utf-8", errors="replace") as file:
				text += file.read()
	return text


def _words(sub, step):
	return [f"Declare=Strips_Light={step}", f"+L{light_folder(sub)}", f"+L{sub['cwd']}"]


def light_words(sub):
	"""What a part is told."""
	if not sub["light"]:
		return []
	radiosity = f"{light_folder(sub)}/{RADIOSITY}"
	return _words(sub, 2) + (["+RFI", f"+RF{radiosity}"] if os.path.exists(radiosity) else [])


def place(sub):
	"""(working folder, scene, options) for POV-Ray: with --light the light's folder, where photons are saved and loaded, and whose names the
	scene gives without a folder; the scene's own files are found from there by their whole names and the library paths."""
	if not sub["light"]:
		return sub["cwd"], sub["scene"], sub["options"]
	options = [f"{word[:2]}{os.path.join(sub['cwd'], word[2:])}" if word.startswith("+L") else word for word in sub["options"]]
	return light_folder(sub), os.path.join(sub["cwd"], sub["scene"]), options


def _run(sub, more, log, env):
	folder, scene, options = place(sub)
	code = run(command(sub["povray"], scene, options, more), log, env, folder)
	if code != 0:
		with open(log, encoding="utf-8", errors="replace") as file:
			raise refused(f"the light is not rendered:\n{error_lines(file.read())}")
