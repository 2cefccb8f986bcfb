# SPDX-License-Identifier: AGPL-3.0-or-later
"""python_module.py FOLDER: the module's shapes, numbers and errors, on the demo's photographs."""
import inspect
import os
import sys
import tempfile
from pathlib import Path

import numpy as np
import tiltcal

photos = Path(sys.argv[1])
messages = []
few = {"board": "12x9", "square_mm": 25, "pitch_mm": 0.02, "edges_per_photo": 40, "model": "plane", "progress": messages.append}
found = tiltcal.calibrate([photos / f"untilted-{k}.jpg" for k in (1, 2, 3)], {"plus5": [str(photos / f"plus5-{k}.jpg") for k in (1, 2, 3)]}, **few)
assert any("untilted-1.jpg" in text for text in messages), messages
assert found.states == ["untilted", "plus5"] and found.model == "plane" and found.grade in ("good", "fair", "poor")
tilt, sigma = found.tilt("plus5")
# A smoke test: the plane of focus of a curved field is off by tenths (README.md has what accuracy the models have).
assert abs(tilt - 5) < 1 and 0 < sigma < 1, (tilt, sigma)

for state in found.states:
	camera = found.camera(state)
	w = camera.image_distance_mm / camera.pitch_mm
	pixels = np.random.default_rng(1).uniform([0, 0], [camera.width, camera.height], (4, 5, 2))
	rays = camera.unproject(pixels)
	assert rays.shape == (4, 5, 3) and np.allclose(np.linalg.norm(rays, axis=-1), 1, atol=1e-14)
	assert np.abs(camera.project(700 * rays) - pixels).max() < 1e-8
	points = 700 * rays
	blur = camera.blur(points)
	assert blur.shape == (4, 5)
	# The paper's (2) with the plane of focus along the ray, by numpy: w d |1 - q.P| / z.
	flat = w * camera.aperture_diameter_mm * np.abs(1 - points @ camera.plane_of_focus) / points[..., 2]
	if camera.field_curvature_per_mm == 0:
		assert np.allclose(blur, flat, rtol=1e-12)
	outline = camera.footprint(points, count=16)
	assert outline.shape == (4, 5, 16, 2)
	# First order against exact: (d / 2) |q| of itself, the lens's tilt and the stretching of the distortion: within a tenth.
	width = np.linalg.norm(outline - np.roll(outline, 8, axis=-2), axis=-1).mean(axis=-1)
	assert np.all(np.abs(width - blur) <= 0.1 * blur + 1e-6), (width, blur)
	assert "tilt_lens" in camera.povray()

camera = found.camera()
assert camera.state == "untilted" and camera.project([0, 0, 100]).shape == (2,)
assert np.isnan(camera.project([[0, 0, -1], [0, 0, 5]])).tolist() == [[True, True], [False, False]] and np.isnan(camera.blur([0, 0, -1]))
assert camera.distortion.shape == (5,) and camera.principal_point.shape == (2,) and camera.lens_normal.tolist() == [0, 0, 1]
# Integers and strided arrays are taken too.
assert camera.project(np.arange(12).reshape(4, 3)[::2]).shape == (2, 2)


def refuses(text, call):
	try:
		call()
	except tiltcal.Error as error:
		assert text in str(error), error
	else:
		raise AssertionError(f"not refused: {text}")


refuses("last axis must have 3", lambda: camera.project([1, 2]))
refuses("`count`", lambda: camera.footprint([1, 2, 3], count=0))
refuses("no state plus9", lambda: found.camera("plus9"))
refuses("nowhere.jpg", lambda: tiltcal.calibrate(["nowhere.jpg"], {"plus5": [photos / "plus5-1.jpg"]}, **few))
refuses("plus5 has no photographs", lambda: tiltcal.calibrate([photos / "untilted-1.jpg"], {"plus5": []}, **few))
refuses("`state` untilted:f_number=N", lambda: tiltcal.calibrate([photos / "untilted-1.jpg"], {}, stopped=[("untilted", 8, [photos / "untilted-2.jpg"])], **few))
refuses("`edges_per_photo` 1: give 0", lambda: tiltcal.calibrate([photos / "untilted-1.jpg"], {}, **{**few, "edges_per_photo": 1}))
# Turned the other way round it is read by whom that does not matter to.
assert tiltcal.calibrate([photos / f"untilted-{k}.jpg" for k in (1, 2, 3)], {}, any_orientation=True, **few).states == ["untilted"]
refuses("f_number", lambda: tiltcal.calibrate([photos / "untilted-1.jpg"], {}, f_number=0, **few))
refuses("`model` 'thin'", lambda: tiltcal.calibrate([photos / "untilted-1.jpg"], {}, **{**few, "model": "thin"}))
refuses("nowhere.json", lambda: tiltcal.read_camera("nowhere.json"))
# Names that are not UTF-8, in errors and messages.
refuses("h\\xe4user.json", lambda: tiltcal.read_camera(os.fsdecode(b"h\xe4user.json")))
with tempfile.TemporaryDirectory() as folder:
	photo = os.path.join(os.fsencode(folder), b"h\xe4user.jpg")
	os.symlink(os.fsencode(photos / "untilted-1.jpg"), photo)
	heard = []
	try:
		tiltcal.calibrate([os.fsdecode(photo)], {}, **{**few, "progress": heard.append})
	except tiltcal.Error:
		pass
	assert any("h\\xe4user.jpg" in text for text in heard), heard


def stop(text):
	raise KeyboardInterrupt


try:
	tiltcal.calibrate([photos / "untilted-1.jpg"], {"plus5": [photos / "plus5-1.jpg"]}, **{**few, "progress": stop})
	raise AssertionError("not stopped")
except KeyboardInterrupt:
	pass
for function in (tiltcal.calibrate, tiltcal.read_camera, tiltcal.Camera.project, tiltcal.Camera.unproject, tiltcal.Camera.blur, tiltcal.Camera.footprint):
	assert len(inspect.getdoc(function)) > 40, function
print(f"all well: tilt {tilt:.3f} +- {sigma:.3f}")
