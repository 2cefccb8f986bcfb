# SPDX-License-Identifier: AGPL-3.0-or-later
"""What both programs need: refusals, files that appear whole, child processes that end with this one."""
import codecs
import contextlib
import hashlib
import json
import os
import signal
import socket
import subprocess
import sys
import time

from version import VERSION

DONE, REFUSED, USAGE, FILE = 0, 1, 2, 3


# Names of files are bytes. In text they are as Python has them from the command line, what is no character as surrogates, so that they come
# out as they were: in messages, logs, records and scripts. For open() and subprocess:
NAMES = {"encoding": sys.getfilesystemencoding(), "errors": "surrogateescape"}


def _name_or_escape(error):
	"""For what is printed, which must not die of a character that the terminal does not know either."""
	try:
		return codecs.lookup_error("surrogateescape")(error)
	except UnicodeError:
		return codecs.lookup_error("backslashreplace")(error)


def read_text(path, begin=0):
	"""From this byte on."""
	with open(path, "rb") as file:
		file.seek(begin)
		return os.fsdecode(file.read()).replace("\r\n", "\n").replace("\r", "\n")


class Failure(Exception):
	def __init__(self, code, text):
		super().__init__(text)
		self.code = code


def refused(text):
	return Failure(REFUSED, text)


def usage(text):
	return Failure(USAGE, text)


def file_error(path, error):
	"""A message for an OSError, with what to do where that is known."""
	hint = {"ENOSPC": "; the disk is full: make room, then start again", "EROFS": "; it is mounted read-only",
		"EDQUOT": "; your quota is used up: make room, then start again"}
	name = __import__("errno").errorcode.get(error.errno, "")
	return Failure(FILE, f"{path}: {error.strerror or error}{hint.get(name, '')}")


def write_whole(path, data):
	"""Bytes or text under a temporary name, to the disk, then renamed."""
	temporary = f"{path}.{socket.gethostname()}.{os.getpid()}.new"
	try:
		with open(temporary, "wb") as out:
			out.write(data if isinstance(data, bytes) else data.encode("utf-8", "surrogateescape"))
			out.flush()
			os.fsync(out.fileno())
		os.rename(temporary, path)
	except OSError as error:
		with contextlib.suppress(OSError):
			os.unlink(temporary)
		raise file_error(path, error) from None


def write_json(path, value):
	write_whole(path, json.dumps(value, indent=1) + "\n")


def read_json(path):
	"""None where there is no such file."""
	try:
		with open(path, encoding="utf-8", errors="surrogateescape") as file:
			return json.load(file)
	except FileNotFoundError:
		return None
	except (OSError, ValueError) as error:
		raise Failure(FILE, f"{path}: cannot be read ({error})") from None


def digest(path):
	sum_ = hashlib.sha256()
	with open(path, "rb") as file:
		for piece in iter(lambda: file.read(1 << 20), b""):
			sum_.update(piece)
	return sum_.hexdigest()


def duration(seconds):
	if seconds < 100:
		return f"{seconds:.1f} s"
	if seconds < 6000:
		return f"{int(seconds) // 60} min {int(seconds) % 60:02d} s"
	return f"{int(seconds) // 3600} h {int(seconds) % 3600 // 60:02d} min"


class Interrupted(Exception):
	def __init__(self, number):
		super().__init__(f"ended by {signal.Signals(number).name}")
		self.code = 128 + number


SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)


def _raise_it(number, _frame=None):
	for other in SIGNALS:
		signal.signal(other, signal.SIG_IGN)
	raise Interrupted(number)


def catch_signals():
	"""scancel, a time limit, Ctrl-C: as an exception, so that temporary files and children go."""
	for number in SIGNALS:
		signal.signal(number, _raise_it)


@contextlib.contextmanager
def signals_wait(text):
	"""Until the end of the block, where the first is raised; `text` says what is waited for."""
	came = []

	def note(number, _frame):
		if not came:
			print(text, file=sys.stderr, flush=True)
		came.append(number)
	before = {number: signal.signal(number, note) for number in SIGNALS}
	try:
		yield
	finally:
		for number, handler in before.items():
			signal.signal(number, handler)
	if came:
		_raise_it(came[0])


def run(command, log=None, env=None, cwd=None, enough=None):
	"""A child to its end; its exit code. It is ended when this program is, and when `enough()` is true."""
	out = open(log, "ab") if log else subprocess.DEVNULL
	try:
		child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, cwd=cwd,
			env={**os.environ, **(env or {})})
	except OSError as error:
		raise file_error(command[0], error) from None
	finally:
		if log:
			out.close()
	try:
		while enough and child.poll() is None:
			if enough():
				child.terminate()
				break
			time.sleep(0.1)
		return child.wait()
	except BaseException:
		child.terminate()
		try:
			child.wait(2)
		except subprocess.TimeoutExpired:
			child.kill()
			child.wait()
		raise


def program(name, help_text, words, main):
	"""Exit code of `main()`, or of --help and --version; its refusals as one message."""
	codecs.register_error("name-or-escape", _name_or_escape)
	for stream in (sys.stdout, sys.stderr):
		stream.reconfigure(errors="name-or-escape")
	if "-h" in words or "--help" in words:
		print(help_text, end="")
		return DONE
	if "--version" in words:
		print(f"{name} {VERSION}")
		return DONE
	catch_signals()
	try:
		return main()
	except (Failure, Interrupted) as error:
		print(f"{name}: {error}", file=sys.stderr)
		return error.code
	except OSError as error:
		print(f"{name}: {file_error(error.filename or '', error)}", file=sys.stderr)
		return FILE
