#!/usr/bin/python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""What `channels` adds to an OpenEXR file, read by OpenImageIO and held against geometry, the truth and each other.

    channels.py geometry FILE            of channels.sh's scene: depth and blur width
    channels.py samples FILE LOG         against the statistics
    channels.py error FILE TRUTH         the map of the error against the error
    channels.py highlights NAME TRUTH    the same around bright lights, of NAME1.exr to NAME8.exr
    channels.py same FILE FILE [ROW]     all channels, from a row on or whole
    channels.py names FILE NAME...       there are these channels
"""

import re
import sys

import numpy as np
import OpenImageIO as oiio


def read(name):
	buffer = oiio.ImageBuf(name)
	assert buffer.initialized and buffer.read(), f"{name}: {buffer.geterror()}"
	pixels = buffer.get_pixels(oiio.FLOAT).astype(float)
	return {c: pixels[..., i] for i, c in enumerate(buffer.spec().channelnames)}


def geometry(name):
	"""Camera at (0, 2, 0) that looks along z, 4/3 x 1 at distance 1; a floor y = 0, a wall at z = 12 - x/2 up to y = 5, focused on
	y = 0.5. The opening, 0.3 wide, lies in a plane that holds the x axis, about which alone the lens is turned. The blur of a point
	is how far apart the ends of the opening at x = -0.15 and 0.15 see it: where lines from them to the point meet the plane
	of focus."""
	c = read(name)
	rows, columns = c["Z"].shape
	x = ((np.arange(columns) + 0.5) / columns - 0.5) * 4 / 3
	y = 0.5 - (np.arange(rows) + 0.5) / rows
	x, y = np.meshgrid(x, y)
	wall = 12 / (1 + x / 2)
	with np.errstate(divide="ignore"):
		floor = np.where(y < 0, -2 / y, np.inf)
	sky = 2 + y * wall > 5
	depth = np.where(sky, 1e10, np.minimum(wall, floor))
	# Numbers of single precision, and rays whose ends are sums of doubles: 2^-24 of the value and some.
	worst = np.max(abs(c["Z"] / depth - 1))
	assert worst < 2e-7, f"depth is off by {worst:.2g} of itself"
	# Away from the pixels that look along the plane of focus, on which these lines end.
	seen = ~sky & (abs(y) > 0.02)
	P = np.stack([x * depth, 2 + y * depth, depth], -1)
	at = []
	for end in (-0.15, 0.15):
		S = np.array([end, 2.0, 0.0])
		t = 1.5 / (2.0 - P[..., 1])             # S + t (P - S) in y = 0.5, in front or behind
		Q = S + t[..., None] * (P - S)
		at.append(Q[..., 0] / Q[..., 2] / (4 / 3) * columns)
	# Seen from the left, what is nearer than the focus is displaced to the right: positive.
	expected = (at[0] - at[1])[seen]
	assert (expected > 1).sum() > 1000 and (expected < -1).sum() > 1000, "the scene shows both sides"
	worst = np.max(abs(c["blur.X"][seen] - expected) / np.maximum(1, abs(expected)))
	assert worst < 1e-5, f"blur is off by {worst:.2g}"
	print(f"{(expected > 0).sum()} pixels nearer than the focus, {(expected < 0).sum()} beyond it, {sky.sum()} of the sky")


def samples(name, log):
	c = read(name)
	said = re.search(r"Samples/Pixel: +min (\d+) +mean ([0-9.]+) +max (\d+)", open(log).read())
	found = c["samples.X"].min(), c["samples.X"].mean(), c["samples.X"].max()
	assert found[0] == float(said[1]) and found[2] == float(said[3]) and abs(found[1] - float(said[2])) < 0.0051, (found, said[0])
	print(f"{found[0]:.0f} to {found[2]:.0f} samples, {found[1]:.2f} on average")


def blocks(plane):
	h, w = (n // 8 * 8 for n in plane.shape)
	return plane[:h, :w].reshape(h // 8, 8, w // 8, 8).mean((1, 3)).ravel()


def error(name, truth):
	"""Blocks of 8 x 8 pixels, the half of them that the map says to be worst, in five parts. A pixel's estimate is unbiased for
	v(n) ~ n^-1.4; between 1, of independent samples, and 1.7, which nets have, the error is 1.28 to 0.85 of it (root of (2^1.4 - 1)/(2^a - 1)). Blocks are
	sorted by what is estimated itself, from some 64 pixels of some six independent numbers: up to 10 % more. Pixels whose samples
	all missed an edge say nothing: the truth may be larger, by as many as are grazed. Hence a factor 1.5 for each part and the whole."""
	c, t = read(name), read(truth)
	said = blocks(c["error.X"] ** 2)
	true = blocks(sum((c[k] - t[k]) ** 2 for k in "RGB") / 3)
	order = np.argsort(said)
	ratios = [np.sqrt(said[part].mean() / true[part].mean()) for part in np.array_split(order[len(order) // 2:], 5)]
	whole = np.sqrt(said.mean() / true.mean())
	# What is said to be better is.
	halves = [np.sqrt(true[part].mean()) for part in np.array_split(order, 2)]
	assert all(1 / 1.5 < r < 1.5 for r in ratios + [whole]), (ratios, whole)
	assert halves[0] < halves[1], halves
	print(f"said over true: {whole:.2f}, in parts " + " ".join(f"{r:.2f}" for r in ratios))


def shown(pixels):
	return np.clip(pixels, 0, 1)


def highlights(name, truth):
	"""Around bright lights, as displayed, since the map counts light no further: means of the squares of eight pictures NAME1.exr to
	NAME8.exr, of the half of the blocks that the map says to be worst, in five parts. Below the truth by no more than the factor
	of error(); above it, where few samples may have missed a light, the map adds what hides there at 0.06 of the variance, which was measured
	as 0.02 to 0.12 (SampleSums::HiddenPart): by up to sqrt(3)."""
	t = read(truth)
	said = true = linear = 0
	for seed in range(1, 9):
		c = read(f"{name}{seed}.exr")
		said = said + blocks(c["error.X"] ** 2) / 8
		true = true + blocks(sum((shown(c[k]) - shown(t[k])) ** 2 for k in "RGB") / 3) / 8
		linear = linear + blocks(sum((c[k] - t[k]) ** 2 for k in "RGB") / 3) / 8
	assert np.sqrt(linear.mean()) > 1.5 * np.sqrt(true.mean()), "the lights are no brighter than what is shown"
	order = np.argsort(said)
	ratios = [np.sqrt(said[part].mean() / true[part].mean()) for part in np.array_split(order[len(order) // 2:], 5)]
	whole = np.sqrt(said.mean() / true.mean())
	assert all(1 / 1.5 < r < 3 ** 0.5 for r in ratios) and 1 / 1.5 < whole < 1.5, (ratios, whole)
	halves = [np.sqrt(true[part].mean()) for part in np.array_split(order, 2)]
	assert halves[0] < 0.5 * halves[1], halves
	print(f"said over true: {whole:.2f}, in parts " + " ".join(f"{r:.2f}" for r in ratios)
		+ f"; all light, beyond what is shown too, is {np.sqrt(linear.mean() / true.mean()):.1f} times as far off")


def same(first, second, row=None):
	a, b = read(first), read(second)
	assert set(a) == set(b), (sorted(a), sorted(b))
	rows = slice(int(row) if row else 0, None)
	for name in a:
		assert np.array_equal(a[name][rows], b[name][rows]), f"{name} differs"
	print(f"{len(a)} channels")


def names(name, *wanted):
	found = sorted(read(name))
	assert found == sorted(wanted), found
	print(*found)


if __name__ == "__main__":
	globals()[sys.argv[1]](*sys.argv[2:])
