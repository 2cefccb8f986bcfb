// SPDX-License-Identifier: AGPL-3.0-or-later
// The sketch: an orthographic view that can be turned, drawn as SVG.

const Escaped = text => String(text).replace(/[&<>"']/g, c => `&#${c.charCodeAt(0)};`);

// Three digits and a bit, for people.
const Short = x => {
	if (!Number.isFinite(x))
		return Number.isNaN(x) ? '–' : x > 0 ? '∞' : '−∞';
	const size = Math.abs(x), digits = size === 0 ? 0 : Math.max(0, Math.min(8, 3 - Math.floor(Math.log10(size))));
	const text = size >= 1e6 || (size > 0 && size < 1e-5) ? size.toPrecision(4) : String(Number(size.toFixed(digits)));
	return x < 0 && Number(text) !== 0 ? '−' + text : text;
};

// The page's axes for a view from the right (azimuth 0), turned back behind the camera by azimuth and up by elevation; `roll` is the
// azimuth in the sensor plane that stands for up: with that of the tilt, the first view is along the hinge.
const ViewAxes = ({ azimuth, elevation, roll }) => {
	const up = [Math.sin(roll), Math.cos(roll), 0], x = [Math.cos(roll), -Math.sin(roll), 0], z = [0, 0, 1];
	const away = Add(Times(-Math.cos(azimuth), x), Times(Math.sin(azimuth), z));
	return { right: Add(Times(Math.sin(azimuth), x), Times(Math.cos(azimuth), z)), up: Add(Times(Math.cos(elevation), up), Times(Math.sin(elevation), away)) };
};

const NiceNumber = x => {
	const power = 10 ** Math.floor(Math.log10(x)), digit = x / power;
	return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
};

// Shapes of the scene in the camera's frame, drawn to the depth `far`.
const ShapesOf = (lens, camera, far) => {
	const at = (v, q) => Times(1 / Math.max(Dot(q, v), 1 / far), v);
	const patch = q => Clip(lens.corners, v => Dot(q, v), 1 / far).map(v => at(v, q));
	const steps = 12, walls = [];
	lens.corners.forEach((a, i) => {
		const b = lens.corners[(i + 1) % 4];
		const side = Array.from({ length: steps + 1 }, (_, k) => Add(a, Times(k / steps, Add(b, Times(-1, a)))));
		// Only where something is sharp no farther than it is drawn.
		const shown = side.filter(v => Dot(lens.near, v) >= 1 / far);
		if (shown.length > 1)
			walls.push([...shown.map(v => at(v, lens.near)), ...shown.reverse().map(v => at(v, lens.far))]);
	});
	const basis = BasisOfLensPlane(lens.normal);
	const disc = radius => Array.from({ length: 48 }, (_, k) => Add(Times(radius * Math.cos(k * Math.PI / 24), basis.a), Times(radius * Math.sin(k * Math.PI / 24), basis.b)));
	const sensor = lens.corners.map(v => Times(-lens.w, v));
	const foot = Times(-lens.w / lens.normal[2], lens.normal);
	const circle = Math.max(...sensor.map(P => ScaledLength(Add(P, Times(-1, foot)))));
	const image = Array.from({ length: 64 }, (_, k) => Add(foot, [circle * Math.cos(k * Math.PI / 32), circle * Math.sin(k * Math.PI / 32), 0]));
	return { frustum: lens.corners.map(v => Times(far, v)), plane: patch(lens.q), near: patch(lens.near), beyond: patch(lens.far), walls, sensor, image, circle,
		aperture: disc(Math.max(lens.d / 2, 0)), mount: disc(Math.max(0.6 * lens.d, 0.35 * Math.hypot(lens.sensor_right, lens.sensor_up))),
		hinge: HingeOf(lens.q), meet: ScheimpflugOf(lens), boards: camera.boards };
};

class Sketch {
	constructor(svg, camera, onTurn) {
		this.svg = svg;
		this.camera = camera;
		this.onTurn = onTurn;
		this.Look('oblique');
		this.Listen();
	}

	// side, top, oblique, camera; the first one along the hinge.
	Look(name) {
		const tilt = this.lens && HingeOf(this.lens.q) ? TiltDirection(this.lens.normal) : 0;
		const views = { side: [0, 0, tilt], top: [0, Math.PI / 2, 0], oblique: [0.66, 0.42, 0], camera: [0, 0, tilt], behind: [Math.PI / 2, 0, 0] };
		const [azimuth, elevation, roll] = views[name];
		Object.assign(this, { azimuth, elevation, roll, zoom: 1, pan: [0, 0], close: name === 'camera' });
		this.Draw();
	}

	// How it is turned, to be taken again.
	View() {
		const { azimuth, elevation, roll, zoom, pan, close } = this;
		return { azimuth, elevation, roll, zoom, pan, close };
	}

	Take(view) {
		Object.assign(this, view);
		this.Draw();
	}

	Show(lens, far) {
		this.lens = lens;
		this.far = far;
		this.Draw();
	}

	// What has to be on the page, and no more.
	Extent(shapes) {
		if (this.close)
			return [...shapes.sensor, ...shapes.mount, Times(0.8 * this.lens.w, [0, 0, 1]), Times(-1.15 * this.lens.w, [0, 0, 1])];
		const points = [...shapes.frustum, ...shapes.sensor, [0, 0, 0], ...shapes.boards.flatMap(board => board.outline)];
		if (shapes.hinge && ScaledLength(shapes.hinge) < 1.2 * this.far)
			points.push(shapes.hinge);
		return points;
	}

	Project() {
		const { right, up } = ViewAxes(this), shapes = this.shapes;
		const flat = this.Extent(shapes).map(P => [Dot(P, right), Dot(P, up)]);
		const low = [0, 1].map(i => Math.min(...flat.map(p => p[i]))), high = [0, 1].map(i => Math.max(...flat.map(p => p[i])));
		const room = [this.width - 60, this.height - 70];
		const fit = Math.min(...[0, 1].map(i => room[i] / Math.max(high[i] - low[i], 1e-9 * this.far)));
		this.scale = fit * this.zoom;
		const x0 = this.width / 2 + this.pan[0], y0 = this.height / 2 + this.pan[1];
		const middle = [0, 1].map(i => (low[i] + high[i]) / 2);
		return P => [x0 + this.scale * (Dot(P, right) - middle[0]), y0 - this.scale * (Dot(P, up) - middle[1])];
	}

	Draw() {
		if (!this.lens)
			return;
		this.width = Math.max(this.svg.clientWidth, 260);
		this.height = Math.max(this.svg.clientHeight, 240);
		this.shapes = ShapesOf(this.lens, this.camera, this.far);
		this.page = this.Project();
		this.labels = [];
		this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
		this.svg.innerHTML = this.Scene() + this.Camera() + this.Lines() + this.ScaleBar() + this.labels.map(label => label.text).join('');
		this.onTurn(this);
	}

	Path(points, style, closed = true) {
		if (points.length < 2)
			return '';
		// Far outside nothing is seen, and numbers stay small.
		const text = points.map(P => this.page(P).map(x => Math.max(-1e5, Math.min(1e5, x)).toFixed(1)).join(' ')).join('L');
		return `<path class="${style}" d="M${text}${closed ? 'Z' : ''}"/>`;
	}

	// Where it covers no other label and is in the picture: else not at all, but for those that must be.
	Label(P, text, style, must = false) {
		const [x, y] = this.page(P), wide = 6.6 * text.length + 4;
		if (!(x > -20 && x < this.width + 20 && y > -10 && y < this.height + 10))
			return;
		for (const [dx, dy] of [[8, -8], [8, 16], [-wide - 8, -8], [-wide - 8, 16], [8, -24], [8, 32], [-wide / 2, -40], [-wide / 2, 48]]) {
			const left = Math.min(Math.max(x + dx, 4), this.width - wide), base = y + dy;
			const box = [left, base - 12, left + wide, base + 3];
			const free = base > 14 && base < this.height - 24 && !this.labels.some(o => box[0] < o.box[2] && o.box[0] < box[2] && box[1] < o.box[3] && o.box[1] < box[3]);
			if (free) {
				this.labels.push({ box, text: `<text class="${style}" x="${left.toFixed(1)}" y="${base.toFixed(1)}">${Escaped(text)}</text>` });
				return;
			}
		}
		if (must)
			this.labels.push({ box: [0, 0, 0, 0], text: `<text class="${style}" x="${Math.max(x + 8, 4).toFixed(1)}" y="${(y - 8).toFixed(1)}">${Escaped(text)}</text>` });
	}

	Scene() {
		const { frustum, plane, near, beyond, walls, boards } = this.shapes, sharp = this.lens.tolerance > 0 && Number.isFinite(this.lens.tolerance);
		let out = '';
		frustum.forEach((P, i) => { out += this.Path([[0, 0, 0], P, frustum[(i + 1) % 4]], 'frustum'); });
		out += this.Path([Times(-1.3 * this.lens.w, [0, 0, 1]), [0, 0, this.far]], 'axis', false);
		boards.forEach(board => {
			out += this.Path(board.outline, 'board').replace('/>', ` style="stroke:${board.colour};fill:${board.colour}"/>`);
		});
		if (sharp)
			out += walls.map(wall => this.Path(wall, 'wedge')).join('') + this.Path(beyond, 'limit far') + this.Path(near, 'limit near');
		out += this.Path(plane, 'focus');
		// Boards' numbers, each at another corner.
		boards.forEach((board, i) => this.Label(board.outline[i % 4], board.name, 'number'));
		return out;
	}

	Camera() {
		const { sensor, image, aperture, mount } = this.shapes;
		return this.Path(image, 'circle') + this.Path(sensor, 'sensor') + this.Path(mount, 'mount') + this.Path(aperture, 'aperture');
	}

	Lines() {
		const { hinge, meet, plane, near, beyond, sensor, mount } = this.shapes, lens = this.lens, unit = this.camera.unit;
		const length = x => Short(x) + (unit ? ' ' + unit : '');
		const reach = 3 * this.far;
		let out = '';
		const middle = polygon => Times(1 / polygon.length, polygon.reduce(Add));
		const U = 1 / lens.q[2];
		if (U > 0 && U < this.far) {
			out += this.Path([[0, 0, 0], [0, 0, U]], 'distance', false);
			this.Label([0, 0, U], 'U = ' + length(U), 'strong', true);
		}
		if (hinge && ScaledLength(hinge) < reach) {
			const along = Normalized(Cross(hinge, [0, 0, 1])), half = Math.max(2 * lens.w, ...plane.map(P => Math.abs(Dot(P, along))));
			out += this.Path([Add(hinge, Times(-half, along)), Add(hinge, Times(half, along))], 'hinge', false);
			// The plane of focus from the hinge to the picture.
			plane.forEach(P => { out += this.Path([Add(hinge, Times(Dot(P, along), along)), P], 'extension', false); });
			if (meet && ScaledLength(meet) < reach) {
				out += this.Path([[0, 0, 0], meet], 'extension lens', false) + this.Path([[0, 0, -lens.w], meet], 'extension', false) + this.Path([hinge, meet], 'extension', false);
				this.Label(meet, 'lens, sensor and plane meet', 'small');
			}
			this.Label(hinge, `hinge, ${length(ScaledLength(hinge))} from the lens`, 'strong', true);
		}
		this.Label(sensor[0], 'sensor', 'plain');
		this.Label(mount[0], hinge ? `lens, tilted ${Short(AngleFromAxis(lens.normal) * DegreesPerRadian)}°` : 'lens', 'lens', true);
		if (this.scale * lens.w > 50)
			this.Label(Times(-lens.w / 2, [0, 0, 1]), 'w = ' + length(lens.w), 'plain');
		if (plane.length)
			this.Label(plane[plane.length > 2 ? 1 : 0], 'plane of focus', 'blue');
		if (near.length && lens.tolerance > 0 && Number.isFinite(lens.tolerance)) {
			this.Label(middle(near.slice(0, 2)), 'sharp from here', 'green');
			if (beyond.length)
				this.Label(middle(beyond.slice(0, 2)), 'to here', 'green');
		}
		return out;
	}

	ScaleBar() {
		const real = NiceNumber(110 / this.scale), long = real * this.scale, y = this.height - 16;
		return `<path class="scale" d="M14 ${y - 6}v6h${long.toFixed(1)}v-6"/><text x="${(20 + long).toFixed(1)}" y="${y}">${Short(real)} ${this.camera.unit || 'units'}</text>`;
	}

	Turn(across, down) {
		this.azimuth += across;
		this.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.elevation + down));
		this.Draw();
	}

	// About a point of the page, which stays where it is.
	Zoom(factor, x = this.width / 2, y = this.height / 2) {
		const zoom = Math.max(0.1, Math.min(2000, this.zoom * factor)), by = zoom / this.zoom;
		this.pan = [x - this.width / 2 - by * (x - this.width / 2 - this.pan[0]), y - this.height / 2 - by * (y - this.height / 2 - this.pan[1])];
		this.zoom = zoom;
		this.Draw();
	}

	Move(x, y) {
		this.pan = [this.pan[0] + x, this.pan[1] + y];
		this.Draw();
	}

	// One finger or button turns, two fingers zoom and move, shift or the right button moves.
	Listen() {
		const svg = this.svg, fingers = new Map();
		const place = event => {
			const box = svg.getBoundingClientRect();
			return [event.clientX - box.left, event.clientY - box.top];
		};
		svg.addEventListener('pointerdown', event => {
			svg.setPointerCapture(event.pointerId);
			fingers.set(event.pointerId, place(event));
		});
		svg.addEventListener('pointermove', event => {
			if (!fingers.has(event.pointerId))
				return;
			const before = fingers.get(event.pointerId), now = place(event), dx = now[0] - before[0], dy = now[1] - before[1];
			const other = [...fingers.entries()].filter(([id]) => id !== event.pointerId).map(([, at]) => at)[0];
			fingers.set(event.pointerId, now);
			if (other) {
				const apart = p => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
				this.Zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
				this.Move(dx / 2, dy / 2);
			} else if (event.shiftKey || event.buttons === 2)
				this.Move(dx, dy);
			else
				this.Turn(-dx / 150, dy / 150);
		});
		for (const name of ['pointerup', 'pointercancel'])
			svg.addEventListener(name, event => fingers.delete(event.pointerId));
		svg.addEventListener('contextmenu', event => event.preventDefault());
		svg.addEventListener('wheel', event => {
			event.preventDefault();
			this.Zoom(Math.exp(-event.deltaY / 400), ...place(event));
		}, { passive: false });
		svg.addEventListener('keydown', event => {
			const keys = { ArrowLeft: () => this.Turn(0.1, 0), ArrowRight: () => this.Turn(-0.1, 0), ArrowUp: () => this.Turn(0, -0.1), ArrowDown: () => this.Turn(0, 0.1),
				'+': () => this.Zoom(1.25), '=': () => this.Zoom(1.25), '-': () => this.Zoom(0.8), 0: () => this.Look('oblique') };
			if (keys[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
				event.preventDefault();
				keys[event.key]();
			}
		});
		new ResizeObserver(() => this.Draw()).observe(svg);
	}
}
