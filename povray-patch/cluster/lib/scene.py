# SPDX-License-Identifier: AGPL-3.0-or-later
"""What POV-Ray makes of the user's words, found before anything is submitted by having it render one pixel."""
import os
import re
import subprocess
import tempfile

from common import Failure, digest, file_error, refused, usage

# Words that say which part is rendered or where it goes: povray-strips says that itself.
FORBIDDEN = re.compile(r"[+-](S[RCF]|E[RCF]|C$|GI)|(Start|End)_(Row|Column)=|Subset_(Start|End)_Frame=|Continue_Trace=", re.I)
OUTPUT = re.compile(r"(?:\+O|Output_File_Name=)(.*)", re.I)
SUFFIX = {"PNG": ".png", "EXR": ".exr"}


def is_ini(scene):
	return re.sub(r"\[[^]]*\]$", "", scene).lower().endswith(".ini")


def quoted(path):
	"""POV-Ray takes its options apart at spaces, unless they are quoted."""
	return f'"{path}"' if re.search(r"\s", path) else path


def command(povray, scene, options, more):
	"""Own words come last: they win."""
	return [povray, quoted(scene) if is_ini(scene) else "+I" + quoted(scene), *options, "-D", "-P", "-C", *more]


def error_lines(log):
	lines = [line for line in re.split(r"[\r\n]+", log) if line.strip()]
	for i, line in enumerate(lines):
		if re.search(r"\berror\b|cannot", line, re.I) and "configuration file" not in line:
			return "\n".join(lines[i:i + 6])
	return "\n".join(lines[-6:])


def inspect(povray, scene, options, work, may_write):
	"""A dictionary: width, height, format, alpha, frames (None for a still). Refuses what POV-Ray does not render."""
	for word in options:
		if FORBIDDEN.match(word):
			raise usage(f"'{word}' is decided here: leave it out")
	if not is_ini(scene) and not os.path.isfile(scene):
		raise Failure(3, f"{scene}: no such file; it is looked for from {work}")
	with tempfile.TemporaryDirectory(prefix="povray-strips-") as folder:
		# A pilot of nothing: it refuses scenes that write files, and traces no pixel that is not asked for.
		env = dict(os.environ, TILT_LENS_PILOT=f"1,16,0.001,{folder}/p", **({"TILT_LENS_PILOT_WRITES": "1"} if may_write else {}))
		pixel = ["+GA", "+Q1", "+SC2", "+EC2", "+SR2", "+ER2", f"+O{folder}/p"]
		log = _log(command(povray, scene, options, pixel), env)
		animated = re.search(r"Initial Frame: *(\d+) *Final Frame: *(\d+)[\s\S]*?Frame Step: *(\d+)", log) \
			if re.search(r"Animation Options", log) else None
		first = last = None
		if animated and "Animation  off" not in log:
			first, last, step = (int(n) for n in animated.groups())
			if step > 1:
				raise refused("a Frame_Step of more than 1 is not split into parts")
			log = _log(command(povray, scene, options, pixel + [f"+SF{first}", f"+EF{first}"]), env)
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
		"frames": list(range(first, last + 1)) if first is not None and last > first else None, "last_frame": last}


def _log(words, env):
	try:
		done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=env, check=False)
	except OSError as error:
		raise Failure(3, f"{words[0]}: cannot be run ({error.strerror}); give the POV-Ray with --povray") from None
	return done.stdout.decode(errors="replace").replace("\r", "\n")


def output_name(scene, options, suffix):
	"""Where POV-Ray would write a still; a film's frames get their numbers before the suffix."""
	name = None
	for word in ini_words(scene, options):
		found = OUTPUT.match(word)
		if found:
			name = found.group(1).strip().strip('"')
	base = os.path.splitext(os.path.basename(re.sub(r"\[[^]]*\]$", "", scene)))[0]
	if not name:
		name = base
	elif name.endswith("/") or os.path.isdir(name):
		name = os.path.join(name, base)
	stem, ending = os.path.splitext(name)
	return (stem if ending.lower() in SUFFIX.values() else name) + suffix


def ini_words(scene, options):
	"""The words of ini files, then those of the command line."""
	words = []
	for word in [scene] + options:
		if is_ini(word):
			path = re.sub(r"\[[^]]*\]$", "", word)
			if os.path.isfile(path):
				with open(path, encoding="utf-8", errors="replace") as file:
					words += [re.sub(r"\s*=\s*", "=", line.split(";")[0].strip(), count=1) for line in file]
		else:
			words.append(word)
	return words


def frame_name(output, frame, last):
	"""As POV-Ray numbers them: as many digits as the last frame has."""
	if frame is None:
		return output
	stem, suffix = os.path.splitext(output)
	return f"{stem}{frame:0{len(str(last))}d}{suffix}"


def files_of(scene, options):
	"""Digests of the scene's files as far as their names stand in it: what is named in quotes and is there, from the working
	folder or from a library path, and so on in those that are named. POV-Ray's own include files belong to its installation."""
	words = ini_words(scene, options)
	libraries = [""] + [m.group(1).strip().strip('"') for w in words for m in [re.match(r"(?:\+L|Library_Path=)(.*)", w, re.I)] if m]
	main = [scene] + [w for w in options if is_ini(w)]
	main += [m.group(1).strip().strip('"') for w in words for m in [re.match(r"(?:\+I|Input_File_Name=)(.*)", w, re.I)] if m]
	found, waiting = {}, [re.sub(r"\[[^]]*\]$", "", name) for name in main]
	while waiting:
		name = waiting.pop()
		for library in libraries:
			path = os.path.normpath(os.path.join(library, name))
			if not os.path.isfile(path):
				continue
			absolute = os.path.abspath(path)
			if absolute not in found:
				try:
					found[absolute] = digest(absolute)
				except OSError as error:
					raise file_error(path, error) from None
				if re.search(r"\.(pov|inc|ini|mac)$", path, re.I):
					with open(path, encoding="utf-8", errors="replace") as file:
						waiting += re.findall(r'"([^"\n]{1,250})"', file.read())
			break
	return found


def check_files(files, where):
	"""Refuses when a file is not what it was at submission, or is not seen here."""
	for path, sum_ in files.items():
		try:
			now = digest(path)
		except OSError as error:
			raise Failure(3, f"{path}: cannot be read on {where} ({error.strerror}); every node must see the scene's files in the same place") from None
		if now != sum_:
			raise refused(f"{path}: it changed since the submission, or {where} sees another one; parts of two scenes make no picture: submit again")
