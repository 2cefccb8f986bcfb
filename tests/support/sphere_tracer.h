// SPDX-License-Identifier: AGPL-3.0-or-later
//
// An oracle of the tests: rays through spheres by Snell's law, and the paraxial formulas and Seidel sums of the textbook
// (Welford, "Aberrations of Optical Systems", 1986; Kingslake, "Lens Design Fundamentals"). Long double; shares nothing with lens/.

#ifndef TILT_LENS_TESTS_SPHERE_TRACER_H
#define TILT_LENS_TESTS_SPHERE_TRACER_H

#include <cmath>
#include <vector>

namespace sphere_tracer
{

typedef long double Real;

/// Light goes along +z, from the scene to the sensor.
struct Surface
{
	Real curvature;     ///< > 0: centre of curvature towards the sensor; 0: plane, or the stop
	Real thickness;     ///< to the next surface
	Real index;         ///< behind it; air stands before the first
};

struct Ray
{
	Real x, y, z;       ///< a point
	Real dx, dy, dz;    ///< unit direction
};

/// Through the surfaces first .. last - 1, of which the first stands at z = 0. False where a ray misses or is reflected.
inline bool Trace(const std::vector<Surface>& lens, Ray& r)
{
	Real vertex = 0, before = 1;
	for(const Surface& s : lens)
	{
		// To the vertex's plane, from there to the sphere c |p|^2 = 2 z.
		Real t = (vertex - r.z) / r.dz;
		const Real x = r.x + t * r.dx, y = r.y + t * r.dy, c = s.curvature;
		const Real along = r.dz - c * (x * r.dx + y * r.dy), beside = c * (x * x + y * y);
		const Real root = along * along - c * beside;
		if(!(root >= 0))
			return false;
		t = beside / (along + std::sqrt(root));
		r = { x + t * r.dx, y + t * r.dy, vertex + t * r.dz, r.dx, r.dy, r.dz };
		const Real nx = -c * r.x, ny = -c * r.y, nz = 1 - c * (r.z - vertex);
		const Real cosine = nx * r.dx + ny * r.dy + nz * r.dz, ratio = before / s.index;
		const Real squared = 1 - ratio * ratio * (1 - cosine * cosine);
		if(!(squared >= 0))
			return false;
		const Real turn = std::sqrt(squared) - ratio * cosine;
		r.dx = ratio * r.dx + turn * nx;
		r.dy = ratio * r.dy + turn * ny;
		r.dz = ratio * r.dz + turn * nz;
		vertex += s.thickness;
		before = s.index;
	}
	return true;
}

/// A paraxial ray: height and slope.
struct Paraxial
{
	Real y, u;
};

/// The ray before and behind each surface's refraction: heights there, slopes and indices on both sides.
struct Step
{
	Real y, u_before, u_behind, n_before, n_behind, curvature;
};

inline std::vector<Step> TraceParaxial(const std::vector<Surface>& lens, Paraxial r)
{
	std::vector<Step> steps;
	Real n = 1;
	for(const Surface& s : lens)
	{
		const Real u = (n * r.u - r.y * s.curvature * (s.index - n)) / s.index;
		steps.push_back({ r.y, r.u, u, n, s.index, s.curvature });
		r = { r.y + s.thickness * u, u };
		n = s.index;
	}
	return steps;
}

/// f, and where the stop is seen from both sides.
struct Cardinal
{
	Real focal_length, pupil_magnification;
	Real entrance_pupil, exit_pupil;    ///< z of them
};

/// The surface `stop` is the stop, in air on both sides of the lens.
inline Cardinal CardinalOf(const std::vector<Surface>& lens, size_t stop)
{
	const std::vector<Step> high = TraceParaxial(lens, { 1, 0 }), steep = TraceParaxial(lens, { 0, 1 });
	Cardinal c;
	c.focal_length = -1 / high.back().u_behind;
	// The paraxial ray from the entrance pupil's middle meets the stop at 0: height -e u at the first surface.
	c.entrance_pupil = steep[stop].y / high[stop].y;
	Real length = 0;
	for(size_t i = 0; i + 1 < lens.size(); i++)
		length += lens[i].thickness;
	const Real y = steep.back().y - c.entrance_pupil * high.back().y, u = steep.back().u_behind - c.entrance_pupil * high.back().u_behind;
	c.exit_pupil = length - y / u;
	c.pupil_magnification = high.back().y + (c.exit_pupil - length) * high.back().u_behind;
	return c;
}

/// Seidel's sums of a lens for a marginal and a chief ray, Welford's (8.23).
struct Seidel
{
	Real I, II, III, IV, V;
};

inline Seidel SeidelSums(const std::vector<Step>& marginal, const std::vector<Step>& chief)
{
	Seidel sum = { 0, 0, 0, 0, 0 };
	for(size_t i = 0; i < marginal.size(); i++)
	{
		const Step &m = marginal[i], &p = chief[i];
		const Real A = m.n_before * (m.y * m.curvature + m.u_before), B = m.n_before * (p.y * m.curvature + p.u_before);
		const Real change = m.u_behind / m.n_behind - m.u_before / m.n_before;
		const Real H = m.n_before * (m.u_before * p.y - p.u_before * m.y);
		const Real IV = -H * H * m.curvature * (1 / m.n_behind - 1 / m.n_before);
		const Real III = -B * B * m.y * change;
		sum.I += -A * A * m.y * change;
		sum.II += -A * B * m.y * change;
		sum.III += III;
		sum.IV += IV;
		sum.V += A != 0 ? B / A * (III + IV) : 0;
	}
	return sum;
}

}

#endif
