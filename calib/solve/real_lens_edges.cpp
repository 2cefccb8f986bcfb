// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Every edge as a real lens sees it, linear about some numbers.

#include "solve/real_lens_fit.h"

#include "edge/soft_radius.h"
#include "model/footprint.h"
#include "solve/each_edge.h"

#include <opencv2/core/utility.hpp>

#include <cmath>

namespace tiltcal
{

namespace
{

using namespace real_lens;

/// What the sum over the opening's points misses of the mean over the disc that was fitted, whichever way it lies; `of`: of a place in the light.
template<typename Of>
double MissOfDisc(const Of& of, double diameter, Rings rings)
{
	const int directions = 12, fine = 400;
	double coarse = 0, exact = 0;
	for (int d = 0; d < directions; ++d)
	{
		const double a = 2 * M_PI * d / directions, cosine = std::cos(a), sine = std::sin(a);
		for (const OpeningPoint& p : OpeningPoints(rings))
			coarse += p.weight * of(0.5 * diameter * (p.x * cosine + p.y * sine)) / directions;
	}
	// Chebyshev's points of the second kind: the chords of a disc are their weights.
	for (int k = 1; k <= fine; ++k)
	{
		const double a = M_PI * k / (fine + 1);
		exact += 2 * std::sin(a) * std::sin(a) / (fine + 1) * of(0.5 * diameter * std::cos(a));
	}
	return coarse - exact;
}

RealLensEdge EdgeOf(const RealLensFit& fit, const Edge& e, const RealLensNumbers& x, size_t s, size_t p)
{
	const Task& task = fit.task;
	const Point normal = EdgeNormal(e);
	const double floor_squared = std::max(x.lens[FLOOR_SQUARED], 0.0), squared = SignedSquare(e.blur), h = 0.01;
	// Edges that were told, not measured, have no pixels.
	const double reach = e.reach > 0 ? e.reach : 0.7 * std::abs(e.blur) + 3;
	const std::optional<EdgeShape> shape = fit.shapes ? ShapeOfEdge(e) : std::nullopt;
	RealLensEdge edge{ task.board.X(e.board_column), task.board.Y(e.board_row), e.along_columns, e.x, e.y, normal[0], normal[1], x.r, task.pitch_mm,
		FitResponse(normal[0], normal[1], e.blur, reach, floor_squared / 16, shape.has_value()), 0, (SoftDiameterOfSquare(squared + h) - SoftDiameterOfSquare(squared - h)) / (2 * h), floor_squared, {}, {} };
	const double disc = std::sqrt(std::max(squared - x.lens[FLOOR_SQUARED], 0.0));
	edge.soft_of_disc = MissOfDisc([&](double at) { return edge.response.Soft(at).value; }, disc, fit.rings);
	edge.shape = shape;
	for (int k = 0; shape && k < SHAPES; ++k)
		edge.shape->value[size_t(k)] += MissOfDisc([&](double at) { return edge.response.ShapeOf(Shape(k), at).value; }, disc, fit.rings);
	const auto mounted = [&](double t) { return MountedLens<double>(x.states[s].data(), x.lens.data(), x.c.data(), x.r, task.pitch_mm, e.x + t * normal[0], e.y + t * normal[1]); };
	const double step = 0.5;   // px
	const MountedLens<double> at = mounted(0), before = mounted(-step), behind = mounted(step);
	const double *const pose = x.PoseOf(s, p).data(), *const centre = x.centres[s].data();
	double R[9];
	ceres::AngleAxisToRotationMatrix(pose, R);
	const auto open = [&](const std::vector<OpeningPoint>& points)
	{
		edge.points = points;
		edge.px_per_mm.clear();
		for (const OpeningPoint& point : edge.points)
			edge.px_per_mm.push_back(2 * step / (edge.FromLine(behind, pose, R, centre, x.lens.data(), point) - edge.FromLine(before, pose, R, centre, x.lens.data(), point)));
	};
	edge.at_rims = x.rims;
	if (x.sides.empty())
	{
		open(OpeningPoints(fit.rings));
		return edge;
	}
	const OpeningRays rays({ at.lens, x.r * x.lens[OPENING] * x.lens[MAGNIFICATION], at.x, at.y, at.depth, fit.rings });
	const auto seen = [&](const RealLensNumbers& numbers)
	{
		open(rays.Through(numbers.Rims()));
		RealLensEdge::Seen all;
		edge.See(x.states[s].data(), pose, centre, x.lens.data(), x.c.data(), x.rims.data(), all.data());
		return all;
	};
	if (x.rims_free)
	{
		std::array<std::array<double, RIMS_SIZE>, RealLensEdge::SEEN> by_rims{};
		for (size_t k = 0; k < RIM_SIZE * x.sides.size(); ++k)
		{
			const double change = 0.02;   // of the logarithms of a radius and a distance
			RealLensNumbers more = x, less = x;
			more.rims[k] += change;
			less.rims[k] -= change;
			const RealLensEdge::Seen above = seen(more), below = seen(less);
			for (size_t i = 0; i < RealLensEdge::SEEN; ++i)
				by_rims[i][k] = (above[i] - below[i]) / (2 * change);
		}
		edge.by_rims = by_rims;
	}
	open(rays.Through(x.Rims()));
	return edge;
}

}

std::vector<RealLensEdge> RealLensFit::EdgesAbout(const RealLensNumbers& x) const
{
	struct Place { size_t state, photo; const Edge* edge; };
	std::vector<Place> places;
	ForEachEdge(task, [&](size_t s, size_t p, const Edge& e) { places.push_back({ s, p, &e }); });
	const std::vector<RealLensNumbers> seen = x.AtEveryStop();
	std::vector<std::optional<RealLensEdge>> made(places.size());
	cv::parallel_for_(cv::Range(0, int(places.size())), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
		{
			const Place& at = places[size_t(k)];
			made[size_t(k)] = EdgeOf(*this, *at.edge, seen[task.states[at.state].photos[at.photo].stop], at.state, at.photo);
		}
	});
	std::vector<RealLensEdge> edges;
	for (auto& edge : made)
		edges.push_back(std::move(*edge));
	return edges;
}

}
