# SPDX-License-Identifier: AGPL-3.0-or-later
"""preview.py CASE POVRAY WORK: what +D shows, in a window on an X server without a screen (Xvfb, which is read, typed and clicked at) and
in a file (Display_File). Every wait has an end."""
import contextlib
import glob
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import time
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import png_pixels

CASE, POVRAY, WORK = sys.argv[1:]
# The window and Display_File round colours after adding a dither of less than half a step, the output file without it.
ROUNDING = 1
NO_SCREEN = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}


def wait(what, test, seconds=60):
	"""What `test` gives once it gives something."""
	end = time.monotonic() + seconds
	while time.monotonic() < end:
		got = test()
		if got:
			return got
		time.sleep(0.02)
	raise AssertionError(f"{seconds} seconds went by without: {what}")


@contextlib.contextmanager
def running(words, **options):
	process = subprocess.Popen(words, **{"stdin": subprocess.DEVNULL, **options})
	try:
		yield process
	finally:
		process.kill()
		process.wait()


@contextlib.contextmanager
def screen():
	"""The environment of a program that shall show something on a screen of 640 x 480."""
	for tool in ("Xvfb", "xdotool"):
		if not shutil.which(tool):
			sys.exit(f"no {tool}; sh cmake/setup.sh installs it")
	ours, its = os.pipe()
	# -noreset: it would close and open again when its last client goes, and SDL connects twice, one after the other.
	with open("xvfb.log", "wb") as log, running(["Xvfb", "-displayfd", str(its), "-noreset", "-screen", "0", "640x480x24", "-fbdir", ".", "-nolisten", "tcp"],
			pass_fds=[its], stdout=log, stderr=log):
		assert select.select([ours], [], [], 60)[0], "Xvfb does not start"
		# The window's place, which SDL 1.2 over SDL 2 (Debian 13) would choose itself.
		yield dict(NO_SCREEN, DISPLAY=":" + os.read(ours, 20).decode().strip(), SDL_VIDEO_WINDOW_POS="0,0")


def shown(width, height):
	"""The upper left of the screen, where a window lies that nobody manages: Xvfb keeps it in a file of X's format XWD."""
	data = Path("Xvfb_screen0").read_bytes()
	header = struct.unpack(">25I", data[:100])
	size, big_endian, bits, line, colours = header[0], header[7], header[11], header[12], header[19]
	assert bits == 32, bits
	pixels = numpy.frombuffer(data, dtype=">u4" if big_endian else "<u4", offset=size + 12 * colours, count=480 * line // 4).reshape(480, line // 4)[:height, :width]
	return numpy.stack([pixels >> 16 & 255, pixels >> 8 & 255, pixels & 255], axis=-1).astype(int)


def png(name):
	"""Pixels of an 8-bit PNG, with or without alpha; a damaged one fails."""
	(width, height, depth, colour, _), rows = png_pixels.read(name)
	assert depth == 8 and colour in (2, 6), (depth, colour)
	return numpy.frombuffer(b"".join(rows), dtype=numpy.uint8).reshape(height, width, -1).astype(int)


def ppm(name):
	data = Path(name).read_bytes()
	width, height, most = (int(n) for n in re.match(rb"P6\s(?:#.*\s)*(\d+)\s(\d+)\s(?:#.*\s)*(\d+)\s", data).groups())
	assert most == 255, most
	return numpy.frombuffer(data[-3 * width * height:], dtype=numpy.uint8).reshape(height, width, 3).astype(int)


def scene(samples, lens="", name="s.pov"):
	Path(name).write_text(f"""#version 3.7; global_settings {{ assumed_gamma 1 }}
		camera {{ tilt_lens {{ aperture_diameter 0.4 focal_distance 5 focal_plane_tilt 40 {lens} }} blur_samples {samples}
			location -5 * z look_at <0.2 * clock, 0.2, 0> }}
		light_source {{ <3, 5, -5> rgb 1 }}
		plane {{ z, 3 pigment {{ checker rgb <0.2, 0.1, 0> rgb 0.8 scale 0.3 }} }}
		sphere {{ 0, 1 pigment {{ rgb <1, 0.5, 0.2> }} }}\n""")


def povray(environment, *words, size=(160, 120)):
	"""A render that runs; its messages go to the file log."""
	log = open("log", "wb")
	return running([POVRAY, "+Is.pov", f"+W{size[0]}", f"+H{size[1]}", *words], stdout=log, stderr=log, env=environment)


def log():
	return Path("log").read_text(errors="replace").replace("\r", "\n")


def finish(process, seconds=60):
	return process.wait(seconds)


def render(*words, **options):
	with povray(NO_SCREEN, *words, **options) as process:
		assert finish(process) == 0, log()


def waits(times=1):
	"""Whether it has said for the n-th time that it waits; the whole picture is shown before."""
	return lambda: log().count("Press a key or click") == times


def same(name):
	want = png(name)[..., :3]

	def worst_now():
		return numpy.abs(shown(want.shape[1], want.shape[0]) - want).max()
	with contextlib.suppress(AssertionError): # the X server draws a little later than it is asked
		wait(name, lambda: worst_now() <= ROUNDING, 5)
	worst = worst_now()
	assert worst <= ROUNDING, f"the window differs from {name} by {worst} of 255"
	print(f"{name}: {want.shape[1]} x {want.shape[0]} pixels, within {worst} of 255")


def pointer(environment, *does):
	"""Something done in the window; the arrow, which lies over the picture, leaves it."""
	subprocess.run(["xdotool", "mousemove", "80", "60", *does, "mousemove", "600", "400"], env=environment, check=True, timeout=30)


def window(lens, ended_by):
	scene(16, lens)
	with screen() as environment:
		with povray(environment, "+D", "+P", "+FN", "+Os.png") as process:
			wait("a picture that waits", waits())
			same("s.png")
			if lens == "denoise":
				scene(16)
				render_noisy()
				assert numpy.abs(png("noisy.png") - png("s.png")).max() > 5 * ROUNDING, "denoise does nothing here"
			time.sleep(0.3)
			assert process.poll() is None, "it does not wait"
			pointer(environment, *ended_by)
			assert finish(process) == 0, log()


def render_noisy():
	subprocess.run([POVRAY, "+Is.pov", "+W160", "+H120", "-D", "+FN", "+Onoisy.png"], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True, timeout=60)


def animation():
	scene(16)
	with screen() as environment:
		with povray(environment, "+D", "+P", "+FN", "+Of.png", "+KFF2") as process:
			for frame in (1, 2):
				wait(f"frame {frame} that waits", waits(frame))
				same(f"f{frame}.png")
				pointer(environment, "click", "1")
			assert finish(process) == 0, log()


def scaled():
	"""A picture larger than the screen: each pixel of the window is the mean of those it stands for, of the denoised ones alone."""
	width, height = 800, 600
	scene(4, "denoise")
	with screen() as environment:
		with povray(environment, "+D", "+P", "+FP", "File_Gamma=srgb", "+Os.ppm", size=(width, height)) as process:
			wait("a picture that waits", waits())
			small = (533, 400) # POV-Ray leaves 10 columns and 80 rows of the screen
			time.sleep(0.5) # the X server draws a little later than it is asked
			window_ = shown(*small)
	scene(4)
	render("-D", "+FP", "File_Gamma=srgb", "+Onoisy.ppm", size=(width, height))
	rows, columns = (numpy.minimum((numpy.arange(n) * (small[0] / width)).astype(int), limit - 1) for n, limit in ((height, small[1]), (width, small[0])))

	def reduced(picture):
		total, count = numpy.zeros((small[1], small[0], 3)), numpy.zeros((small[1], small[0], 1))
		numpy.add.at(total, (rows[:, None], columns[None, :]), picture)
		numpy.add.at(count, (rows[:, None], columns[None, :]), 1)
		return total / count

	apart = [numpy.abs(window_ - reduced(ppm(name))).mean() for name in ("s.ppm", "noisy.ppm")]
	print(f"the window is {apart[0]:.2f} of 255 from the denoised picture, {apart[1]:.2f} from the one before")
	# A mean of up to 4 values is rounded down with each: by half a step on the average, some of which the next mean takes away again.
	assert apart[0] < 2 and apart[1] > 2 * apart[0], "it shows something else than the denoised picture"


def stop():
	scene(100000)
	with screen() as environment:
		with povray(environment, "+D", "+FN", "+Os.png", "+BS8") as process:
			# Some tile is there: the first is lit, and the root window is black.
			wait("something shown", lambda: (shown(160, 120).max(axis=-1) > 0).sum() > 32)
			pointer(environment, "key", "q")
			assert finish(process) == 2, f"exit code {process.returncode}"
	assert not os.path.exists("s.png") and "Render cancelled" in log(), log()


def none():
	scene(4)
	render("-D", "+FN", "+Owithout.png")
	assert "preview window" not in log(), log()
	for name, environment in (("unset", NO_SCREEN), ("dead", dict(NO_SCREEN, DISPLAY=":987654"))):
		for picture in ("f1.png", "f2.png"):
			pathlib.Path(picture).unlink(missing_ok=True)
		# At a terminal, where SDL has drivers that draw in letters.
		ours, its = pty.openpty()
		with running([POVRAY, "+Is.pov", "+W160", "+H120", "+D", "+P", "+FN", "+Of.png", "+KFF2"], stdin=its, stdout=its, stderr=its,
				env=dict(environment, TERM="xterm"), start_new_session=True) as process:
			os.close(its)
			said, end = b"", time.monotonic() + 60
			with contextlib.suppress(OSError): # when the other side is closed
				while time.monotonic() < end:
					if select.select([ours], [], [], 1)[0]:
						said += os.read(ours, 65536)
			assert finish(process, 5) == 0, said.decode(errors="replace")
			os.close(ours)
		assert said.count(b"preview window") == 1, f"{name}: not one line:\n{said.decode(errors='replace')}"
		assert b"\x1b" not in said, f"{name}: it draws on the terminal"
		assert (png("f1.png") == png("without.png")).all(), f"{name}: another picture"
		assert pathlib.Path("f2.png").exists(), f"{name}: one frame alone"
		print(f"{name}: {[line for line in said.decode().splitlines() if 'preview window' in line][0].strip()}")


def states(process, name):
	"""Every picture that lies in the file while the program runs, and the last."""
	seen, pictures = None, []
	while True:
		ended = process.poll() is not None
		with open(name, "rb") as file:
			now = os.fstat(file.fileno())
		if (now.st_ino, now.st_mtime_ns) != seen:
			seen = (now.st_ino, now.st_mtime_ns)
			pictures.append(png(name)) # fails where it is not a whole PNG
		if ended:
			return pictures
		time.sleep(0.02)


def file(lens):
	"""A picture that grows: nothing, parts, all."""
	scene(4096, lens) # seconds on any machine: it is written once a second
	# Without a screen, and none is missed.
	with povray(NO_SCREEN, "+D", "+P", "Display_File=shown.png", "+FN", "+Os.png", "+BS8", "+WT1") as process:
		wait("the file, before anything is traced", lambda: os.path.exists("shown.png"))
		pictures = states(process, "shown.png")
		assert process.returncode == 0, log()
	shares = [float((picture[..., 3] == 255).mean()) for picture in pictures]
	print(f"{len(pictures)} pictures, done: {', '.join(f'{share:.0%}' for share in shares)}")
	assert shares[0] < 0.5 and shares[-1] == 1 and any(0 < share < 1 for share in shares), shares
	assert all(((p[..., 3] == 0) | (p[..., 3] == 255)).all() and (p[p[..., 3] == 0] == 0).all() for p in pictures), "undone parts are not transparent"
	last = numpy.abs(pictures[-1][..., :3] - png("s.png")[..., :3]).max()
	assert last <= ROUNDING, f"the last picture differs from the output by {last} of 255"
	# A part that is done stays, but for what the denoised pass makes of it.
	if not lens:
		for picture in pictures[:-1]:
			done = picture[..., 3] == 255
			assert (picture[done] == pictures[-1][done]).all(), "a part that was done has changed"
	assert not glob.glob("*.new") and "preview window" not in log(), (glob.glob("*"), log())
	stopped()


def stopped():
	"""What is done when a render is stopped stays in the file."""
	scene(20000)
	os.remove("shown.png")
	with povray(NO_SCREEN, "+D", "Display_File=shown.png", "+FN", "+Ostopped.png", "+BS8") as process:
		wait("a part", lambda: os.path.exists("shown.png") and (png("shown.png")[..., 3] == 255).any())
		process.send_signal(signal.SIGTERM)
		assert finish(process) == 2, f"exit code {process.returncode}"
	done = (png("shown.png")[..., 3] == 255).mean()
	assert 0 < done < 1 and not glob.glob("*.new"), (done, glob.glob("*"))
	print(f"stopped: {done:.0%} done")


def names():
	"""Names that are refused, before anything is traced; and the one that nothing comes of."""
	scene(4)
	os.mkdir("folder.png")
	Path("here").symlink_to(".")
	for name, why in (("shown.jpg", "must end in .png"), ("./s.png", "the output's name"), ("here/s.png", "the output's name"), ("no/such/folder.png", "No such file"),
			("folder.png", "irectory")):
		with povray(NO_SCREEN, "+D", f"Display_File={name}", "+FN", "+Os.png") as process:
			assert finish(process) == 1, f"{name}: exit code {process.returncode}"
		lines = [line for line in log().splitlines() if f"Display_File={name}: " in line]
		assert lines and why in lines[0], f"{name}: {log()}"
		assert not os.path.exists("s.png") and not glob.glob("*.new"), f"{name}: {glob.glob('*')}"
		print(lines[0])
	render("-D", "Display_File=shown.png", "+FN", "+Os.png")
	assert log().count("Display_File: nothing is shown without +D") == 1 and not os.path.exists("shown.png"), log()


def quiet():
	"""Neither a pilot nor a part of a picture shows anything, whatever the user's options say."""
	scene(16)
	shows = ["+W160", "+H120", "+D", "+P", f"Display_File={WORK}/shown.png"]
	programs = Path(POVRAY).parent
	for words in ([programs / "tiltcost", "s.pov", *shows, "--pilot-time", "0.2s"],
			[programs / "povray-strips", "s.pov", *shows, "--parts", "2", "--local", "2", "--pilot-time", "0.2s", "+Os.png"]):
		with open("log", "wb") as messages:
			done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=messages, stderr=messages, env=NO_SCREEN, timeout=120, check=False)
		assert done.returncode == 0, log()
		assert not os.path.exists("shown.png"), f"{words[0].name} shows the picture"
	assert os.path.exists("s.png"), "povray-strips made no picture"
	with povray(NO_SCREEN, *shows, "+Oagain.png") as process:
		assert finish(process) == 0 and os.path.exists("shown.png"), log()


shutil.rmtree(WORK, ignore_errors=True)
os.makedirs(WORK)
os.chdir(WORK)
{"blur": lambda: window("", ["click", "1"]), "focus": lambda: window("show focus", ["key", "Return"]), "denoise": lambda: window("denoise", ["key", "q"]),
	"animation": animation, "scaled": scaled, "stop": stop, "none": none, "file": lambda: file(""), "file_denoise": lambda: file("denoise"), "names": names, "quiet": quiet}[CASE]()
print("all well")
