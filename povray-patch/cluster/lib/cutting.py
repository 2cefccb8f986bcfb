# SPDX-License-Identifier: AGPL-3.0-or-later
"""A picture's rows into strips of equal cost."""

# POV-Ray takes +ER1 for the whole picture's last row (a value up to 1 is a share), so that row 1 is no strip of its own.
FIRST_STRIP = 2


def _strips_within(sums, rows, margin, bound, most=None):
	"""Strips from the top, each as high as `bound` seconds allow, with the margin rows that it traces too; no more of them than one above `most`."""
	strips, first = [], 0
	while first < rows and (most is None or len(strips) <= most):
		above = sums[max(0, first - margin)]
		last = first if first > 0 else min(rows, FIRST_STRIP) - 1
		# By halves: the cost grows with the last row.
		low, high = last, rows - 1
		while low < high:
			middle = (low + high + 1) // 2
			if sums[min(rows, middle + 1 + margin)] - above <= bound:
				low = middle
			else:
				high = middle - 1
		strips.append((first, low))
		first = low + 1
	return strips


def _sums(row_seconds):
	least = max(sum(row_seconds) / len(row_seconds) * 1e-3, 1e-12)     # a row costs something, whatever was measured
	sums = [0.0]
	for seconds in row_seconds:
		sums.append(sums[-1] + max(seconds, least))
	return sums


def _cheapest(sums, parts, margin):
	"""At most `parts` strips whose costliest is as cheap as it can be."""
	rows = len(sums) - 1
	low, high = 0.0, sums[-1]
	best = _strips_within(sums, rows, margin, high)
	for _ in range(60):
		middle = (low + high) / 2
		if high - low < 1e-6 * high:
			break
		strips = _strips_within(sums, rows, margin, middle, parts)
		if len(strips) <= parts:
			best, high = strips, middle
		else:
			low = middle
	return best


def cut(row_seconds, parts, margin=0):
	"""At most `parts` strips (first, last), counted from 0, whose costliest is as cheap as it can be."""
	sums = _sums(row_seconds)
	return _evened(_cheapest(sums, parts, margin), sums, len(row_seconds), margin)


def longest(row_seconds, parts, margin=0):
	"""Seconds of the costliest strip of cut()."""
	sums, rows = _sums(row_seconds), len(row_seconds)
	return max(sums[min(rows, last + 1 + margin)] - sums[max(0, first - margin)] for first, last in _cheapest(sums, parts, margin))


def _evened(strips, sums, rows, margin):
	"""The greedy cut leaves its last strip small: boundaries move up while that helps the two beside them."""
	def cost(first, last):
		return sums[min(rows, last + 1 + margin)] - sums[max(0, first - margin)]
	strips = [list(strip) for strip in strips]
	for _ in range(4 * len(strips)):
		moved = False
		for i in range(len(strips) - 1, 0, -1):
			above, below = strips[i - 1], strips[i]
			while above[1] > above[0] + (FIRST_STRIP - 1 if above[0] == 0 else 0) and cost(above[1], below[1]) < cost(*above):
				above[1] -= 1
				below[0] -= 1
				moved = True
		if not moved:
			break
	return [tuple(strip) for strip in strips]


def cost_of(row_seconds, strip, margin=0):
	return sum(row_seconds[max(0, strip[0] - margin):strip[1] + 1 + margin])


def equal_rows(rows, parts):
	return cut([1.0] * rows, parts)


def frame_groups(frames, parts):
	"""Consecutive frames, as many groups as parts and none larger by more than one."""
	count = min(parts, len(frames))
	return [frames[i * len(frames) // count:(i + 1) * len(frames) // count] for i in range(count)]
