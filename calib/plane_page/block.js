// SPDX-License-Identifier: AGPL-3.0-or-later
// The tilt_lens block that says what the sliders say, in the words of the scene language.

// Ten digits: POV-Ray reads the same lens, to 1e-9 or so.
const Exact = x => String(Number(Number.isFinite(x) ? x.toPrecision(10) : x > 0 ? 1e30 : -1e30));
const ExactVector = v => '<' + v.map(Exact).join(', ') + '>';
const Distance = inverse => Exact(inverse === 0 ? Infinity : 1 / inverse);

const BlockText = (s, camera) => {
	const lines = [];
	const direction = `tilt_direction ${Exact(s.direction)}  focal_distance ${Distance(s.inverse_distance)}`;
	if (s.drive === 'lens')
		lines.push(`lens_tilt ${Exact(s.tilt)}  ${direction}`);
	else if (s.drive === 'plane')
		lines.push(`focal_plane_tilt ${Exact(s.plane_tilt)}  ${direction}`);
	else
		lines.push(`focal_plane ${ExactVector(s.point)}, ${ExactVector(s.normal)}`);
	lines.push(s.hold === 'focal_length' ? `focal_length ${Exact(s.focal_length)}` : `image_distance ${Exact(s.image_distance)}`);
	if (s.shift.some(x => x !== 0))
		lines.push(`shift ${ExactVector(s.shift)}`);
	lines.push(Number.isFinite(s.f_stop) ? `f_stop ${Exact(s.f_stop)}` : 'aperture_diameter 0');
	lines.push(...camera.other_words);
	const remarks = camera.remarks.map(text => `// ${text}\n`).join('');
	return `${remarks}tilt_lens {\n${lines.map(line => `  ${line}\n`).join('')}}\n`;
};
