# SPDX-License-Identifier: AGPL-3.0-or-later
"""POV-Ray's options as POV-Ray itself takes them apart: ini files with their sections, switches, quotes."""
import os
import re
import subprocess

from common import NAMES, Failure, read_text, refused, usage

# Which part is rendered, which povray-strips says itself: words, and the keywords that they and ini files come down to.
FORBIDDEN = re.compile(r"[+-](S[RCF]|E[RCF]|C$|GI)|(Start|End)_(Row|Column)=|Subset_(Start|End)_Frame=|Continue_Trace=|Create_Ini=", re.I)
DECIDED = ("start_row", "end_row", "start_column", "end_column", "subset_start_frame", "subset_end_frame")


def is_switch(word):
	return bool(re.match(r"\+.|-[^-]|[A-Za-z_]+=", word)) and word != "-h"


def is_ini(word):
	return not is_switch(word) and without_section(word).lower().endswith(".ini")


def without_section(word):
	return re.sub(r"\[[^]]*\]$", "", word.strip('"'))


def quoted(path):
	"""POV-Ray takes its options apart at spaces, unless they are quoted."""
	return f'"{path}"' if re.search(r"\s", path) else path


def povray_words(words):
	"""The user's words as POV-Ray takes them, in their order: which options an ini file overrides depends on where it stands. The first
	file is the scene."""
	files = [k for k, word in enumerate(words) if not is_switch(word)]
	scene = files[0] if files and not is_ini(words[files[0]]) else None
	return [word if is_switch(word) else ("+I" if k == scene else "") + quoted(word) for k, word in enumerate(words)]


def error_lines(log):
	lines = [line for line in re.split(r"[\r\n]+", log) if line.strip()]
	for i, line in enumerate(lines):
		if re.search(r"\berror\b|cannot", line, re.I) and not re.search(r"configuration file|an INI file, adding", line):
			return "\n".join(lines[i:i + 6])
	return "\n".join(lines[-6:])


def output_of(words, env=None):
	try:
		done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=env, check=False)
	except OSError as error:
		raise Failure(3, f"{words[0]}: cannot be run ({error.strerror}); give the POV-Ray with --povray") from None
	return done.stdout.decode(**NAMES).replace("\r", "\n")


def resolve(povray, words, folder):
	"""Values by keyword in small letters, as POV-Ray's ini files have them; of library_path, all that the user names, in order."""
	for word in words:
		if FORBIDDEN.match(word):
			raise usage(f"'{word}' is decided here: leave it out")
	values = _written(povray, words, folder)
	own = _written(povray, ["+Inone"], folder)["library_path"]
	values["library_path"] = [path for path in values["library_path"] if path not in own]
	for key in DECIDED:
		if key in values:
			raise usage(f"'{key.title()}={values[key]}' in an ini file is decided here: leave it out")
	if values.get("continue_trace", "off").lower() == "on":
		raise usage("'Continue_Trace=On' in an ini file is decided here: leave it out")
	return values


def _written(povray, words, folder):
	"""What POV-Ray writes by Create_Ini. Then it ends, before it opens the scene: an include header is missing."""
	path = f"{folder}/options.ini"
	log = output_of([povray, *povray_words(words), "-D", "-P", f"+GI{quoted(path)}", f"+HI{quoted(folder + '/none')}"])
	values = {"library_path": []}
	try:
		for line in read_text(path).split("\n"):
			key, _, value = line.partition("=")
			value = value[1:-1] if value.startswith('"') else value
			if key == "Library_Path":
				values["library_path"].append(value)
			else:
				values[key.lower()] = value
		os.unlink(path)
	except FileNotFoundError:
		raise refused(f"POV-Ray does not take these options; nothing was submitted:\n{error_lines(log)}") from None
	return values


def one_pixel(width, height):
	"""Words for a single pixel. POV-Ray takes 1 for all of a row or column: the second, where there is one."""
	return (["+SC2", "+EC2"] if width > 1 else []) + (["+SR2", "+ER2"] if height > 1 else [])


def frames_of(values):
	"""(first, last, digits of a frame's number); None for a still. As POV-Ray's animationprocessing.cpp has it."""
	first, last = int(values.get("initial_frame", 0)), int(values.get("final_frame", 0))
	if (first, last) in ((0, 0), (1, 1)):
		return None
	if int(values.get("frame_step", 1)) > 1:
		raise refused("a Frame_Step of more than 1 is not split into parts")
	first = max(int(values.get("initial_frame", 1)), 0)
	last = max(int(values.get("final_frame", 1)), first)
	return first, last, len(str(last + (values.get("cyclic_animation", "off").lower() == "on")))
