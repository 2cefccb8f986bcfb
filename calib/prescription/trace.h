// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Real rays through spheres. Frame of the glass: Z along the axis towards the scene, 0 at the first vertex.

#ifndef TILTCAL_TRACE_H
#define TILTCAL_TRACE_H

#include "lens/vec3.h"
#include "prescription/prescription.h"

#include <cmath>
#include <cstddef>

namespace tiltcal
{

using tilt_lens::Vec3;

template<typename T>
struct Ray
{
	Vec3<T> point, direction;   ///< of unit length
};

/// What became of a ray.
enum class Fate
{
	PASSED,
	BLOCKED,      ///< outside a clear diameter, or the stop
	MISSED,       ///< does not meet a sphere
	REFLECTED     ///< total reflection
};

/// Whether clear diameters and the stop cut rays off.
enum class Rims { CUT, OPEN };

/// Where the ray meets the sphere (or plane) of the given curvature with its vertex at the height z of the axis, on the vertex's side.
/// False: it does not. With p counted from the vertex the surface is c p.p + 2 p.z = 0, which is a plane at c = 0.
template<typename T>
bool MeetSurface(const T& c, const T& z, Ray<T>& ray)
{
	using std::sqrt;
	const Vec3<T> o = ray.point - Vec3<T>{ T(0), T(0), z };
	const T b = c * Dot(o, ray.direction) + ray.direction.z, k = c * Dot(o, o) + T(2) * o.z;
	const T squared = b * b - c * k;
	if (!(squared >= T(0)) || b == T(0))
		return false;
	const T root = sqrt(squared);
	ray.point = ray.point + (-k / (b < T(0) ? b - root : b + root)) * ray.direction;
	return true;
}

/// Snell's law in vectors: unit `direction` from index `from` into `into`, at a unit normal of either sense. False: total reflection.
template<typename T>
bool Refract(Vec3<T> normal, const T& from, const T& into, Vec3<T>& direction)
{
	using std::sqrt;
	if (from == into)
		return true;
	T cosine = -Dot(normal, direction);
	if (cosine < T(0))
	{
		cosine = -cosine;
		normal = T(-1) * normal;
	}
	const T ratio = from / into, squared = T(1) - ratio * ratio * (T(1) - cosine * cosine);
	if (squared < T(0))
		return false;
	direction = ratio * direction + (ratio * cosine - sqrt(squared)) * normal;
	return true;
}

/// Takes `ray` through the surface k, whose vertex is at the height z, from air's side `from` into `into`.
template<typename T>
Fate PassSurface(const Surface& surface, const T& z, double from, double into, Rims rims, Ray<T>& ray)
{
	const T c(surface.curvature);
	if (!MeetSurface(c, z, ray))
		return Fate::MISSED;
	const T square = ray.point.x * ray.point.x + ray.point.y * ray.point.y;
	if (rims == Rims::CUT && surface.clear_radius > 0 && square > T(surface.clear_radius) * T(surface.clear_radius))
		return Fate::BLOCKED;
	// The gradient of the surface is a unit vector on it.
	const Vec3<T> normal = c * ray.point + Vec3<T>{ T(0), T(0), T(1) - c * z };
	return Refract(normal, T(from), T(into), ray.direction) ? Fate::PASSED : Fate::REFLECTED;
}

/// From the scene to the sensor: `ray` comes out behind the last surface.
template<typename T>
Fate TraceToSensor(const Prescription& lens, Ray<T>& ray, Rims rims = Rims::CUT)
{
	T z(0);
	for (size_t k = 0; k < lens.surfaces.size(); ++k)
	{
		const Fate fate = PassSurface(lens.surfaces[k], z, lens.IndexBefore(k), lens.surfaces[k].index, rims, ray);
		if (fate != Fate::PASSED)
			return fate;
		z = z - T(lens.surfaces[k].distance);
	}
	return Fate::PASSED;
}

struct NotWatched
{
	template<typename T>
	void operator()(size_t, const Vec3<T>&) const {}
};

/// From the sensor to the scene: `ray` comes out before the first surface. `watch` is told where it passes each surface.
template<typename T, typename Watch = NotWatched>
Fate TraceToScene(const Prescription& lens, Ray<T>& ray, Rims rims = Rims::CUT, const Watch& watch = {})
{
	T z(-lens.Length());
	for (size_t k = lens.surfaces.size(); k-- > 0;)
	{
		const Fate fate = PassSurface(lens.surfaces[k], z, lens.surfaces[k].index, lens.IndexBefore(k), rims, ray);
		if (fate != Fate::PASSED)
			return fate;
		watch(k, ray.point);
		if (k > 0)
			z = z + T(lens.surfaces[k - 1].distance);
	}
	return Fate::PASSED;
}

}

#endif
