// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `vignetting optical R, Z`: another rim of radius R, centred on the lens's
// own axis at the distance Z before the lens (Z < 0: behind it) and tilted with it. Seen
// from the side, the two openings no longer cover each other: what is left is the shape of
// a cat's eye, and so are the blur discs. The corners become darker by the part that is
// lost. A rim before the lens cuts a blur disc from one side, a rim behind it from the other.

#ifndef TILT_LENS_OPTICAL_VIGNETTING_H
#define TILT_LENS_OPTICAL_VIGNETTING_H

#include <cmath>

#include "lens/angles.h"
#include "lens/vec3.h"

namespace tilt_lens
{

/// Radius and distance before the lens.
struct Rim
{
	double radius, distance;
};

/// As many as a lens may have beside its aperture.
const int MostRims = 4;

/// Where the ray from lens point S meets the plane of the rim, as an offset from the
/// rim's centre Z n: s S + c with s = 1 - Z kappa / v.n and c = Z (v / v.n - n). It follows
/// from S + t (v - kappa S) with t = Z / v.n, since n.S = 0. The part that does not depend
/// on S is worth having by itself: it says which part of the lens the rim leaves open.
template<typename T>
struct RimView
{
	T scale;            ///< s
	Vec3<T> offset;     ///< c, normal to n
};

/// v: direction in the scene (any length, v.n > 0), kappa its inverse focus distance of
/// the same length, n unit.
template<typename T>
inline RimView<T> ViewOfRim(const Vec3<T>& n, const Vec3<T>& v, const T& kappa, const T& rim_distance)
{
	const T depth = Dot(v, n);
	return { T(1) - rim_distance * kappa / depth, (rim_distance / depth) * (v - depth * n) };
}

/// The same for a rim behind the lens, Z < 0, where the light goes from S to the pixel's point of
/// the sensor, I = -w p with p the pixel's direction, p.e = 1. The segment S + t (I - S) meets the
/// rim's plane where n.(t I) = Z, for n.S = 0: at t = -Z / (w p.n). From the rim's centre it is
/// there at (1 - t) S + t I - Z n = (1 + Z / (w p.n)) S + Z (p / p.n - n): what ViewOfRim says of
/// p with kappa = -1/w. Seen from behind, the lens is M times as large and M w before the sensor
/// (pupil_magnification.h), and Z counts from there. At Z = 0 both views are the lens itself, at
/// Z = -M w (sensor and lens parallel) the rim is a disc on the sensor.
/// pixel: direction to the pixel from there (any length), n and e (sensor's normal) unit.
template<typename T>
inline RimView<T> ViewOfRimBehind(const Vec3<T>& n, const Vec3<T>& e, const Vec3<T>& pixel, const T& image_distance,
                                  const T& pupil_magnification, const T& rim_distance)
{
	const T kappa = -Dot(e, pixel) / (pupil_magnification * image_distance);
	RimView<T> view = ViewOfRim(n, pixel, kappa, rim_distance);
	view.scale = view.scale * pupil_magnification;
	return view;
}

/// Whether the ray that leaves lens point S passes the rim.
template<typename T>
inline bool PassesRim(const RimView<T>& view, const Vec3<T>& S, const T& rim_radius)
{
	const Vec3<T> p = view.scale * S + view.offset;
	return !(Dot(p, p) > rim_radius * rim_radius);
}

/// Area that two discs of radii a and b at the distance d of their centres have in
/// common. All >= 0. Its derivatives are finite everywhere, but those of its terms are
/// not where the circles touch: there the sum is cut to what it is at the touching.
template<typename T>
inline T OverlapOfDiscs(const T& a, const T& b, const T& d)
{
	using std::atan2;
	using std::sqrt;
	if(d >= a + b)
		return T(0);
	const bool a_is_smaller = a < b;
	const T& smaller = a_is_smaller ? a : b;
	const T& larger = a_is_smaller ? b : a;
	// Half the chord that the circles share, as a product that keeps its digits.
	const T product = (a + b - d) * (a + b + d) * (d + a - b) * (d - a + b);
	if(!(product > 1e-24 * (a + b) * (a + b) * (a + b) * (a + b)))
		return d < larger ? Pi * smaller * smaller : T(0);
	const T chord = sqrt(product) / (2.0 * d);
	const T from_a = (d * d + (a - b) * (a + b)) / (2.0 * d);
	return a * a * atan2(chord, from_a) + b * b * atan2(chord, d - from_a) - d * chord;
}

/// The share of a round lens of the given radius (> 0) that the rim leaves open.
template<typename T>
inline T OpenShare(const RimView<T>& view, const T& lens_radius, const T& rim_radius)
{
	using std::abs;
	using std::sqrt;
	const T image = abs(view.scale) * lens_radius;      // the lens's disc, seen in the plane of the rim
	const T squared = Dot(view.offset, view.offset);
	const T distance = squared > T(0) ? sqrt(squared) : T(0);
	if(!(image > T(0)))
		return T(distance > rim_radius ? 0 : 1);
	return OverlapOfDiscs(image, rim_radius, distance) / (Pi * image * image);
}

}

#endif
