# SPDX-License-Identifier: AGPL-3.0-or-later
"""The page of the plane of focus in headless Chromium.

usage: plane_page.py CASE PAGE.html ARGUMENT...
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
	from selenium import webdriver
	from selenium.webdriver.common.action_chains import ActionChains
	from selenium.webdriver.chrome.service import Service
	from selenium.webdriver.common.by import By
	from selenium.webdriver.common.keys import Keys
except ImportError:
	sys.exit(f"{sys.executable} has no selenium: cmake/setup.sh installs chromium, chromium-driver and python3-selenium")

SHORT = tempfile.TemporaryDirectory(dir="/tmp", ignore_cleanup_errors=True)


def browser():
	options = webdriver.ChromeOptions()
	for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,1000"):
		options.add_argument(argument)
	options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
	try:
		# Chromium's profile holds a socket, and a socket's path has at most 107 characters.
		os.environ["TMPDIR"] = SHORT.name
		# By its path: not every selenium finds it by itself.
		return webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
	except Exception as error:
		sys.exit(f"Chromium does not start; cmake/setup.sh installs chromium and chromium-driver: {error}")


class Page:
	"""One live sketch of an open page."""

	def __init__(self, driver, number=0):
		self.driver, self.number = driver, number
		self.root = driver.find_elements(By.CSS_SELECTOR, ".plane")[number]

	def js(self, code, *arguments):
		return self.driver.execute_script(f"const page = PlanePages.pages[{self.number}]; {code}", *arguments)

	def find(self, selector):
		return self.root.find_element(By.CSS_SELECTOR, selector)

	def field(self, name):
		return self.find(f"#plane{self.number}-{name}")

	def type(self, name, text):
		field = self.field(name)
		field.send_keys(Keys.CONTROL, "a")
		field.send_keys(text)
		return field

	def choose(self, name, value):
		self.find(f"[name=plane{self.number}-{name}][value={value}]").click()

	def block(self):
		return self.find(".block").get_attribute("value")

	def lens(self):
		return self.js("const l = page.lens; return {q: l.q, w: l.w, f: l.f, d: l.d, corners: l.corners, normal: l.normal}")

	def text(self):
		return self.js("return ['.result', '.pixels'].map(name => page.Find(name).innerText).join('\\n')") + self.find("svg").get_attribute("textContent")

	def view(self):
		return self.root.get_attribute("data-view")

	def drawing(self):
		return self.find("svg").get_attribute("innerHTML")


def opened(driver, file):
	driver.get(pathlib.Path(file).absolute().as_uri())
	return Page(driver)


def is_sound(driver, file):
	"""No errors, nothing from elsewhere."""
	errors = [entry for entry in driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
	assert not errors, errors
	assert driver.execute_script("return performance.getEntriesByType('resource').length") == 0
	# A namespace is a name, not an address that is fetched.
	html = pathlib.Path(file).read_text(errors="replace").replace('xmlns="http://www.w3.org/2000/svg"', "")
	for word in ("http:", "https:", "@import", "url(", " src=\"/", "<link"):
		assert word not in html, word


def is_drawn(page):
	assert page.find("svg").is_displayed() and "<path" in page.drawing()
	for text in (page.drawing(), page.text(), page.block()):
		assert not re.search(r"NaN|undefined|Infinity|null", text), text


def near(a, b, bound, what):
	"""Numbers, or lists and objects of them; a list's numbers relative to its largest."""
	if isinstance(a, dict):
		assert set(a) == set(b), f"{what}: {sorted(a)} and {sorted(b)}"
		for key in a:
			near(a[key], b[key], bound, f"{what}.{key}")
		return
	a, b = (x if isinstance(x, list) else [x] for x in (a, b))
	assert len(a) == len(b), f"{what}: {len(a)} and {len(b)} numbers"
	if a and isinstance(a[0], list):
		for i, pair in enumerate(zip(a, b)):
			near(*pair, bound, f"{what}[{i}]")
		return
	size = max(map(abs, a + b))
	for x, y in zip(a, b):
		assert abs(x - y) <= bound * size, f"{what}: {a} and {b}"


def formulas(driver, file, cases):
	"""The same functions in C++ and JavaScript. Both have 53 bits and the same operations, but for hypot; the worst cancellation among these
	cases, in 1/w = n_z/f - 1/U, leaves 1e-12. 1e-9 is far above that, and far below what any other formula would give."""
	opened(driver, file)
	table = json.loads(subprocess.run([cases], check=True, capture_output=True).stdout)
	values = driver.execute_script("return arguments[0].map(c => PlanePages.optics[c.name](...c.args))", table["formulas"])
	for case, value in zip(table["formulas"], values):
		near(case["value"], value, 1e-9, case["name"])
	names = {case["name"] for case in table["formulas"]}
	assert names == set(driver.execute_script("return Object.keys(PlanePages.optics)")), "a formula without cases"
	lenses = driver.execute_script("""return arguments[0].map(c => { try { const l = PlanePages.SolveLens(c.settings, c.camera);
		return {q: l.q, w: l.w, f: l.f, d: l.d, normal: l.normal, corners: l.corners}; } catch (error) { return error.message; } })""", table["lenses"])
	made = 0
	for number, (case, lens) in enumerate(zip(table["lenses"], lenses)):
		assert case["made"] == isinstance(lens, dict), f"lens {number}: {case['made']} but {lens}"
		if case["made"]:
			made += 1
			near(case["lens"], lens, 1e-9, f"lens {number}")
	assert 300 < made < len(lenses) - 20, f"{made} of {len(lenses)}: both kinds are wanted"
	# What is sharp: points of the limits have a blur of the circle of confusion, by optics.h's formula.
	blur = driver.execute_script("""const page = PlanePages.pages[0], l = page.lens, o = PlanePages.optics;
		return [l.near, l.far].map(q => l.corners.map(v => o.SignedBlurWidth(l.w, l.d, l.q, v.map(x => x / o.InverseFocusDistance(q, v))) / page.settings.circle))""")
	near(blur, [[1] * 4, [-1] * 4], 1e-9, "blur at the limits")
	# A plane along the axis has no distance along it; what is within the focal length is so by its own distance, 100 cos 65.3.
	settings, camera = table["lenses"][0]["settings"], table["lenses"][0]["camera"]
	said = lambda **changed: driver.execute_script("try { PlanePages.SolveLens(arguments[0], arguments[1]); return ''; } catch (e) { return e.message; }",
		{**settings, "drive": "plane", "hold": "focal_length", "focal_length": 45, "direction": 0, **changed}, camera)
	assert "state it by a point and a normal" in said(plane_tilt=90, inverse_distance=0), said(plane_tilt=90, inverse_distance=0)
	assert "passes 41.79" in said(plane_tilt=65.3, inverse_distance=0.01), said(plane_tilt=65.3, inverse_distance=0.01)
	print(f"{len(values)} values of {len(names)} formulas, {made} lenses and {len(lenses) - made} refusals")


def page(driver, file):
	"""Drag, slide, type, copy."""
	p = opened(driver, file)
	is_sound(driver, file)
	is_drawn(p)
	assert driver.find_element(By.TAG_NAME, "h1").text.startswith("a <b>&amp; scene"), driver.find_element(By.TAG_NAME, "h1").text
	sketch = p.find("svg")

	def changes(what, action):
		before = p.view(), p.drawing()
		action()
		assert p.view() != before[0] and p.drawing() != before[1], what
		is_drawn(p)
	changes("drag", lambda: ActionChains(driver, duration=20).drag_and_drop_by_offset(sketch, 120, 40).perform())
	changes("arrow", lambda: sketch.send_keys(Keys.ARROW_LEFT))
	changes("plus", lambda: sketch.send_keys("+"))
	changes("wheel", lambda: ActionChains(driver, duration=20).scroll_from_origin(webdriver.common.actions.wheel_input.ScrollOrigin.from_element(sketch), 0, 200).perform())
	for view in ("side", "top", "behind", "camera", "oblique"):
		changes(view, lambda: p.find(f"[data-view={view}]").click())
	touch = "const svg = page.live.querySelector('svg'), at = (x, type) => svg.dispatchEvent(new PointerEvent(type, {pointerId: 1, pointerType: 'touch', clientX: x, clientY: 300, bubbles: true}));"
	changes("touch", lambda: p.js("SVGElement.prototype.setPointerCapture = () => {};" + touch + "at(200, 'pointerdown'); at(260, 'pointermove'); at(260, 'pointerup')"))

	# A slider: number, block and numbers follow. Merklinger: the hinge is f/sin(tilt) away.
	p.choose("hold", "focal_length")
	before = p.field("tilt").get_attribute("value"), p.block(), p.drawing()
	p.find("#plane0-tilt-slide").send_keys(*[Keys.ARROW_RIGHT] * 5)
	tilt = float(p.field("tilt").get_attribute("value"))
	assert (str(tilt), p.block(), p.drawing()) != before and tilt != float(before[0]) and f"lens_tilt {tilt:g}" in p.block(), (before, tilt)
	lens = p.lens()
	near(1 / math.hypot(*lens["q"][:2]), lens["f"] / math.sin(math.radians(tilt)), 1e-9, "hinge")
	assert re.search(rf"Hinge ?\s*{re.escape(format(lens['f'] / math.sin(math.radians(tilt)), '.4g'))}", p.text()), p.text()
	for slide in ("direction", "inverse_distance", "f_stop", "circle", "shift_x", "shift_y", "focal_length"):
		before = p.text() + p.block(), p.drawing()
		p.find(f"#plane0-{slide}-slide").send_keys(*[Keys.ARROW_RIGHT] * 3)
		assert before[0] != p.text() + p.block() and before[1] != p.drawing(), slide
		is_drawn(p)

	# What is no number changes nothing, and is marked.
	block = p.block()
	assert p.type("tilt", "five").get_attribute("aria-invalid") == "true" and p.block() == block
	assert p.type("f_stop", "-2").get_attribute("aria-invalid") == "true" and p.block() == block
	p.find(".reset").click()
	assert not p.root.find_elements(By.CSS_SELECTOR, "[aria-invalid=true]"), "still marked"

	def says(text):
		assert text in p.text(), f"does not say '{text}': {p.text()}"
		is_drawn(p)
	p.choose("hold", "focal_length")
	p.type("tilt", "0")
	says("limits of sharpness are parallel")
	says("Hyperfocal distance")
	hyperfocal = p.js("const l = page.lens; return l.f + l.f * l.f / (page.settings.f_stop * page.settings.circle)")
	p.type("inverse_distance", repr(hyperfocal * 1.0001))
	says("to ∞")
	p.type("inverse_distance", repr(hyperfocal * 0.9999))
	assert "to ∞" not in p.text(), p.text()
	for distance, drawn in ((200, True), (1e7, False)):
		p.type("inverse_distance", str(distance))
		assert ('class="focus"' in p.drawing()) == drawn and ("beyond what is drawn" in p.text()) != drawn, distance
	p.type("inverse_distance", "inf")
	says("at infinity")
	assert "focal_distance 1e+30" in p.block(), p.block()
	p.type("inverse_distance", "-50")
	says("behind the lens")
	p.type("tilt", "8")
	p.type("inverse_distance", "inf")
	says("parallel to the axis")
	p.type("f_stop", "∞")
	says("pinhole")
	p.type("f_stop", "2")
	p.type("inverse_distance", repr(p.js("return page.settings.focal_length") / 2))
	says("No lens does this")
	assert not p.find(".copy").is_enabled() and "tilt_lens {" not in p.block()
	p.find(".reset").click()
	assert p.find(".copy").is_enabled() and not p.find(".refusal").is_displayed()

	# The clipboard, and without one the selection.
	driver.execute_cdp_cmd("Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
	p.find(".copy").click()
	copied = driver.execute_async_script("const done = arguments[0]; setTimeout(() => navigator.clipboard.readText().then(done, error => done('error: ' + error)), 200)")
	assert copied == p.block() and copied.startswith("tilt_lens {") and p.find(".said").text == "Copied.", copied
	driver.execute_script("Object.defineProperty(navigator, 'clipboard', {value: undefined})")
	p.find(".copy").click()
	assert driver.execute_script("return document.activeElement.className") == "block" and p.find(".said").text, "no fallback"

	# A telephone: nothing is wider than the screen; and in the dark.
	driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 360, "height": 740, "deviceScaleFactor": 2, "mobile": True})
	assert driver.execute_script("return document.documentElement.scrollWidth") <= 360, "wider than a telephone"
	is_drawn(p)
	colours = []
	for scheme in ("light", "dark"):
		driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
		colours.append(driver.execute_script("return [document.body, document.querySelector('.plane')].map(e => getComputedStyle(e).backgroundColor)"))
	assert colours[0] == ["rgb(255, 255, 255)"] * 2 and colours[1][0] == colours[1][1] != colours[0][0], colours
	is_sound(driver, file)
	assert os.path.getsize(file) < 60000, "60 KB"


def report(driver, file):
	"""report.html: a live sketch for every state, the still ones on paper and without scripts."""
	keeps_views(driver, file)
	p = opened(driver, file)
	is_sound(driver, file)
	states = driver.find_elements(By.CSS_SELECTOR, ".plane")
	still = driver.find_elements(By.CSS_SELECTOR, ".plane-still svg.sketch")
	assert len(states) == 2 == len(still), (len(states), len(still))
	for number in range(2):
		is_drawn(Page(driver, number))
	p = Page(driver, 1)
	assert "mm" in p.text() and p.find("svg text.number").text == "1"
	before = p.view()
	driver.execute_script("arguments[0].scrollIntoView()", p.find("svg"))
	ActionChains(driver, duration=20).drag_and_drop_by_offset(p.find("svg"), -80, 20).perform()
	assert p.view() != before and Page(driver, 0).view() == before
	# The numbers are the calibration's.
	calibration = json.loads((pathlib.Path(file).parent / "calibration.json").read_text())
	state = calibration["states"][1]
	near(p.lens()["q"], state["inverse_focus_per_mm"], 1e-9, "q")
	near(p.lens()["w"], calibration["image_distance_mm"], 1e-9, "w")
	near(abs(p.js("return page.settings.tilt")), abs(state["lens_tilt_deg"]), 1e-9, "tilt")
	assert not any(svg.is_displayed() for svg in still) and p.find("svg").is_displayed()
	driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
	assert all(svg.is_displayed() for svg in still) and not p.find("svg").is_displayed(), "on paper"
	driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "screen"})
	driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
	driver.refresh()
	assert all(svg.is_displayed() for svg in driver.find_elements(By.CSS_SELECTOR, ".plane-still svg.sketch")), "without scripts"


def keeps_views(driver, file):
	"""A page that loads itself again, as --watch writes it, shows its sketches as they were turned; others begin anew."""
	reloading = pathlib.Path(file).with_name("reloading.html")
	reloading.write_text(pathlib.Path(file).read_text().replace("<title>", '<meta http-equiv="refresh" content="1000"/><title>', 1))
	for page, stays in ((reloading, True), (pathlib.Path(file), False)):
		opened(driver, page)
		second = Page(driver, 1)
		first = second.view()
		second.js("page.sketch.Turn(0.3, 0.1); page.sketch.Zoom(1.5); page.sketch.Move(9, -4)")
		turned = second.view(), second.js("return page.sketch.pan")
		driver.refresh()
		again = Page(driver, 1)
		assert ((again.view(), again.js("return page.sketch.pan")) == turned) == stays and (stays or again.view() == first), page


def blocks(driver, file, tiltcost, povray, scene):
	"""Blocks of every kind in the same camera: POV-Ray parses the page's lens. Ten digits are written: 5e-11 of each number; the lens follows from
	them with differences of inverse lengths, of which none here loses more than one digit."""
	p = opened(driver, file)
	whole = pathlib.Path(scene).read_text()

	def parsed(block):
		again, out = pathlib.Path("again.pov"), pathlib.Path("again.html")
		again.write_text(re.sub(r"tilt_lens \{.*?\n\}\n", lambda match: block, whole, count=1, flags=re.S))
		result = subprocess.run([tiltcost, "--povray", povray, again, "+W32", "+H24", "--page", out], capture_output=True, text=True)
		assert result.returncode == 0, result.stderr + block
		return json.loads(re.search(r'<script type="application/json">(.*?)</script>', out.read_text()).group(1))
	first = json.loads(re.search(r'<script type="application/json">(.*?)</script>', pathlib.Path(file).read_text()).group(1))
	tried = 0
	for drive in ("lens", "plane", "point"):
		for hold in ("focal_length", "image_distance"):
			p.js("Object.assign(page.settings, JSON.parse(page.first), {drive: 'lens', direction: 140, tilt: -6, inverse_distance: 1 / 7.25, f_stop: 2.8, shift: [0.05, -0.02]}); page.Update()")
			p.choose("drive", drive)
			p.choose("hold", hold)
			block, lens, camera = p.block(), p.lens(), parsed(p.block())
			for key, name in (("q", "inverse_focus"), ("w", "image_distance"), ("d", "aperture_diameter"), ("normal", "lens_normal")):
				near(lens[key], camera[name], 1e-9, f"{drive}, {hold}: {key}\n{block}")
			corners = [[camera["skew"][i] + (camera["shift"][i] + x * camera["right"][i] + y * camera["up"][i]) / camera["image_distance"] for i in (0, 1)] + [1]
				for x, y in ((-.5, .5), (.5, .5), (.5, -.5), (-.5, -.5))]
			near(lens["corners"], corners, 1e-9, "corners")
			assert camera["other_words"] == first["other_words"] and len(first["other_words"]) > 8, (camera["other_words"], first["other_words"])
			tried += 1
	# And a render says so.
	result = subprocess.run([povray, "again.pov", "-D", "+W8", "+H6", "+Oagain.png"], capture_output=True, text=True)
	assert result.returncode == 0 and "Lens Tilt:       6.000 deg" in result.stderr, result.stderr
	print(f"{tried} blocks")


if __name__ == "__main__":
	window = browser()
	try:
		globals()[sys.argv[1]](window, *sys.argv[2:])
	finally:
		window.quit()
