// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `field_curvature C`: real lenses focus on a bowl instead of a plane. It
// belongs to the lens, so it is centred on the lens's own axis, tilted as that is:
//   kappa(v) = q.v + C (v.n) |v/(v.n) - n|^2      (MODEL.md, Field curvature)
// v/(v.n) - n is the tangent of the field angle. The plane q.P = 1 touches the bowl on
// the lens axis; C > 0 bends the bowl towards the lens, C < 0 away from it. C is in
// 1/length, like q. kappa is homogeneous of degree 1 in v, as q.v is, so that directions
// of any length may be used, and kappa(P) is what q.P is for the plane: the bowl is
// { P : kappa(P) = 1 }.

#ifndef TILT_LENS_FIELD_CURVATURE_H
#define TILT_LENS_FIELD_CURVATURE_H

#include "lens/vec3.h"

namespace tilt_lens
{

/// (v.n) |v/(v.n) - n|^2, what C is multiplied by. n unit. Domain: v.n != 0.
/// |v - (v.n) n| instead of |v|^2 - (v.n)^2 keeps its digits near the axis.
template<typename T>
inline T CurvatureTerm(const Vec3<T>& n, const Vec3<T>& v)
{
	const T depth = Dot(v, n);
	const Vec3<T> aside = v - depth * n;
	return Dot(aside, aside) / depth;
}

/// kappa(v), inverse focus distance of the direction v on the bowl.
template<typename T>
inline T InverseFocusDistanceOnBowl(const Vec3<T>& q, const T& field_curvature, const Vec3<T>& n, const Vec3<T>& v)
{
	return Dot(q, v) + field_curvature * CurvatureTerm(n, v);
}

}

#endif
