# SPDX-License-Identifier: AGPL-3.0-or-later
"""Radiosity and photons once for all parts (--light), in the way that the scene says by Strips_Light (see the help)."""
import os
import re

from common import read_text, refused, run
from povray_options import error_lines, is_switch, one_pixel, quoted
from scene import command

PHOTONS, RADIOSITY = "strips.ph", "strips.rca"


def light_folder(sub):
	return f"{sub['folder']}/light"


def _seen(sub, path):
	"""From the light's folder, where POV-Ray runs: it knows no letters but ASCII's in the names that it opens."""
	return path if path.isascii() else os.path.relpath(path, light_folder(sub))


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
	# A pilot of one block: the pretrace is done for the whole picture, and then hardly a pixel; a camera without lens samples knows no
	# pilot, and is ended then. Photons are saved by another process, of one pixel, because a pilot does not save them.
	pilot = {"TILT_LENS_PILOT": f"1,2,0.001,{folder}/pilot", **({"TILT_LENS_PILOT_WRITES": "1"} if sub["may_write"] else {})}
	words = ["+WT1", "+GA", "+O" + quoted(_seen(sub, f"{folder}/pixel"))]
	if sub["frames"]:
		words += [f"+SF{sub['frames'][0]}", f"+EF{sub['frames'][0]}"]
	_run(sub, _words(sub, 1) + words + one_pixel(sub["width"], sub["height"]), log, {})
	if re.search(r"\bradiosity\b", _text(sub)):
		photons = os.path.exists(f"{folder}/{PHOTONS}")
		_run(sub, _words(sub, 2 if photons else 1) + words + ["+V", "-HR", "+RFO", "+RF" + quoted(_seen(sub, f"{folder}/{RADIOSITY}"))], log, pilot, _pretraced)
	if not any(os.path.exists(f"{folder}/{name}") for name in (PHOTONS, RADIOSITY)):
		raise refused("--light: the scene saved neither photons (photons { save_file \"strips.ph\" } with Strips_Light = 1) nor radiosity; "
			"povray-strips --help shows what to write")
	with open(done, "w", encoding="utf-8"):
		pass


def _text(sub):
	text = ""
	for path in sub["files"]:
		if re.search(r"\.(pov|inc|mac)$", path, re.I):
			text += read_text(path)
	return text


def _words(sub, step):
	return [f"Declare=Strips_Light={step}"]


def light_words(sub):
	"""What a part is told."""
	if not sub["light"]:
		return []
	radiosity = f"{light_folder(sub)}/{RADIOSITY}"
	return _words(sub, 2) + (["+RFI", "+RF" + quoted(_seen(sub, radiosity))] if os.path.exists(radiosity) else [])


def place(sub):
	"""(working folder, the user's words) for POV-Ray: with --light the light's folder, where photons are saved and loaded, and whose names the
	scene gives without a folder; the scene's own files are found from there by their whole names and the library paths."""
	if not sub["light"]:
		return sub["cwd"], sub["words"]

	def there(name):
		return _seen(sub, os.path.join(sub["cwd"], name))
	libraries = ["+L" + quoted(_seen(sub, path)) for path in [sub["cwd"], *sub["libraries"]]]
	words = [word if is_switch(word) else there(word.strip('"')) for word in sub["words"]]
	given = ["+I" + quoted(there(sub["input"]))] if os.path.isfile(os.path.join(sub["cwd"], sub["input"])) else []
	return light_folder(sub), libraries + words + given


def _pretraced(log):
	"""Whether the picture itself is begun: the number of pixels begins anew after the pretrace (with +HR after each of its steps)."""
	numbers = [int(n) for n in re.findall(r"Rendered (\d+) of", log)]
	return any(after < before for before, after in zip(numbers, numbers[1:]))


def _run(sub, more, log, env, enough=None):
	folder, words = place(sub)
	began = os.path.getsize(log) if os.path.exists(log) else 0

	def said():
		return read_text(log, began)
	code = run(command(sub["povray"], words, more), log, env, folder, (lambda: enough(said())) if enough else None)
	if code != 0 and not (enough and enough(said()) and "Frontend halted render" in said()):
		raise refused(f"the light is not rendered:\n{error_lines(said())}")
