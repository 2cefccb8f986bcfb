#!/usr/bin/env python3
# usage: same_numbers.py A.json B.json MOST
# Two JSON files are the same, numbers to MOST of themselves. Prints the largest difference.
import json, sys

def walk(a, b, place, worst):
	if isinstance(a, dict):
		assert isinstance(b, dict) and a.keys() == b.keys(), place
		for k in a:
			walk(a[k], b[k], place + "." + k, worst)
	elif isinstance(a, list):
		assert isinstance(b, list) and len(a) == len(b), place
		for k in range(len(a)):
			walk(a[k], b[k], "%s[%d]" % (place, k), worst)
	elif isinstance(a, float) or isinstance(b, float):
		worst.append((abs(a - b) / max(abs(a), abs(b), 1e-6), place))
	else:
		assert a == b, "%s: %s, %s" % (place, a, b)

worst = [(0, "nothing")]
walk(json.load(open(sys.argv[1])), json.load(open(sys.argv[2])), "", worst)
print("largest difference %g at %s" % max(worst))
sys.exit(max(worst)[0] > float(sys.argv[3]))
