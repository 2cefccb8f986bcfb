# SPDX-License-Identifier: AGPL-3.0-or-later
"""exchange.py WHAT CALIBRATION FILE: a camera that tiltcal wrote for another program puts points where the calibration's numbers do. By the
formulas of the formats' documentation; of Blender by Blender's own (bpy; exit code 77 without). exchange.py camera IMPORTED FILE makes
the calibration: the imported one, tilted, opened and focused. exchange.py warp STMAP PICTURE RESULT: OpenImageIO makes the same of PICTURE."""
import json
import math
import re
import sys

POINTS = [(0, 0, 700), (150, -90, 800), (-200, 120, 1500), (30, 60, 300)]    # camera frame, mm
UNIT = 10     # --unit-mm


def numbers(text):
	return [float(word) for word in text.split()]


class Camera:
	def __init__(self, file):
		with open(file, encoding="utf-8") as stream:
			c = json.load(stream)
		s = c["states"][0]
		self.w, self.pitch, self.d = c["image_distance_mm"], c["pixel_pitch_mm"], c["aperture_diameter_mm"]
		self.width, self.height = c["image_size_px"]
		self.centre = s["principal_point_px"]
		tilt, towards = math.radians(s["lens_tilt_deg"]), math.radians(s["tilt_direction_deg"])
		# The plane of focus recedes towards that direction, and the lens turns away from it.
		n = (-math.sin(tilt) * math.sin(towards), -math.sin(tilt) * math.cos(towards), math.cos(tilt))
		# Thin lens: q = a n - e_z / w, and (0, 0, U) is in focus.
		a = (1 / s["focus_distance_mm"] + 1 / self.w) / n[2]
		self.q = (a * n[0], a * n[1], a * n[2] - 1 / self.w)

	def pixel(self, P):
		"""Of the pinhole without distortion, v down."""
		return self.centre[0] + self.w / self.pitch * P[0] / P[2], self.centre[1] - self.w / self.pitch * P[1] / P[2]

	def in_focus(self, P):
		return sum(a * b for a, b in zip(self.q, P))

	def depth_in_centre(self):
		x = (0.5 * (self.width - 1) - self.centre[0]) * self.pitch / self.w
		y = -(0.5 * (self.height - 1) - self.centre[1]) * self.pitch / self.w
		return 1 / self.in_focus((x, y, 1))


def near(got, want, what, tolerance=1e-9):
	assert abs(got - want) <= tolerance * max(1, abs(want)), f"{what}: {got}, expected {want}"


def by_screen(camera, project):
	"""`project` gives 0..1 from the left and from the top edge."""
	for P in POINTS:
		x, y = project(P)
		u, v = camera.pixel(P)
		near(x * camera.width - 0.5, u, f"u of {P}")
		near(y * camera.height - 0.5, v, f"v of {P}")


def colmap_parameters(camera, text):
	rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
	assert len(rows) == 1 and rows[0][:4] == ["1", "FULL_OPENCV", str(camera.width), str(camera.height)], rows
	assert len(rows[0]) == 16, rows
	return [float(word) for word in rows[0][4:]]


def colmap(camera, text):
	"""Against `tiltcal project` of points all over the picture, in seen.csv. COLMAP's middle of a pixel is 0.5 from its edge."""
	fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 = colmap_parameters(camera, text)
	said = re.search(r"Within (\S+) px RMS of tiltcal's camera, (\S+) px at worst", text)
	assert said and 0 < float(said[1]) <= float(said[2]) < 5, text
	with open("seen.csv", encoding="utf-8") as stream:
		seen = [[float(word) for word in line.split(",")[:5]] for line in stream.readlines()[1:]]
	assert len(seen) > 40, seen
	square = worst = 0
	for X, Y, Z, u, v in seen:
		x, y = X / Z, -Y / Z
		r2 = x * x + y * y
		radial = (1 + k1 * r2 + k2 * r2 ** 2 + k3 * r2 ** 3) / (1 + k4 * r2 + k5 * r2 ** 2 + k6 * r2 ** 3)
		du = fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + cx - 0.5 - u
		dv = fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + cy - 0.5 - v
		square += (du * du + dv * dv) / len(seen)
		worst = max(worst, math.hypot(du, dv))
	# The file says it of a finer grid from edge to edge: the same corners, and of the mean the same to a fifth.
	near(worst, float(said[2]), "the worst", 0.02)
	near(math.sqrt(square), float(said[1]), "RMS", 0.2 * float(said[1]))


def colmap_untilted(camera, text):
	"""A lens that is not tilted is OpenCV's own model: the numbers of camera.yml."""
	for got, want in zip(colmap_parameters(camera, text), [2400, 2400, 900.5, 600.5, -0.125, 0.02, 0.001, 0, 0, 0, 0, 0]):
		near(got, want, "parameter", 1e-6)


def renderman(camera, text):
	left, right, bottom, top = numbers(re.search(r"^ScreenWindow (.*)$", text, re.M)[1])
	fov = float(re.search(r'"float fov" \[(\S+)\]', text)[1])
	assert numbers(re.search(r"^Format (.*)$", text, re.M)[1]) == [camera.width, camera.height, 1]
	scale = math.tan(math.radians(fov) / 2)       # of the screen where z = 1

	def project(P):
		return (P[0] / P[2] / scale - left) / (right - left), (top - P[1] / P[2] / scale) / (top - bottom)
	by_screen(camera, project)
	points = [numbers(found) for found in re.findall(r'"point focus\d" \[([^\]]*)\]', text)]
	assert len(points) == 3
	for P in points:
		near(camera.in_focus([UNIT * x for x in P]), 1, "plane of focus")
	a, b = ([x - y for x, y in zip(points[k], points[0])] for k in (1, 2))
	assert abs(a[0] * b[1] - a[1] * b[0]) + abs(a[1] * b[2] - a[2] * b[1]) > 1, "the points are on a line"
	stop, length, distance = numbers(re.search(r"^DepthOfField ([^#]*)", text, re.M)[1])
	near(length / stop * UNIT, camera.d, "opening")
	near(distance * UNIT, camera.depth_in_centre(), "distance")


def arnold(camera, text):
	word = dict(re.findall(r"^ (\w+) (.*)$", text, re.M))
	assert (word["xres"], word["yres"]) == (str(camera.width), str(camera.height))
	(left, bottom), (right, top) = numbers(word["screen_window_min"]), numbers(word["screen_window_max"])
	scale = math.tan(math.radians(float(word["fov"])) / 2)
	aspect = camera.height / camera.width

	def project(P):
		return (P[0] / P[2] / scale - left) / (right - left), (top - P[1] / P[2] / scale / aspect) / (top - bottom)
	by_screen(camera, project)
	near(2 * float(word["aperture_size"]) * UNIT, camera.d, "opening")
	near(float(word["focus_distance"]) * UNIT, camera.depth_in_centre(), "distance")


def blender(camera, text):
	try:
		import bpy
	except ImportError:
		print("skipped: no bpy (pip install bpy)")
		sys.exit(77)
	from bpy_extras.object_utils import world_to_camera_view
	from mathutils import Vector
	exec(compile(text, "blender.py", "exec"), {})     # as Blender does
	scene = bpy.context.scene
	bpy.context.view_layer.update()
	placed = scene.camera
	assert (scene.render.resolution_x, scene.render.resolution_y) == (camera.width, camera.height)

	def project(P):
		# Blender's camera looks along -z. Its numbers are floats of 24 bits: 2e-4 of 1800 px.
		seen = world_to_camera_view(scene, placed, placed.matrix_world @ Vector((P[0] / UNIT, P[1] / UNIT, -P[2] / UNIT)))
		return seen.x, 1 - seen.y
	for P in POINTS:
		(x, y), (u, v) = project(P), camera.pixel(P)
		near(x * camera.width - 0.5, u, f"u of {P}", 2e-6)
		near(y * camera.height - 0.5, v, f"v of {P}", 2e-6)
	# It looks along +y, z up.
	ahead = placed.matrix_world.to_3x3() @ Vector((0, 0, -1))
	near(ahead.y, 1, "forward", 1e-6)
	dof = placed.data.dof
	assert dof.use_dof
	near(dof.focus_distance * UNIT, camera.depth_in_centre(), "distance", 1e-6)
	# Cycles' opening: lens in metres over the f-stop, in units of the scene (blender_camera.cpp).
	near(placed.data.lens / 1000 / dof.aperture_fstop * UNIT, camera.d, "opening", 1e-6)
	planes = [o for o in scene.objects if o.parent is placed]
	assert len(planes) == 1 and planes[0].hide_render
	for vertex in planes[0].data.vertices:
		x, y, z = placed.matrix_world.inverted() @ planes[0].matrix_world @ vertex.co
		near(camera.in_focus((UNIT * x, UNIT * y, -UNIT * z)), 1, "plane of focus", 1e-5)


def make_camera(imported, file):
	with open(imported, encoding="utf-8") as stream:
		c = json.load(stream)
	c["aperture_diameter_mm"] = 16
	c["states"][0].update(lens_tilt_deg=5, tilt_direction_deg=25, focus_distance_mm=650, principal_point_px=[911.7, 588.3])
	with open(file, "w", encoding="utf-8") as stream:
		json.dump(c, stream)


def warp(stmap, picture, result):
	try:
		import numpy
		import OpenImageIO as oiio
	except ImportError:
		print("skipped: no OpenImageIO (python3-openimageio)")
		sys.exit(77)
	# Its st counts from the top unless it is told otherwise. Catmull-Rom is Keys's cubic with a = -1/2.
	theirs = oiio.ImageBufAlgo.st_warp(oiio.ImageBuf(picture), oiio.ImageBuf(stmap), "catmull-rom", 0.0, 0, 1, False, True)
	assert not theirs.has_error, theirs.geterror()
	ours = oiio.ImageBuf(result)
	a, b = theirs.get_pixels()[4:-4, 4:-4], ours.get_pixels()[4:-4, 4:-4]      # at the edge they take other pixels for those outside
	assert a.shape == b.shape, (a.shape, b.shape)
	straight = numpy.abs(a - oiio.ImageBuf(picture).get_pixels()[4:-4, 4:-4]).max()
	worst = numpy.abs(a - b).max()
	print(f"OpenImageIO: {worst:.2g} of {straight:.2g} at most")
	# A map of floats, 2^-24 of the width; between neighbours light changes by less than 1.
	assert straight > 0.1 and worst < 1800 * 2.0 ** -24 * 2, worst


what, calibration, written = sys.argv[1:4]
if what == "camera":
	make_camera(calibration, written)
elif what == "warp":
	warp(calibration, written, sys.argv[4])
else:
	with open(written, encoding="utf-8") as stream:
		globals()[what](Camera(calibration), stream.read())
