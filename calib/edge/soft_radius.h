// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A blur's radius r as u = v / sqrt(|v| + 1), v = r^2, px: r where the pixel is small beside the blur, r^2 where it hides
// it. An edge shows r^2, not r, when it is nearly sharp, and noise makes r^2 negative as often as positive there: as r, which
// cannot be, it would come out too large on average, and every nearly sharp edge would tell of a blur that is not there.
// Sharpening in the camera makes v negative: such an edge is steeper than its pixels.

#ifndef TILTCAL_SOFT_RADIUS_H
#define TILTCAL_SOFT_RADIUS_H

#include <cmath>

namespace tiltcal
{

/// u of v = r^2, px^2; any sign. Smooth but for its second derivative at 0.
template<typename T>
inline T SoftOfSquare(const T& v)
{
	using std::abs;
	using std::sqrt;
	return v / sqrt(abs(v) + T(1));
}

/// v of u.
inline double SquareOfSoft(double u)
{
	const double a = std::abs(u);
	return 0.5 * u * (a + std::sqrt(a * a + 4));
}

/// d v / d u.
inline double SquareBySoft(double u)
{
	const double a = std::abs(u), root = std::sqrt(a * a + 4);
	return 0.5 * (2 * a + root + a * a / root);
}

/// A number of the sign of v whose square is |v|: how a radius or a diameter is stored.
inline double SignedRoot(double v) { return std::copysign(std::sqrt(std::abs(v)), v); }
inline double SignedSquare(double r) { return r * std::abs(r); }

/// The same of a blur's diameter, px, whose sign is that of SignedRoot: twice the u of its radius.
inline double SoftDiameter(double diameter) { return 2 * SoftOfSquare(0.25 * SignedSquare(diameter)); }
inline double DiameterOfSoft(double soft) { return 2 * SignedRoot(SquareOfSoft(0.5 * soft)); }

/// Of the square of a predicted diameter, px^2.
template<typename T>
inline T SoftDiameterOfSquare(const T& squared) { return T(2) * SoftOfSquare(T(T(0.25) * squared)); }

}

#endif
