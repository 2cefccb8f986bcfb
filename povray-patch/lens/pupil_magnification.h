// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `pupil_magnification M`: seen from behind, the opening of a real lens (its exit
// pupil) is M times as large as seen from the front (its entrance pupil). Light then leaves
// towards the sensor at angles whose tangents, about the lens axis, are 1/M of those at which
// it entered, from a point M w before the sensor. A lens that is not tilted shows nothing of
// it; a tilted one draws the picture as from a sensor tilted by another angle (keystone).
// Steger, "A comprehensive and versatile camera model for cameras with tilt lenses" (2017).

#ifndef TILT_LENS_PUPIL_MAGNIFICATION_H
#define TILT_LENS_PUPIL_MAGNIFICATION_H

#include "lens/vec3.h"

namespace tilt_lens
{

/// From the scene's side to the sensor's: the direction in which light that came along v
/// leaves. Of any length; n unit. The sensor lies M w behind.
template<typename T>
inline Vec3<T> DirectionBehindPupils(const Vec3<T>& n, const T& magnification, const Vec3<T>& v)
{
	return v + ((magnification - T(1)) * Dot(v, n)) * n;
}

/// The inverse of that.
template<typename T>
inline Vec3<T> DirectionBeforePupils(const Vec3<T>& n, const T& magnification, const Vec3<T>& v)
{
	return v + ((T(1) / magnification - T(1)) * Dot(v, n)) * n;
}

/// The direction from the exit pupil, M w before the sensor, to a pixel whose direction from
/// a point w before it is v; e: normal of the sensor, unit.
template<typename T>
inline Vec3<T> DirectionFromExitPupil(const Vec3<T>& e, const T& magnification, const Vec3<T>& v)
{
	return DirectionBehindPupils(e, magnification, v);
}

}

#endif
