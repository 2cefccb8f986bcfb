// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `vignetting natural`: light falls off towards the corners because the lens
// is seen obliquely, from farther away, and shines obliquely on the sensor. A sensor
// point at distance r from a small opening of area A has the illuminance
//   E = L A cos(theta_lens) cos(theta_sensor) / r^2,   r = w / cos(theta_sensor)
// (Lambert's law; Born and Wolf, section 4.8). For a lens that is not tilted that is the
// fourth power of the cosine. A tilted lens keeps its sensor where it is: three of the
// cosines belong to the sensor and one to the lens. It is relative to the value on the
// lens axis, so that the exposure stays where the lens points.

#ifndef TILT_LENS_NATURAL_VIGNETTING_H
#define TILT_LENS_NATURAL_VIGNETTING_H

#include "lens/vec3.h"

namespace tilt_lens
{

/// Illuminance relative to that on the lens axis, for the pixel whose pinhole direction,
/// before any distortion, is v (any length). n: lens normal, e: normal of the sensor
/// (the axis), both unit, n.e > 0. Domain: v.n > 0, v.e > 0; may exceed 1 where the sensor
/// is nearer to the lens than on the lens axis.
template<typename T>
inline T NaturalFalloff(const Vec3<T>& n, const Vec3<T>& e, const Vec3<T>& v)
{
	const T length = ScaledLength(v);
	const T lens = Dot(v, n) / length;
	const T sensor = Dot(v, e) / (length * Dot(n, e));
	return lens * sensor * sensor * sensor;
}

}

#endif
