// SPDX-License-Identifier: AGPL-3.0-or-later
// What the lens does, in numbers and in words.

const Angle = x => Short(x) + '°';

// Rows of [name, value].
const NumbersOf = (lens, camera, s) => {
	const length = x => Short(x) + (Number.isFinite(x) && camera.unit ? ' ' + camera.unit : '');
	const hinge = HingeOf(lens.q), meet = ScheimpflugOf(lens), q = lens.q[2] < 0 ? Times(-1, lens.q) : lens.q;
	const at = inverse => length(inverse > 0 ? 1 / inverse : Infinity);
	const [x, y] = [lens.normal[0], lens.normal[1]].map(c => c / lens.normal[2] * lens.w);
	const circle = Math.max(...lens.corners.map(v => Math.hypot(v[0] * lens.w - x, v[1] * lens.w - y)));
	const rows = [
		['Lens tilt', Angle(AngleFromAxis(lens.normal) * DegreesPerRadian)],
		['Plane of focus to the sensor', ScaledLength(lens.q) > 0 ? Angle(AngleFromAxis(q) * DegreesPerRadian) + (hinge ? `, recedes towards ${Angle(TiltDirection(q) * DegreesPerRadian)}` : '') : '–'],
		['Focus on the axis', Math.abs(lens.q[2]) > 1e-12 * ScaledLength(lens.q) ? length(1 / lens.q[2]) : '∞'],
		['Focal length', length(lens.f)], ['Image distance', length(lens.w)],
		['Aperture', lens.d > 0 ? `${length(lens.d)} (f/${Short(Math.abs(lens.f) / lens.d)})` : '0: a pinhole'],
		['Hinge', hinge ? length(ScaledLength(hinge)) + ' from the lens' : 'none'],
		['Lens, sensor, plane meet', meet ? length(Math.hypot(meet[0], meet[1])) + ' beside the sensor’s axis' : 'nowhere'],
		['Image circle needed', length(2 * circle) + ' across'] ];
	if (lens.d > 0) {
		rows.push(['Sharp on the axis', lens.near[2] > 0 ? `${at(lens.near[2])} to ${at(lens.far[2])}` : 'nothing']);
		if (!hinge && lens.f > 0)
			rows.push(['Hyperfocal distance', length(lens.f + lens.f * lens.f / (Math.abs(lens.f) / lens.d * s.circle))]);
	}
	return rows;
};

// Sentences on what is not ordinary.
const RemarksOn = (lens, camera) => {
	const out = [], shares = SharesOf(lens), percent = x => (x > 0.995 && x < 1 ? '>99' : x < 0.005 ? '<1' : Math.round(100 * x)) + ' %';
	const hinge = HingeOf(lens.q), size = ScaledLength(lens.q);
	if (size === 0)
		out.push('The plane of focus lies at infinity.');
	else if (Math.abs(lens.q[2]) <= 1e-12 * size)
		out.push('The plane of focus is parallel to the axis: it never meets it.');
	else if (lens.q[2] < 0)
		out.push('On the axis the focus lies behind the lens, beyond infinity.');
	if (!hinge && lens.d > 0 && size > 0)
		out.push('The lens is not tilted: the limits of sharpness are parallel to the sensor.');
	if (shares.front === 0)
		out.push('Nowhere in the picture is the focus in front of the lens.');
	else if (shares.front < 1 - 1e-9)
		out.push(`In ${percent(1 - shares.front)} of the picture the focus is not in front of the lens but at infinity or behind it.`);
	if (shares.empty > 1e-9)
		out.push(`${percent(shares.empty)} of the picture looks along or behind the lens plane: those pixels stay empty.`);
	if (!(lens.d > 0))
		out.push('The aperture is 0: a pinhole, everything is sharp.');
	else if (shares.endless > 1e-9)
		out.push(`In ${percent(shares.endless)} of the picture what is sharp reaches to infinity.`);
	if (lens.power < 0 || lens.f < 0)
		out.push('Such a lens diverges: its focal length is negative. No photographic lens does this; POV-Ray renders it.');
	if (camera.field_curvature)
		out.push('This lens has field curvature: the plane touches its bowl of focus on the lens axis. Drawn are the plane and its limits.');
	return out;
};
