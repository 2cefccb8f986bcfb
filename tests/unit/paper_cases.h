// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The paper's ray as printed, case by case, to show where it stops working.

#ifndef TILT_LENS_TESTS_PAPER_CASES_H
#define TILT_LENS_TESTS_PAPER_CASES_H

#include "lens/vec3.h"

namespace tilt_lens
{

/// (5) R = P_f - S for a focus point in front of the lens, (6) R = S - P_f for one
/// behind it, with P_f = v / kappa, normalised as (5) and (6) are used: by the square
/// root of the sum of squares.
inline Vec3<double> PaperRay(const Vec3<double>& v, const Vec3<double>& S, double kappa)
{
	const Vec3<double> focus = (1.0 / kappa) * v;
	const Vec3<double> R = kappa > 0.0 ? focus - S : S - focus;
	return (1.0 / Length(R)) * R;
}

/// Largest error of a component of the unit direction `a`, against the long double
/// direction v - kappa S; 2 (as wrong as can be) where `a` is not finite.
inline double DirectionError(const Vec3<double>& a, const Vec3<double>& v, const Vec3<double>& S, double kappa)
{
	const Vec3<long double> vl = { v.x, v.y, v.z }, Sl = { S.x, S.y, S.z };
	const Vec3<long double> exact = Normalized(vl - (long double)kappa * Sl);
	const Vec3<long double> al = { a.x, a.y, a.z };
	const double error = double(MaxAbs(al - exact));
	return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z) ? error : 2.0;
}

}

#endif
