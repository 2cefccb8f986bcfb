// SPDX-License-Identifier: AGPL-3.0-or-later
// One live sketch in every element of class "plane": reads its lens, makes the controls, keeps all in step.

const Rows = [
	// name, label, unit ('length': the scene's), when it is shown, slider position -> value and back
	{ name: 'focal_length', label: 'Focal length', unit: 'length', shown: s => s.hold === 'focal_length', log: [0.25, 4] },
	{ name: 'image_distance', label: 'Image distance', unit: 'length', shown: s => s.hold === 'image_distance', log: [0.25, 4] },
	{ name: 'tilt', label: 'Lens tilt', unit: '°', shown: s => s.drive === 'lens', range: [-20, 20], limit: 89.9 },
	{ name: 'plane_tilt', label: 'Tilt of the plane', unit: '°', shown: s => s.drive === 'plane', range: [-89.9, 89.9], limit: LARGEST_TILT },
	{ name: 'direction', label: 'Recedes towards', unit: '° (0 is up)', shown: s => s.drive !== 'point', range: [-180, 180], limit: 1e6 },
	{ name: 'inverse_distance', label: 'Focus distance', unit: 'length', shown: s => s.drive !== 'point', inverse: true },
	{ name: 'f_stop', label: 'Aperture f/', unit: '', shown: () => true, log: [0.7, 64], absolute: true },
	{ name: 'circle', label: 'Circle of confusion', unit: 'length', shown: () => true, log: [0.1, 10] },
	{ name: 'shift_x', label: 'Shift right', unit: 'length', shown: () => true, shift: 0 },
	{ name: 'shift_y', label: 'Shift up', unit: 'length', shown: () => true, shift: 1 } ];

// A number of a field; "inf", "∞" count, NaN is none.
const ParseNumber = text => {
	const plain = text.trim().replace('−', '-').replace(',', '.');
	if (/^[-+]?(inf(inity)?|∞)$/i.test(plain))
		return plain[0] === '-' ? -Infinity : Infinity;
	return plain === '' ? NaN : Number(plain);
};

const FieldText = x => (x === Infinity ? '∞' : x === -Infinity ? '−∞' : String(Number(x.toPrecision(6))));

class PlanePage {
	constructor(root, number) {
		this.root = root;
		this.camera = JSON.parse(root.querySelector('script').textContent);
		this.id = `plane${number}-`;
		this.settings = this.Initial();
		this.first = JSON.stringify(this.settings);
		this.Build();
		this.Update();
		this.far = this.camera.far || this.FarOf(this.lens);
		this.sketch.Show(this.lens, this.far);
		root.classList.add('live');
	}

	Initial() {
		const c = this.camera, lens = LensFromPlane(c.inverse_focus, 1 / c.image_distance), f = 1 / lens.power, phi = TiltDirection(lens.normal) * DegreesPerRadian;
		const s = { drive: c.drive, hold: f > 0 ? c.hold : 'image_distance', focal_length: f, image_distance: c.image_distance, tilt: AngleFromAxis(lens.normal) * DegreesPerRadian, plane_tilt: 0,
			direction: HingeOf(c.inverse_focus) ? phi : 0, inverse_distance: c.inverse_focus[2], point: [0, 0, 0], normal: [0, 0, 1],
			f_stop: c.aperture_diameter > 0 ? Math.abs(f) / c.aperture_diameter : Infinity, circle: Math.hypot(...c.right, ...c.up) / 1500, shift: [...c.shift] };
		// The one way of stating it that was asked for begins like the others.
		const whole = { q: c.inverse_focus, w: c.image_distance, f, normal: lens.normal };
		const all = { ...s, drive: 'none' };
		Follow(all, whole, c);
		return { ...all, drive: c.drive, hold: s.hold };
	}

	// Farther, where the plane of focus has left the sketch; not nearer, so that it does not jump.
	Reach() {
		const U = 1 / this.lens.q[2];
		if (this.far && U > 0.9 * this.far)
			this.far = Math.max(this.far, this.FarOf(this.lens));
	}

	// How far the sketch reaches.
	FarOf(lens) {
		const U = 1 / lens.q[2], hinge = HingeOf(lens.q);
		if (U > 0 && U < 1e4 * lens.w)
			return Math.max(1.9 * U, 3 * lens.w);
		return hinge ? Math.min(6 * ScaledLength(hinge), 1e4 * lens.w) : 40 * lens.w;
	}

	Field(row) {
		const unit = row.unit === 'length' ? this.camera.unit : row.unit, id = this.id + row.name;
		return `<div class="row" data-row="${row.name}"><label for="${id}">${row.label}</label><input type="range" id="${id}-slide" min="0" max="1" step="any" aria-label="${row.label}, slider"/>` +
			`<span class="value"><input type="text" inputmode="text" autocomplete="off" id="${id}" size="9"/> <span class="unit">${unit}</span></span></div>`;
	}

	Build() {
		const radio = (name, value, text) => `<label><input type="radio" name="${this.id}${name}" value="${value}"/> ${text}</label>`;
		const vector = (name, text) => `<div class="row vector" data-row="${name}"><span>${text}</span><span class="value">${['x', 'y', 'z'].map((axis, i) =>
			`<input type="text" autocomplete="off" size="7" id="${this.id}${name}${i}" aria-label="${text}, ${axis}"/>`).join(' ')}</span></div>`;
		const live = document.createElement('div');
		live.className = 'live-part';
		live.innerHTML = `<div class="stage"><div class="views" role="group" aria-label="View">${['oblique', 'side', 'top', 'behind', 'camera'].map(name =>
			`<button type="button" data-view="${name}">${name[0].toUpperCase() + name.slice(1)}</button>`).join('')}<button type="button" data-zoom="1.4" aria-label="Zoom in">+</button><button type="button" data-zoom="0.7" aria-label="Zoom out">−</button></div>` +
			`<svg class="turn" tabindex="0" role="img" aria-label="Camera, lens and plane of focus. Arrow keys turn, plus and minus zoom, 0 resets."></svg>` +
			'<p class="hint">Drag to turn, wheel or two fingers to zoom, shift-drag to move; arrow keys, +, − and 0 when the sketch has the focus.</p></div>' +
			`<form class="controls"><fieldset><legend>The plane is stated by</legend>${radio('drive', 'lens', 'tilt of the lens')}${radio('drive', 'plane', 'tilt of the plane')}${radio('drive', 'point', 'a point and a normal')}</fieldset>` +
			`<fieldset><legend>What stays</legend>${radio('hold', 'focal_length', 'focal length, the sensor moves')}${radio('hold', 'image_distance', 'image distance, the lens follows')}</fieldset>` +
			`${vector('point', 'Point of the plane')}${vector('normal', 'Normal of the plane')}${Rows.map(row => this.Field(row)).join('')}<p class="pixels"></p>` +
			'<p><button type="button" class="reset">Back to the beginning</button></p></form>' +
			`<div class="result"><p class="refusal" role="alert" hidden="hidden"></p><table class="numbers"></table><ul class="remarks" aria-live="polite"></ul>` +
			`<p class="copy-row"><label for="${this.id}block">To copy into the camera</label> <button type="button" class="copy">Copy</button> <span class="said" role="status"></span></p><textarea class="block" id="${this.id}block" readonly="readonly" spellcheck="false" rows="8"></textarea></div>`;
		this.root.append(live);
		this.live = live;
		this.Find = selector => live.querySelector(selector);
		this.sketch = new Sketch(this.Find('svg'), this.camera, sketch => { this.root.dataset.view = [sketch.azimuth, sketch.elevation, sketch.zoom].map(x => x.toFixed(4)).join(' '); });
		this.Connect();
	}

	Connect() {
		const s = () => this.settings;
		this.live.querySelectorAll('[data-view]').forEach(button => button.addEventListener('click', () => {
			this.far = Math.max(this.FarOf(this.lens), this.camera.far || 0);
			this.sketch.far = this.far;
			this.sketch.Look(button.dataset.view);
		}));
		this.live.querySelectorAll('[data-zoom]').forEach(button => button.addEventListener('click', () => this.sketch.Zoom(Number(button.dataset.zoom))));
		this.live.querySelectorAll('[type=radio]').forEach(radio => radio.addEventListener('change', () => {
			s()[radio.name.slice(this.id.length)] = radio.value;
			this.Update();
		}));
		for (const row of Rows) {
			const [slide, field] = [this.Slide(row), this.TextOf(row.name)];
			slide.addEventListener('input', () => this.Set(row, this.FromSlide(row, Number(slide.value)), slide));
			field.addEventListener('input', () => {
				const typed = ParseNumber(field.value), value = row.inverse ? 1 / typed : typed;
				this.Set(row, value, field);
			});
			field.addEventListener('blur', () => this.Update());
		}
		for (const name of ['point', 'normal'])
			[0, 1, 2].forEach(i => this.TextOf(name + i).addEventListener('input', event => {
				const value = ParseNumber(event.target.value), good = Number.isFinite(value);
				event.target.setAttribute('aria-invalid', String(!good));
				if (good) {
					s()[name][i] = value;
					this.Update(event.target);
				}
			}));
		this.Find('form').addEventListener('submit', event => event.preventDefault());
		this.Find('.reset').addEventListener('click', () => {
			this.settings = JSON.parse(this.first, (key, value) => (key === 'f_stop' && value === null ? Infinity : value));
			this.far = 0;
			this.Update();
			this.far = this.camera.far || this.FarOf(this.lens);
			this.sketch.Show(this.lens, this.far);
		});
		this.Find('.copy').addEventListener('click', () => this.Copy());
	}

	Slide(row) { return this.Find(`#${this.id}${row.name}-slide`); }
	TextOf(name) { return this.Find(`#${this.id}${name}`); }

	ValueOf(row) { return row.shift !== undefined ? this.settings.shift[row.shift] : this.settings[row.name]; }

	// The numbers at the slider's ends, from what the page began with: a slider does not run away.
	Ends(row) {
		const start = this.start || (this.start = JSON.parse(this.first)), c = this.camera;
		if (row.range)
			return row.range;
		if (row.shift !== undefined) {
			const most = Math.max(Math.hypot(...c.right, ...c.up) / 2, Math.abs(start.shift[row.shift]));
			return [-most, most];
		}
		if (row.inverse)
			return [-0.25, Math.max(3 * Math.abs(start.inverse_distance), 0.4 / c.image_distance)];
		return row.absolute ? row.log : row.log.map(x => x * Math.abs(start[row.name]));
	}

	FromSlide(row, t) {
		const [low, high] = this.Ends(row);
		if (row.inverse) {
			// Evenly in the root of 1/distance, a little beyond infinity too.
			const u = low + (1 - low) * t, rounded = Math.abs(u) < 0.004 ? 0 : u;
			return high * rounded * Math.abs(rounded);
		}
		const value = row.log ? low * (high / low) ** t : low + (high - low) * t;
		return Number(value.toPrecision(row.log ? 4 : 3 + (Math.abs(value) >= 100 ? 1 : 0)));
	}

	ToSlide(row, value) {
		const [low, high] = this.Ends(row);
		if (row.inverse)
			return (Math.sign(value) * Math.sqrt(Math.abs(value) / high) - low) / (1 - low);
		return row.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
	}

	// A number from a slider or a field; what cannot be a number of its kind is marked and changes nothing.
	Set(row, value, source) {
		const positive = row.log !== undefined, finite = row.name !== 'f_stop';
		const good = !Number.isNaN(value) && (!finite || Number.isFinite(value)) && (!positive || value > 0) && !(row.limit && Math.abs(value) > row.limit);
		source.setAttribute('aria-invalid', String(!good));
		if (!good)
			return;
		if (row.shift !== undefined)
			this.settings.shift[row.shift] = value;
		else
			this.settings[row.name] = value;
		this.Update(source);
	}

	// Everything from the settings; `source` is being typed into and keeps its text.
	Update(source) {
		const s = this.settings, c = this.camera;
		let refusal = '';
		try {
			this.lens = SolveLens(s, c);
			Follow(s, this.lens, c);
		} catch (error) {
			refusal = error.message;
		}
		this.refusal = refusal;
		this.ShowControls(source);
		this.Find('.refusal').hidden = !refusal;
		this.Find('.refusal').textContent = refusal && `No lens does this. ${refusal} The sketch shows the last lens that there was.`;
		this.Find('.copy').disabled = Boolean(refusal);
		this.Find('.block').value = refusal ? `// ${refusal}\n` : BlockText(s, c);
		this.Find('.block').rows = Math.min(14, this.Find('.block').value.split('\n').length + 1);
		this.Find('.said').textContent = '';
		if (!this.lens)
			return;
		this.Reach();
		const beyond = 1 / this.lens.q[2] > this.far ? ['On the axis the plane of focus lies beyond what is drawn.'] : [];
		this.Find('.remarks').innerHTML = [...RemarksOn(this.lens, c), ...beyond].map(text => `<li>${Escaped(text)}</li>`).join('');
		this.Find('.numbers').innerHTML = NumbersOf(this.lens, c, s).map(([name, value]) => `<tr><th scope="row">${Escaped(name)}</th><td>${Escaped(value)}</td></tr>`).join('');
		const pixel = Math.hypot(...c.right) * (c.sensor_is_window ? 1 : this.lens.w / c.image_distance) / c.pixels[0];
		this.Find('.pixels').textContent = c.pixels[0] > 0 ? `The circle of confusion is ${Short(s.circle / pixel)} pixels of a picture ${c.pixels[0]} wide.` : '';
		if (this.far)
			this.sketch.Show(this.lens, this.far);
	}

	ShowControls(source) {
		const s = this.settings;
		for (const name of ['drive', 'hold'])
			this.live.querySelectorAll(`[name=${this.id}${name}]`).forEach(radio => { radio.checked = radio.value === s[name]; });
		for (const name of ['point', 'normal']) {
			this.Find(`[data-row=${name}]`).hidden = s.drive !== 'point';
			[0, 1, 2].forEach(i => { if (this.TextOf(name + i) !== source) this.TextOf(name + i).value = FieldText(s[name][i]); });
		}
		for (const row of Rows) {
			const value = this.ValueOf(row), field = this.TextOf(row.name), slide = this.Slide(row);
			this.Find(`[data-row=${row.name}]`).hidden = !row.shown(s);
			if (field !== source) {
				field.value = FieldText(row.inverse ? 1 / value : value);
				field.setAttribute('aria-invalid', 'false');
			}
			if (slide !== source)
				slide.value = Math.max(0, Math.min(1, this.ToSlide(row, value)));
			slide.setAttribute('aria-valuetext', `${field.value} ${this.Find(`[data-row=${row.name}] .unit`).textContent}`);
		}
	}

	// The clipboard, or where there is none the selection.
	async Copy() {
		const block = this.Find('.block'), said = this.Find('.said');
		try {
			await navigator.clipboard.writeText(block.value);
			said.textContent = 'Copied.';
		} catch (error) {
			block.select();
			said.textContent = document.execCommand('copy') ? 'Copied.' : 'Selected: press Ctrl+C.';
		}
	}
}

const Pages = [...document.querySelectorAll('.plane')].map((root, i) => new PlanePage(root, i));
// A page that loads itself again (tiltcal calibrate --watch) leaves sketches as they were turned.
const KeepViews = () => {
	const name = `tilt-lens views ${location.pathname}`, kept = JSON.parse(sessionStorage.getItem(name) || '[]');
	Pages.forEach((page, i) => { if (kept[i]) page.sketch.Take(kept[i]); });
	window.addEventListener('pagehide', () => sessionStorage.setItem(name, JSON.stringify(Pages.map(page => page.sketch.View()))));
};
if (document.querySelector('meta[http-equiv=refresh]'))
	try {
		KeepViews();
	} catch (error) {
		// Some browsers keep nothing for files.
	}

// For the tests.
window.PlanePages = { pages: Pages, optics: { InverseFocusDistance, RayDirection, FocalPlaneDirection, PlaneAtDistance, PlaneThroughPoint, LensNormalFromTilt, LensFromPlane,
	PlaneFromLens, PlaneFromLensTilt, InverseImageDistance, SignedBlurWidth, AngleFromAxis, TiltDirection, BasisOfLensPlane }, SolveLens, HingeOf, SharpnessTolerance };
