# SPDX-License-Identifier: AGPL-3.0-or-later
"""A command line taken apart, for the programs here."""
import re
import shlex

from common import usage


def parse(program, words, texts, numbers, flags, lists=(), is_other=lambda word: False, from_zero=()):
	"""Values by option; under "own" the plain words, under "other" those that `is_other` knows, under "all" both in their order. `lists` are texts that may be repeated,
	each a list of words in one."""
	values = {"own": [], "other": [], "all": [], **{name: [] for name in lists}}
	words = list(words)
	while words:
		word = words.pop(0)
		if not word.startswith("--"):
			if word.startswith("-") and not is_other(word):
				raise usage(f"no option {word}; {program} --help lists them")
			values["other" if is_other(word) else "own"].append(word)
			values["all"].append(word)
			continue
		name, equals, value = word.partition("=")
		if name in flags and not equals:
			values[name] = True
			continue
		if name not in texts and name not in numbers and name not in lists:
			raise usage(f"no option {word}; {program} --help lists them")
		if not equals:
			if not words:
				raise usage(f"{name} needs a value")
			value = words.pop(0)
		if name in lists:
			values[name] += split(name, value)
		elif name in numbers:
			least = 0 if name in from_zero else 1
			if not re.fullmatch(r"\d{1,7}", value) or int(value) < least:
				raise usage(f"{name}: '{value}' is no number from {least} to 9999999")
			values[name] = int(value)
		else:
			values[name] = value
	return values


def split(where, text):
	try:
		return shlex.split(text)
	except ValueError as error:
		raise usage(f"{where}: {error} in: {text}") from None
