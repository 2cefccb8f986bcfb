# SPDX-License-Identifier: AGPL-3.0-or-later
"""preview.py XWD PICTURE: whether the screen (Xvfb's framebuffer, XWD) shows PICTURE (PNG, 8 bits) somewhere, pixel for pixel.
preview.py XWD something: whether it shows anything in colour."""
import struct
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import png_pixels


def screen(file):
	with open(file, "rb") as stream:
		data = stream.read()
	header = struct.unpack(">25I", data[:100])
	size, width, height, big_endian, bits, line, colours = header[0], header[4], header[5], header[7], header[11], header[12], header[19]
	assert bits == 32, bits
	pixels = numpy.frombuffer(data, dtype=">u4" if big_endian else "<u4", offset=size + 12 * colours, count=height * line // 4).reshape(height, line // 4)[:, :width]
	return numpy.stack([pixels >> 16 & 255, pixels >> 8 & 255, pixels & 255], axis=-1)


def picture(file):
	(width, height, depth, colour, _), rows = png_pixels.read(file)
	assert depth == 8 and colour in (2, 6), (depth, colour)
	return numpy.frombuffer(b"".join(rows), dtype=numpy.uint8).reshape(height, width, -1)[..., :3].astype(int)


shown = screen(sys.argv[1])
if sys.argv[2] == "something":
	# The root window is black or grey.
	assert (shown.max(axis=-1) != shown.min(axis=-1)).sum() > 100, "nothing in colour"
	sys.exit()
wanted = picture(sys.argv[2])
height, width = wanted.shape[:2]
best = None
# The window's corner: where the picture's first coloured column could be. All places, by the first row first.
for y in range(shown.shape[0] - height + 1):
	for x in range(shown.shape[1] - width + 1):
		if (numpy.abs(shown[y, x] - wanted[0, 0]) <= 1).all() and (numpy.abs(shown[y, x:x + width] - wanted[0]) <= 1).all():
			worst = numpy.abs(shown[y:y + height, x:x + width] - wanted).max()
			best = worst if best is None else min(best, worst)
assert best is not None, "its first row is nowhere"
# The window rounds to 8 bits otherwise than the file.
assert best <= 1, f"it differs by {best} of 255"
print(f"{width} x {height} pixels, the same but for rounding")
