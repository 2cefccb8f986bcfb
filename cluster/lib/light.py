# SPDX-License-Identifier: AGPL-3.0-or-later
"""Radiosity and photons once for all parts (--light)."""


def make_light(sub):
	if sub["light"]:
		raise NotImplementedError
