// SPDX-License-Identifier: AGPL-3.0-or-later
// From what the sliders say to the lens, by the order of lens/lens_spec.cpp and with its refusals.
//
// camera (from the page's JSON): right, up (the sensor's sides at image_distance), skew (ray of its centre but for the shift),
//   sensor_is_window (its size stays when the image distance changes; else the field of view stays), location, axes (x, y, z in the world)
// settings: drive 'lens' (tilt), 'plane' (plane_tilt) or 'point' (point, normal: world), hold 'focal_length' or 'image_distance',
//   direction, inverse_distance (1/U), f_stop (Infinity: a pinhole), shift, circle. Angles in degrees, lengths in the scene's unit.

const Refuse = text => { throw new Error(text); };

const PlaneFromWorld = (camera, point, normal) => {
	if (!(ScaledLength(normal) > 0))
		Refuse('The normal must not be <0, 0, 0>.');
	const n = Normalized(normal), away = Add(point, Times(-1, camera.location));
	const m = camera.axes.map(e => Dot(e, n)), P = camera.axes.map(e => Dot(e, away));
	if (!(Math.abs(Dot(m, P)) > 1e-14 * ScaledLength(P)))
		Refuse('The plane of focus passes through the lens centre; no lens can focus there. Move the plane or the camera.');
	return PlaneThroughPoint(m, P);
};

const InverseImageDistanceFor = (q, focal_length) => {
	const power = 1 / focal_length, qxy = Math.hypot(q[0], q[1]);
	if (qxy > power)
		Refuse(`The hinge would lie ${Short(1 / qxy)} from the lens, nearer than the focal length ${Short(focal_length)}: ` +
			'tilt the plane of focus less, move it away, or shorten the focal length.');
	const inverse = InverseImageDistance(q, power);
	if (!(inverse > 0))
		Refuse(`The plane of focus passes ${Short(1 / ScaledLength(q))} from the lens centre, no farther than the focal length ${Short(focal_length)}: focus farther away.`);
	return inverse;
};

// Of the plane of focus, degrees: beyond, its distance along the axis is what numbers can no longer say.
const LARGEST_TILT = 89.99;

const SensorAndPlane = (s, camera) => {
	const holds_f = s.hold === 'focal_length', phi = s.direction * RadiansPerDegree;
	if (s.drive === 'lens') {
		const n = LensNormalFromTilt(s.tilt * RadiansPerDegree, phi);
		if (!holds_f)
			return { q: PlaneFromLensTilt(n, 1 / s.image_distance, s.inverse_distance), inverse: 1 / s.image_distance };
		const inverse = n[2] / s.focal_length - s.inverse_distance;
		if (!(inverse > 0))
			Refuse(`A lens of focal length ${Short(s.focal_length)}, tilted by ${Short(s.tilt)}°, cannot focus that near: focus farther away.`);
		return { q: PlaneFromLens(n, 1 / s.focal_length, inverse), inverse };
	}
	if (s.drive === 'plane' && !(Math.abs(s.plane_tilt) <= LARGEST_TILT))
		Refuse('A plane along the optical axis has no distance along it: state it by a point and a normal.');
	const q = s.drive === 'point' ? PlaneFromWorld(camera, s.point, s.normal)
		: PlaneAtDistance(FocalPlaneDirection(s.plane_tilt * RadiansPerDegree, phi), s.inverse_distance);
	return { q, inverse: holds_f ? InverseImageDistanceFor(q, s.focal_length) : 1 / s.image_distance };
};

// The lens, or an Error that says why there is none.
const SolveLens = (s, camera) => {
	const { q, inverse } = SensorAndPlane(s, camera);
	if (!q.every(Number.isFinite) || !Number.isFinite(inverse))
		Refuse('The plane of focus is nearer to the lens centre than numbers can say.');
	if (!(ScaledLength(LensPower(q, inverse)) > 1e-14 * inverse))
		Refuse('The plane of focus lies on the sensor; no lens normal exists.');
	const { normal, power } = LensFromPlane(q, inverse);
	const w = 1 / inverse, f = 1 / power, d = Math.abs(f) / s.f_stop;
	const scale = camera.sensor_is_window ? 1 : w / camera.image_distance;
	const side = v => v.map(x => x * scale / w);
	const right = side(camera.right), up = side(camera.up);
	const centre = [0, 1].map(i => camera.skew[i] + s.shift[i] / w);
	const corner = (x, y) => [centre[0] + x * right[0] + y * up[0], centre[1] + x * right[1] + y * up[1], 1];
	const corners = [corner(-0.5, 0.5), corner(0.5, 0.5), corner(0.5, -0.5), corner(-0.5, -0.5)];
	const tolerance = SharpnessTolerance(s.circle, w, d);
	return { q, w, f, d, normal, corners, tolerance, shift: s.shift,
		near: Add(q, [0, 0, tolerance]), far: Add(q, [0, 0, -tolerance]), sensor_right: ScaledLength([...right, 0]) * w, sensor_up: ScaledLength([...up, 0]) * w };
};

// q_xy of the plane, or null where it is parallel to the sensor.
const HingeOf = q => {
	const square = q[0] * q[0] + q[1] * q[1];
	return Math.sqrt(square) > 1e-9 * Math.abs(q[2]) && square > 0 ? [q[0] / square, q[1] / square, 0] : null;
};

// Foot, nearest to the axis, of the line in which lens, sensor and plane of focus meet (Scheimpflug), or null.
const ScheimpflugOf = lens => {
	const [x, y, z] = lens.normal, square = x * x + y * y;
	return HingeOf(lens.q) && square > 0 ? [x * z * lens.w / square, y * z * lens.w / square, -lens.w] : null;
};

// The part of a convex polygon of directions where value(v) is at least `least`.
const Clip = (polygon, value, least) => {
	const out = [];
	polygon.forEach((a, i) => {
		const b = polygon[(i + 1) % polygon.length], at_a = value(a) - least, at_b = value(b) - least;
		if (at_a >= 0)
			out.push(a);
		if ((at_a >= 0) !== (at_b >= 0))
			out.push(Add(a, Times(at_a / (at_a - at_b), Add(b, Times(-1, a)))));
	});
	return out;
};

const AreaOf = polygon => Math.abs(polygon.reduce((sum, a, i) => {
	const b = polygon[(i + 1) % polygon.length];
	return sum + a[0] * b[1] - a[1] * b[0];
}, 0)) / 2;

// Shares of the picture: `front` is in focus somewhere in front of the lens, `far` sharp to infinity, `empty` has no ray.
const SharesOf = lens => {
	const all = AreaOf(lens.corners), part = polygon => AreaOf(polygon) / all;
	const seen = Clip(lens.corners, v => Dot(lens.normal, v), 0);
	const endless = Clip(Clip(lens.corners, v => Dot(lens.near, v), 0), v => -Dot(lens.far, v), 0);
	return { front: part(Clip(seen, v => Dot(lens.q, v), 0)), endless: part(endless), empty: 1 - part(seen) };
};

// The other ways of stating the same lens; what drives keeps its own numbers.
const Follow = (s, lens, camera) => {
	const tilt = HingeOf(lens.q) !== null;
	if (s.drive === 'point' && tilt)
		s.direction = TiltDirection(lens.normal) * DegreesPerRadian;
	// The same tilt towards the direction that is set already, where it is that one or its opposite.
	const sign = Math.cos(TiltDirection(lens.normal) - s.direction * RadiansPerDegree) < 0 ? -1 : 1;
	const q = lens.q[2] < 0 ? Times(-1, lens.q) : lens.q;
	if (s.drive !== 'lens')
		s.tilt = tilt ? sign * AngleFromAxis(lens.normal) * DegreesPerRadian : 0;
	if (s.drive !== 'plane') {
		const toward = Math.cos(TiltDirection(q) - s.direction * RadiansPerDegree) < 0 ? -1 : 1;
		s.plane_tilt = tilt ? toward * AngleFromAxis(q) * DegreesPerRadian : 0;
	}
	if (s.drive === 'point')
		s.inverse_distance = lens.q[2];
	else {
		const length = ScaledLength(lens.q), n = length > 0 ? Times(1 / length, lens.q) : [0, 0, 1];
		const world = v => [0, 1, 2].map(i => v[0] * camera.axes[0][i] + v[1] * camera.axes[1][i] + v[2] * camera.axes[2][i]);
		// What is nothing but rounding is written as 0.
		s.normal = world(n).map(x => (Math.abs(x) < 1e-14 ? 0 : x));
		s.point = Add(camera.location, world(Times(1 / Math.max(length, 1e-30), n)));
	}
	if (s.hold !== 'focal_length')
		s.focal_length = lens.f;
	if (s.hold !== 'image_distance')
		s.image_distance = lens.w;
};
