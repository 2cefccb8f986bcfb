// SPDX-License-Identifier: AGPL-3.0-or-later
// The formulas of lens/optics.h, under its names and in its order; vectors are [x, y, z]. The test cli.plane_page_formulas
// holds them against the C++ ones.

const RadiansPerDegree = Math.PI / 180, DegreesPerRadian = 180 / Math.PI;

const Dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const Add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const Times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const Cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const ScaledLength = a => Math.hypot(a[0], a[1], a[2]);
const Normalized = a => {
	const most = Math.max(Math.abs(a[0]), Math.abs(a[1]), Math.abs(a[2]));
	const scaled = a.map(x => x / most), length = ScaledLength(scaled);
	return scaled.map(x => x / length);
};

const InverseFocusDistance = (q, v) => Dot(q, v);
const RayDirection = (v, S, kappa) => Add(v, Times(-kappa, S));

const FocalPlaneDirection = (focal_plane_tilt, tilt_direction) => {
	const t = Math.tan(focal_plane_tilt);
	return [-Math.sin(tilt_direction) * t, -Math.cos(tilt_direction) * t, 1];
};
const PlaneAtDistance = (m, inverse_focal_distance) => Times(inverse_focal_distance / m[2], m);
const PlaneThroughPoint = (m, P) => {
	const d = Dot(m, P);
	return m.map(x => x / d);
};
const LensNormalFromTilt = (lens_tilt, tilt_direction) => {
	const s = Math.sin(lens_tilt);
	return [-Math.sin(tilt_direction) * s, -Math.cos(tilt_direction) * s, Math.cos(lens_tilt)];
};

const LensPower = (q, inverse_image_distance) => [q[0], q[1], q[2] + inverse_image_distance];
const LensFromPlane = (q, inverse_image_distance) => {
	const power = LensPower(q, inverse_image_distance), n = Normalized(power), length = ScaledLength(power);
	return n[2] < 0 ? { normal: Times(-1, n), power: -length } : { normal: n, power: length };
};
const PlaneFromLens = (n, power, inverse_image_distance) => [n[0] * power, n[1] * power, n[2] * power - inverse_image_distance];
const PlaneFromLensTilt = (n, inverse_image_distance, inverse_focal_distance) => {
	const s = (inverse_focal_distance + inverse_image_distance) / n[2];
	return [n[0] * s, n[1] * s, inverse_focal_distance];
};
const InverseImageDistance = (q, power) => {
	const qxy = Math.hypot(q[0], q[1]);
	return Math.sqrt((power - qxy) * (power + qxy)) - q[2];
};

const SignedBlurWidth = (image_distance, aperture_diameter, q, P) => image_distance * aperture_diameter * (1 - Dot(q, P)) / P[2];

const BasisOfLensPlane = n => {
	const s = 1 / (1 + n[2]), xy = -n[0] * n[1] * s;
	return { a: [1 - n[0] * n[0] * s, xy, -n[0]], b: [xy, 1 - n[1] * n[1] * s, -n[1]] };
};
const AngleFromAxis = m => Math.atan2(Math.hypot(m[0], m[1]), m[2]);
const TiltDirection = m => Math.atan2(-m[0], -m[1]);

// Points whose blur is c satisfy |1 - q.P| / z = c / (w d): what is sharp lies between the planes q +- c/(w d) e_z, which meet
// where q_xy.P = 1 and z = 0: in the hinge.
const SharpnessTolerance = (circle, image_distance, aperture_diameter) => circle / (image_distance * aperture_diameter);
