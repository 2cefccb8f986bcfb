# SPDX-License-Identifier: AGPL-3.0-or-later
"""What POV-Ray makes of the user's words, found before anything is submitted by having it render one pixel."""
import os
import re
import tempfile

from common import Failure, digest, file_error, read_text, refused, usage
from povray_options import error_lines, frames_of, is_ini, one_pixel, output_of, povray_words, quoted, resolve, without_section

SUFFIX = {"PNG": ".png", "EXR": ".exr"}


def command(povray, words, more):
	"""Own words come last: they win."""
	return [povray, *povray_words(words), "-D", "-P", "-C", *more]


def inspect(povray, scene, words, work, may_write):
	"""A dictionary: width, height, suffix, frames (None for a still), digits of their numbers, output, libraries, input. Refuses what
	POV-Ray does not render."""
	if not is_ini(scene) and not os.path.isfile(scene):
		raise Failure(3, f"{scene}: no such file; it is looked for from {work}")
	for word in words:
		if any("\udc80" <= letter <= "\udcff" for letter in word):
			# POV-Ray itself reads past the end of its tables.
			raise refused(f"POV-Ray does not render {word}: it reads names as UTF-8, and this is none; rename it. Nothing was submitted")
	with tempfile.TemporaryDirectory(prefix="povray-strips-") as folder:
		values = resolve(povray, words, folder)
		film = frames_of(values)
		# A pilot of nothing: it refuses scenes that write files, and traces no pixel that is not asked for.
		env = dict(os.environ, TILT_LENS_PILOT=f"1,16,0.001,{folder}/p", **({"TILT_LENS_PILOT_WRITES": "1"} if may_write else {}))
		pixel = ["+GA", "+Q1", *one_pixel(int(values.get("width", 160)), int(values.get("height", 120))), "+O" + quoted(f"{folder}/p")]
		log = output_of(command(povray, words, pixel + ([f"+SF{film[0]}", f"+EF{film[0]}"] if film else [])), env)
	if re.search(r"A pilot render writes no files", log):
		raise refused(f"{scene} opens a file for writing, and every part would. If that does no harm, let it with --scene-may-write:\n" + error_lines(log))
	size = re.search(r"Image resolution\.*(\d+) by (\d+)", log)
	if "POV-Ray finished" not in log or "Render failed" in log or not size:
		raise refused(f"POV-Ray does not render {scene} from {work}; nothing was submitted:\n{error_lines(log)}")
	kind = re.search(r"(\d+) bpp ?(with alpha)? (\w+)", re.sub(r"\n +", " ", log))
	kind = kind.group(3) if kind else "none"
	if kind not in SUFFIX:
		raise refused(f"pictures of the format {kind} are not joined; write PNG (+FN, +FN16) or OpenEXR (+FE)")
	return {"width": int(size.group(1)), "height": int(size.group(2)), "suffix": SUFFIX[kind],
		"frames": list(range(film[0], film[1] + 1)) if film else None, "digits": film[2] if film else 0,
		"output": output_name(scene, values.get("output_file_name", ""), SUFFIX[kind]), "libraries": values["library_path"],
		"input": values.get("input_file_name", scene)}


def output_name(scene, name, suffix):
	"""Where POV-Ray would write a still; a film's frames get their numbers before the suffix."""
	base = os.path.splitext(os.path.basename(without_section(scene)))[0]
	if name.lower() in ("-", "stdout", "stderr"):
		raise usage(f"the picture goes to {name}: parts are joined into a file; give +O with its name")
	if not name:
		name = base
	elif name.endswith("/") or os.path.isdir(name):
		name = os.path.join(name, base)
	stem, ending = os.path.splitext(name)
	return (stem if ending.lower() in SUFFIX.values() else name) + suffix


def frame_name(output, frame, digits):
	if frame is None:
		return output
	stem, suffix = os.path.splitext(output)
	return f"{stem}{frame:0{digits}d}{suffix}"


def files_of(scene, words, found, targets):
	"""Digests of the scene's files as far as their names stand in it: what is named in quotes and is there, from the working
	folder or from a library path, and so on in those that are named; not what it writes itself, nor the picture. POV-Ray's own include
	files belong to its installation."""
	waiting = [without_section(word) for word in [*words, found["input"]] if word in (scene, found["input"]) or is_ini(word)]
	files, written = {}, {os.path.abspath(target) for target in targets}
	while waiting:
		name = waiting.pop()
		for library in ["", *found["libraries"]]:
			path = os.path.normpath(os.path.join(library, name))
			if not os.path.isfile(path):
				continue
			absolute = os.path.abspath(path)
			if absolute not in files:
				try:
					files[absolute] = digest(absolute)
				except OSError as error:
					raise file_error(path, error) from None
				if re.search(r"\.(pov|inc|ini|mac)$", path, re.I):
					text = read_text(path)
					waiting += re.findall(r'"([^"\n]{1,250})"', text)
					written |= {os.path.abspath(name) for name in written_by(text)}
			break
	return {path: sum_ for path, sum_ in files.items() if path not in written}


def written_by(text):
	"""Files that a scene opens for writing, by a name in quotes or one that was declared so."""
	for name, identifier in re.findall(r'#\s*fopen\s+\w+\s+(?:"([^"\n]+)"|(\w+))\s+(?:write|append)', text):
		yield from [name] if name else re.findall(r'#\s*(?:declare|local)\s+' + identifier + r'\s*=\s*"([^"\n]+)"', text)


def check_files(files, where):
	"""Refuses when a file is not what it was at submission, or is not seen here."""
	for path, sum_ in files.items():
		try:
			now = digest(path)
		except OSError as error:
			raise Failure(3, f"{path}: cannot be read on {where} ({error.strerror}); every node must see the scene's files in the same place") from None
		if now != sum_:
			raise refused(f"{path}: it changed since the submission, or {where} sees another one; parts of two scenes make no picture: submit again")
