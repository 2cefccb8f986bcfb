// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The optics of a tilted lens. One formula, one place: the camera in POV-Ray
// (double) and the calibrator's Ceres costs (Jets) both call these functions.
//
// Model and conventions (MODEL.md)
//   Camera frame: origin at the lens centre, z forward (the optical axis, normal
//   to the sensor), x right, y up. The sensor lies at z = -w.
//   Any unit of length, the same one everywhere; q and kappa are in 1/unit.
//
//   q      inverse-focus vector: the plane of focus is { P : q.P = 1 }
//   w      image_distance, here always as its inverse 1/w
//   n      lens normal, unit, towards the scene
//   f      focal length of the thin lens, here always as its inverse 1/f
//   v      pixel direction with v.z = 1
//   S      point of the lens, n.S = 0
//   kappa  q.v, the inverse of the depth at which pixel direction v is in focus
//
// Inverse lengths are used throughout because "infinitely far" is then the
// ordinary number 0, and in front of and behind the lens differ by a sign.
// Nothing here divides by kappa; nothing branches on its sign.

#ifndef TILT_LENS_OPTICS_H
#define TILT_LENS_OPTICS_H

#include "lens/vec3.h"

namespace tilt_lens
{

// ---------------------------------------------------------------------------
// The ray
// ---------------------------------------------------------------------------

/// kappa = q.v, inverse focus distance of the pixel direction v (v.z = 1).
/// > 0: focus in front of the lens; 0: at infinity; < 0: behind the lens.
template<typename T>
inline T InverseFocusDistance(const Vec3<T>& q, const Vec3<T>& v)
{
	return Dot(q, v);
}

/// Direction R = v - kappa S of the ray that leaves lens point S for the pixel
/// direction v; its origin is S. Not normalised.
///
/// With P_f = v / kappa this is a positive multiple of the paper's (5),
/// P_f - S, for kappa > 0, and of its (6), S - P_f, for kappa < 0; at kappa = 0
/// it is v. R.n = v.n because n.S = 0, so the ray never turns back.
template<typename T>
inline Vec3<T> RayDirection(const Vec3<T>& v, const Vec3<T>& S, const T& kappa)
{
	return v - kappa * S;
}

// ---------------------------------------------------------------------------
// The plane of focus
// ---------------------------------------------------------------------------

/// The direction (m such that m.P = const is the plane) of a plane of focus that
/// is tilted by theta_F and recedes towards azimuth phi (0 = up, 90 deg = right):
/// m = (-sin phi tan theta_F, -cos phi tan theta_F, 1). Radians, |theta_F| < pi/2.
template<typename T>
inline Vec3<T> FocalPlaneDirection(const T& focal_plane_tilt, const T& tilt_direction)
{
	using std::cos;
	using std::sin;
	using std::tan;
	const T t = tan(focal_plane_tilt);
	return { -sin(tilt_direction) * t, -cos(tilt_direction) * t, T(1) };
}

/// q of the plane with direction m (any length) at distance U along the axis,
/// given as 1/U. The paper's plane z = U + y tan theta_F is
/// (0, -tan theta_F, 1) / U. Domain: m.z != 0.
template<typename T>
inline Vec3<T> PlaneAtDistance(const Vec3<T>& m, const T& inverse_focal_distance)
{
	return (inverse_focal_distance / m.z) * m;
}

/// q of the plane with normal m (any length) through the point P: m / (m.P).
/// Domain: m.P != 0, that is, the plane does not pass through the lens centre.
template<typename T>
inline Vec3<T> PlaneThroughPoint(const Vec3<T>& m, const Vec3<T>& P)
{
	const T d = Dot(m, P);
	return { m.x / d, m.y / d, m.z / d };
}

/// Unit lens normal of a lens that is tilted by theta_L so that the plane of
/// focus recedes towards azimuth phi. Radians.
template<typename T>
inline Vec3<T> LensNormalFromTilt(const T& lens_tilt, const T& tilt_direction)
{
	using std::cos;
	using std::sin;
	const T s = sin(lens_tilt);
	return { -sin(tilt_direction) * s, -cos(tilt_direction) * s, cos(lens_tilt) };
}

// ---------------------------------------------------------------------------
// The vector lens equation  n/f = q + e_z/w
// ---------------------------------------------------------------------------

/// n/f: the lens that images the plane q on the sensor at 1/w. Its direction is
/// the lens normal, its length the power 1/f. This is the Gaussian lens equation
/// and Scheimpflug's rule in one; its y over z is the paper's (1),
/// tan theta_L = w tan theta_F / (U + w).
template<typename T>
inline Vec3<T> LensPower(const Vec3<T>& q, const T& inverse_image_distance)
{
	return { q.x, q.y, q.z + inverse_image_distance };
}

/// A lens: its unit normal towards the scene, and its power 1/f, which is
/// negative for a diverging lens (a plane of focus less than w behind the lens).
template<typename T>
struct Lens
{
	Vec3<T> normal;
	T power;
};

/// The lens of LensPower. Domain: |q + e_z/w| > 0; at 0 the plane lies at
/// z = -w, on the sensor itself, and no lens exists (the caller checks).
template<typename T>
inline Lens<T> LensFromPlane(const Vec3<T>& q, const T& inverse_image_distance)
{
	const Vec3<T> power = LensPower(q, inverse_image_distance);
	const Vec3<T> n = Normalized(power);
	const T length = ScaledLength(power);
	if (n.z < T(0))
		return { T(-1) * n, -length };
	return { n, length };
}

/// q of the plane that a lens with unit normal n and power 1/f images on the
/// sensor at 1/w: q = n/f - e_z/w.
template<typename T>
inline Vec3<T> PlaneFromLens(const Vec3<T>& n, const T& power, const T& inverse_image_distance)
{
	return { n.x * power, n.y * power, n.z * power - inverse_image_distance };
}

/// q of the plane for a lens normal n (n.z > 0), the sensor at 1/w and the
/// distance along the axis as 1/U: Scheimpflug alone, without f.
template<typename T>
inline Vec3<T> PlaneFromLensTilt(const Vec3<T>& n, const T& inverse_image_distance, const T& inverse_focal_distance)
{
	const T s = (inverse_focal_distance + inverse_image_distance) / n.z;
	return { n.x * s, n.y * s, inverse_focal_distance };
}

/// 1/U for the plane of a lens with normal n (n.z > 0) and the sensor at 1/w
/// that passes through the point P. Domain: n.P != 0 (P not in the lens plane).
template<typename T>
inline T InverseDistanceThroughPoint(const Vec3<T>& n, const T& inverse_image_distance, const Vec3<T>& P)
{
	// From q.P = 1 with q of PlaneFromLensTilt, multiplied by n.z.
	return (n.z - inverse_image_distance * (n.x * P.x + n.y * P.y)) / Dot(n, P);
}

/// 1/w at which a lens of power 1/f has the plane of focus q:
/// 1/w = -q_z + sqrt(1/f^2 - q_x^2 - q_y^2).
/// Domain: |q_xy| <= 1/f (the hinge is no nearer than f), and the result must be
/// > 0; both are for the caller to check. Written as a product, because the
/// difference of squares loses digits near the bound.
template<typename T>
inline T InverseImageDistance(const Vec3<T>& q, const T& power)
{
	using std::sqrt;
	const T qxy = ScaledLength(Vec3<T>{ q.x, q.y, T(0) });
	return sqrt((power - qxy) * (power + qxy)) - q.z;
}

// ---------------------------------------------------------------------------
// Blur
// ---------------------------------------------------------------------------

/// Signed blur width on the sensor of the point P = (x, y, z), z > 0:
/// w d (1 - q.P) / z; its absolute value is the diameter of the blur disc of an
/// untilted lens, and of a tilted one to first order. For a plane parallel to the
/// sensor it is the paper's (2), w d |1/U - 1/z|. Positive: nearer than the focus.
/// In pixels when w is in pixels (d and P share a unit).
template<typename T>
inline T SignedBlurWidth(const T& image_distance, const T& aperture_diameter, const Vec3<T>& q, const Vec3<T>& P)
{
	return image_distance * aperture_diameter * (T(1) - Dot(q, P)) / P.z;
}

/// Pixel direction (z component 1) in which the point P is seen through the
/// lens point S: proportional to P - S (1 - q.P) / (1 - q.S).
/// Domain: q.S != 1, P in front of the lens.
template<typename T>
inline Vec3<T> PixelDirectionThroughLensPoint(const Vec3<T>& P, const Vec3<T>& S, const Vec3<T>& q)
{
	const T s = (T(1) - Dot(q, P)) / (T(1) - Dot(q, S));
	const Vec3<T> u = P - s * S;
	return { u.x / u.z, u.y / u.z, T(1) };
}

// ---------------------------------------------------------------------------
// The lens disc
// ---------------------------------------------------------------------------

/// Two unit vectors that span the lens plane: e_x and e_y turned by the smallest
/// rotation that takes e_z to n, so that they vary smoothly with n.
template<typename T>
struct LensBasis
{
	Vec3<T> a, b;
};

/// Domain: n unit, n.z > -1 (a lens normal has n.z >= 0).
template<typename T>
inline LensBasis<T> BasisOfLensPlane(const Vec3<T>& n)
{
	const T s = T(1) / (T(1) + n.z);
	const T xy = -n.x * n.y * s;
	return { { T(1) - n.x * n.x * s, xy, -n.x },
	         { xy, T(1) - n.y * n.y * s, -n.y } };
}

/// Angle between lens plane and sensor plane in radians, from the unit normal;
/// atan2 keeps all digits for small tilts, where acos would not.
template<typename T>
inline T AngleFromAxis(const Vec3<T>& m)
{
	using std::atan2;
	using std::sqrt;
	return atan2(sqrt(m.x * m.x + m.y * m.y), m.z);
}

/// Azimuth phi (radians; 0 up, pi/2 right) towards which the plane of focus
/// recedes, from q or from n; both point away from it. 0 for an untilted plane.
template<typename T>
inline T TiltDirection(const Vec3<T>& m)
{
	using std::atan2;
	return atan2(-m.x, -m.y);
}

}

#endif
