// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/rims.h"

#include "solve/least_squares.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tiltcal
{

namespace
{

/// The lattice of the pupil, wide enough for a pupil that wanders by half its radius.
const int ACROSS = 35;
const double REACH = 1.5;

/// Of the rays over the picture: what a rim must cut to be worth its place.
const double LEAST_CUT = 1e-4;

/// A ray through the glass without its rims, and how it passes.
struct OpeningRay
{
	TracedRay traced;
	std::vector<double> heights;     ///< at each surface, in parts of its clear radius; 0 where that is not given
	bool inside, passes;             ///< inside the camera's disc; passes the glass
	bool cut = false;                ///< by a rim that is there already
};

/// In the pupil planes of `fitted`.
struct HeightError
{
	double x, y, u, v, height, weight;    ///< the ray's point in the pupil's plane and slopes

	template<typename T>
	bool operator()(const T* radius, const T* distance, T* residual) const
	{
		using std::sqrt;
		const T a = x + distance[0] * u, b = y + distance[0] * v;
		residual[0] = weight * (sqrt(a * a + b * b) / radius[0] - height);
		return true;
	}
};

struct PlaneRay
{
	double x, y, u, v;

	PlaneRay(const Ray<double>& ray, double z)
		: u(ray.direction.x / ray.direction.z), v(ray.direction.y / ray.direction.z)
	{
		x = ray.point.x + (z - ray.point.z) * u;
		y = ray.point.y + (z - ray.point.z) * v;
	}
	double HeightAt(double distance) const { return std::hypot(x + distance * u, y + distance * v); }
};

PlaneRay OnSideOf(const FittedLens& fitted, const OpeningRay& ray, bool front)
{
	return front ? PlaneRay(ray.traced.object, fitted.entrance_pupil) : PlaneRay(ray.traced.image, fitted.exit_pupil);
}

bool Passes(const FittedLens& fitted, const OpeningRay& ray, const tilt_lens::Rim& rim)
{
	return OnSideOf(fitted, ray, rim.distance >= 0).HeightAt(rim.distance) <= rim.radius;
}

std::vector<OpeningRay> OpeningRays(const Prescription& lens, const Paraxial& p, const Sensor& sensor, const std::vector<GlassState>& states)
{
	BundleSize size;
	size.columns = 9;
	size.rows = 7;
	size.across = ACROSS;
	size.reach = REACH;
	size.rims = Rims::OPEN;
	std::vector<OpeningRay> rays;
	for (const TracedRay& traced : TraceBundle(lens, p, sensor, states, size))
	{
		OpeningRay ray{ traced, std::vector<double>(lens.surfaces.size()), false, true, false };
		Ray<double> again = traced.image;
		TraceToScene(lens, again, Rims::OPEN, [&](size_t k, const Vec3<double>& point)
		{
			if (lens.surfaces[k].clear_radius > 0)
				ray.heights[k] = std::hypot(point.x, point.y) / lens.surfaces[k].clear_radius;
			ray.passes &= ray.heights[k] <= 1;
		});
		rays.push_back(std::move(ray));
	}
	return rays;
}

/// Calls `look` with the range of each pixel's rays, which follow each other.
template<typename Look>
void ForEachPixel(const std::vector<OpeningRay>& rays, const Look& look)
{
	for (size_t from = 0, to; from < rays.size(); from = to)
	{
		for (to = from; to < rays.size() && rays[to].traced.pixel == rays[from].traced.pixel && rays[to].traced.state == rays[from].traced.state;)
			++to;
		look(from, to);
	}
}

/// The disc of the exit pupil's plane as large as what the stop lets through, in the mean over the pixels that hardly lose any of it
/// to rims; and which rays are inside.
double FitOpening(const Prescription& lens, const Paraxial& p, const FittedLens& fitted, std::vector<OpeningRay>& rays)
{
	double area = 0, pixels = 0;
	ForEachPixel(rays, [&](size_t from, size_t to)
	{
		double stop = 0, all = 0;
		for (size_t k = from; k < to; ++k)
		{
			stop += rays[k].heights[lens.stop] <= 1;
			all += rays[k].passes;
		}
		if (!(all > 0.9 * stop))
			return;
		area += stop;
		pixels += 1;
	});
	const double cell = 2 * REACH / ACROSS * p.entrance_radius * p.pupil_magnification;
	const double radius = pixels > 0 ? std::sqrt(area / pixels / tilt_lens::Pi) * cell : p.entrance_radius * fitted.lens.pupil_magnification;
	for (OpeningRay& ray : rays)
		ray.inside = PlaneRay(ray.traced.image, fitted.exit_pupil).HeightAt(0) <= radius;
	return radius / fitted.lens.pupil_magnification;
}

/// As seen near the axis, from which the fit begins.
tilt_lens::Rim ParaxialRim(const Prescription& lens, const FittedLens& fitted, size_t k)
{
	const Surface& s = lens.surfaces[k];
	if (k < lens.stop)
	{
		RayMatrix<double> front;
		if (k > 0)
			front = MatrixOf<double>(lens, 0, k).Then({ 1, lens.surfaces[k - 1].distance, 0, 1 });
		return { s.clear_radius / std::abs(front.a), -front.b / front.a - fitted.entrance_pupil };
	}
	const RayMatrix<double> rear = MatrixOf<double>(lens, k, lens.surfaces.size());
	return { s.clear_radius * lens.IndexBefore(k) / std::abs(rear.d), -lens.Length() + rear.b / rear.d - fitted.exit_pupil };
}

std::optional<tilt_lens::Rim> FitRim(const Prescription& lens, const FittedLens& fitted, const std::vector<OpeningRay>& rays, size_t k)
{
	const bool front = k < lens.stop;
	tilt_lens::Rim rim = ParaxialRim(lens, fitted, k);
	ceres::Problem problem;
	size_t near_edge = 0;
	for (const OpeningRay& ray : rays)
	{
		// What decides is near the edge, within a tenth.
		const double off = (ray.heights[k] - 1) / 0.1;
		if (!ray.inside || std::abs(off) > 1)
			continue;
		const PlaneRay plane = OnSideOf(fitted, ray, front);
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeightError, 1, 1, 1>(new HeightError{ plane.x, plane.y, plane.u, plane.v, ray.heights[k], 1 - std::abs(off) }),
			nullptr, &rim.radius, &rim.distance);
		++near_edge;
	}
	LeastSquares how;
	if (near_edge < 20 || !SolveLeastSquares(how, problem) || !(rim.radius > 0))
		return std::nullopt;
	// The side is the glass's: a rim that comes out in the pupil's plane itself is put just beside it.
	const double least = 1e-6 * rim.radius;
	rim.distance = front ? std::max(rim.distance, least) : std::min(rim.distance, -least);
	return rim;
}

void MeasureLight(const FittedLens& fitted, const std::vector<OpeningRay>& rays, GlassRims& found)
{
	double sum = 0;
	size_t pixels = 0;
	ForEachPixel(rays, [&](size_t from, size_t to)
	{
		double open = 0, glass = 0, camera = 0;
		for (size_t k = from; k < to; ++k)
		{
			const OpeningRay& ray = rays[k];
			open += ray.inside;
			glass += ray.passes;
			camera += ray.inside && std::all_of(found.rims.begin(), found.rims.end(), [&](const GlassRim& r) { return Passes(fitted, ray, r.rim); });
		}
		const double off = (camera - glass) / std::max(1.0, open);
		sum += off * off;
		++pixels;
		if (std::abs(off) > std::abs(found.worst_light))
		{
			found.worst_light = off;
			found.worst_state = rays[from].traced.state;
			found.worst_pixel = rays[from].traced.pixel;
		}
	});
	found.rms_light = std::sqrt(sum / double(std::max<size_t>(1, pixels)));
}

}

GlassRims FitRims(const Prescription& lens, const Paraxial& p, const FittedLens& fitted, const Sensor& sensor, const std::vector<GlassState>& states)
{
	std::vector<OpeningRay> rays = OpeningRays(lens, p, sensor, states);
	GlassRims found;
	found.opening_radius = FitOpening(lens, p, fitted, rays);
	const double inside = double(std::count_if(rays.begin(), rays.end(), [](const OpeningRay& r) { return r.inside; }));
	std::vector<bool> tried(lens.surfaces.size());
	tried[lens.stop] = true;
	// Neighbours cut nearly the same: each time the one that cuts most of what is still open.
	while (true)
	{
		std::vector<size_t> cuts(lens.surfaces.size());
		for (const OpeningRay& ray : rays)
			for (size_t k = 0; k < cuts.size() && ray.inside && !ray.cut; ++k)
				cuts[k] += !tried[k] && ray.heights[k] > 1;
		const size_t k = size_t(std::max_element(cuts.begin(), cuts.end()) - cuts.begin());
		const double share = double(cuts[k]) / std::max(1.0, inside);
		if (share < LEAST_CUT)
			break;
		if (found.rims.size() == size_t(tilt_lens::MostRims))
		{
			found.left_out = share;
			break;
		}
		tried[k] = true;
		const std::optional<tilt_lens::Rim> rim = FitRim(lens, fitted, rays, k);
		if (!rim)
			continue;
		found.rims.push_back({ k, *rim, share });
		for (OpeningRay& ray : rays)
			ray.cut |= ray.heights[k] > 1;
	}
	MeasureLight(fitted, rays, found);
	return found;
}

}
