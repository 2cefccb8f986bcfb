// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A ray at a pupil, and where light's etendue puts its point there.
//
// A thin lens turns slopes (tangents) into slopes: b = m b' - phi S', phi = 1/f. Light keeps its etendue, which goes by sines: dS ^ dp is
// the same on both sides, p = b / sqrt(1 + b.b). Both together, which is what a lens of glass does but for its aberrations, leave S no choice:
//   S = D(b)^-1 [sin(b/m + phi S0) - sin(b/m)] / phi,   S0 = S'/m,   sin(x) = x / sqrt(1 + x.x),   D = dp/db = (1 - b b^T / (1 + b.b)) / sqrt(1 + b.b)
// Near the axis that is S0. It has no number of its own, and the slopes stay.
// By hand: the generating function F(S', p) = (m/phi) [sqrt(1 + b'.b') - sqrt(1 + b.b/m^2)] has p' = dF/dS' where b' = (b + phi S')/m, and so S = dF/dp; what
// else could be added, functions of p alone, are the pupil's own aberrations.
// Sources: Welford, "Aberrations of Optical Systems" (1986), section 5.5 (the Lagrange invariant's differential form); Goldstein, "Classical
// Mechanics", chapter 9 (generating functions).

#ifndef TILT_LENS_OBLIQUE_PUPIL_H
#define TILT_LENS_OBLIQUE_PUPIL_H

#include <cmath>

namespace tilt_lens
{

/// A ray on either side: its point in the plane of that side's pupil, and its slopes there.
template<typename T>
struct PupilRay
{
	T x, y;             ///< S or S'
	T slope_x, slope_y; ///< b or b'
};

/// A vector across the lens's axis.
template<typename T>
struct Across
{
	T x, y;
};

template<typename T>
inline T Dot(const Across<T>& a, const Across<T>& b)
{
	return a.x * b.x + a.y * b.y;
}

/// S where etendue puts it, of a ray that the aberrations have left at the object side. m > 0; power: of the glass, 1/f; 0 will do.
template<typename T>
inline PupilRay<T> ObliquePupil(const T& m, const T& power, const PupilRay<T>& ray)
{
	using std::sqrt;
	const Across<T> S = { ray.x, ray.y }, b = { ray.slope_x, ray.slope_y }, x = { b.x / m, b.y / m }, y = { x.x + power * S.x, x.y + power * S.y };
	// The difference of sines over the power, without cancellation.
	const T root_x = sqrt(T(1) + Dot(x, x)), root_y = sqrt(T(1) + Dot(y, y));
	const T less = (T(2) * Dot(x, S) + power * Dot(S, S)) / (root_x * root_y * (root_x + root_y));
	const Across<T> U = { S.x / root_y - less * x.x, S.y / root_y - less * x.y };
	const T slant = Dot(b, U), root = sqrt(T(1) + Dot(b, b));
	return { root * (U.x + slant * b.x), root * (U.y + slant * b.y), b.x, b.y };
}

/// The inverse. False where there is no such ray: it would leave the glass at a sine above 1.
template<typename T>
inline bool UprightPupil(const T& m, const T& power, const PupilRay<T>& ray, PupilRay<T>& upright)
{
	using std::sqrt;
	const Across<T> S = { ray.x, ray.y }, b = { ray.slope_x, ray.slope_y }, x = { b.x / m, b.y / m };
	const T squared = T(1) + Dot(b, b), along = Dot(b, S) / squared, root = sqrt(squared);
	const Across<T> U = { (S.x - along * b.x) / root, (S.y - along * b.y) / root };
	const T root_x = sqrt(T(1) + Dot(x, x));
	const Across<T> sine = { x.x / root_x, x.y / root_x };
	const Across<T> sum = { sine.x + power * U.x, sine.y + power * U.y };
	const T left = T(1) - Dot(sum, sum);
	if(!(left > T(0)))
		return false;
	const T cosine = sqrt(left), cosine_x = T(1) / root_x;
	const T more = (T(2) * Dot(sine, U) + power * Dot(U, U)) / (cosine * cosine_x * (cosine + cosine_x));
	upright = { U.x / cosine + more * sine.x, U.y / cosine + more * sine.y, b.x, b.y };
	return true;
}

/// By how much ObliquePupil's S changes when its arguments change by m_change, power_change and ray_change.
template<typename T>
inline Across<T> ChangeOfObliquePupil(const T& m, const T& power, const PupilRay<T>& ray, const T& m_change, const T& power_change, const PupilRay<T>& ray_change)
{
	using std::sqrt;
	const Across<T> S = { ray.x, ray.y }, b = { ray.slope_x, ray.slope_y }, dS = { ray_change.x, ray_change.y }, db = { ray_change.slope_x, ray_change.slope_y };
	const T inverse = T(1) / m, inverse_change = -m_change * inverse * inverse;
	const Across<T> x = { inverse * b.x, inverse * b.y }, y = { x.x + power * S.x, x.y + power * S.y };
	const Across<T> dx = { inverse * db.x + inverse_change * b.x, inverse * db.y + inverse_change * b.y };
	const Across<T> dy = { dx.x + power * dS.x + power_change * S.x, dx.y + power * dS.y + power_change * S.y };
	const T root_x = sqrt(T(1) + Dot(x, x)), root_y = sqrt(T(1) + Dot(y, y)), dx_root = Dot(x, dx) / root_x, dy_root = Dot(y, dy) / root_y;
	const T both = root_x + root_y, under = root_x * root_y * both, less = (T(2) * Dot(x, S) + power * Dot(S, S)) / under;
	const T under_change = (dx_root * root_y + root_x * dy_root) * both + root_x * root_y * (dx_root + dy_root);
	const T less_change = (T(2) * (Dot(dx, S) + Dot(x, dS) + power * Dot(S, dS)) + power_change * Dot(S, S) - less * under_change) / under;
	const T inverse_root = T(1) / root_y, inverse_root_change = -dy_root * inverse_root * inverse_root;
	const Across<T> U = { inverse_root * S.x - less * x.x, inverse_root * S.y - less * x.y };
	const Across<T> dU = { inverse_root_change * S.x + inverse_root * dS.x - less_change * x.x - less * dx.x, inverse_root_change * S.y + inverse_root * dS.y - less_change * x.y - less * dx.y };
	const T squared = T(1) + Dot(b, b), root = sqrt(squared), share = Dot(b, db) / squared, slant = Dot(b, U), slant_change = Dot(db, U) + Dot(b, dU);
	return { root * (share * (U.x + slant * b.x) + dU.x + slant_change * b.x + slant * db.x), root * (share * (U.y + slant * b.y) + dU.y + slant_change * b.y + slant * db.y) };
}

}

#endif
