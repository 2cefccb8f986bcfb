# SPDX-License-Identifier: AGPL-3.0-or-later
"""png_pixels.py A B: whether two PNG files have the same pixels, kind and gamma, read without libpng: the joiner uses it.
png_pixels.py --differ A B: whether they are of one kind and other pixels. Files alone always differ: POV-Ray writes the date into them."""
import struct
import sys
import zlib


def paeth(a, b, c):
	p = a + b - c
	return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]


def read(path):
	with open(path, "rb") as file:
		data = file.read()
	at, chunks, pixels = 8, {}, b""
	while at < len(data):
		length, kind = struct.unpack(">I4s", data[at:at + 8])
		body = data[at + 8:at + 8 + length]
		assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0], f"{path}: damaged"
		if kind == b"IDAT":
			pixels += body
		chunks[kind] = body
		at += 12 + length
	width, height, depth, colour = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
	step = {0: 1, 2: 3, 4: 2, 6: 4}[colour] * depth // 8
	raw, before, rows = zlib.decompress(pixels), bytearray(width * step), []
	for y in range(height):
		start = y * (width * step + 1)
		how, line = raw[start], bytearray(raw[start + 1:start + 1 + width * step])
		for i in range(len(line)):
			left, up, corner = line[i - step] if i >= step else 0, before[i], before[i - step] if i >= step else 0
			line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth(left, up, corner))[how]) & 255
		rows.append(bytes(line))
		before = line
	assert len(raw) == height * (width * step + 1)
	return (width, height, depth, colour, chunks.get(b"gAMA")), rows


def compare(one, other):
	(kind_a, a), (kind_b, b) = read(one), read(other)
	assert kind_a == kind_b, f"{kind_a} and {kind_b}"
	differ = [y + 1 for y in range(len(a)) if a[y] != b[y]]
	assert len(set(a)) > 1, "a picture of one row again and again shows nothing"
	assert not differ, f"{len(differ)} of {len(a)} rows differ, row {differ[0]} first"
	print(f"{len(a)} rows of {kind_a[0]} pixels, {kind_a[2]} bits, the same")


def differ(one, other):
	(kind_a, a), (kind_b, b) = read(one), read(other)
	assert kind_a == kind_b, f"{kind_a} and {kind_b}"
	assert a != b, "the same pixels"
	print(f"{sum(x != y for x, y in zip(a, b))} of {len(a)} rows differ")


if __name__ == "__main__":
	if sys.argv[1] == "--differ":
		differ(sys.argv[2], sys.argv[3])
	else:
		compare(sys.argv[1], sys.argv[2])
