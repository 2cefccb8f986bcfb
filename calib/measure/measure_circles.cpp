// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/measure_circles.h"

#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "measure/find_circles.h"
#include "measure/measure_arc.h"
#include "base/robust.h"
#include "measure/spread_order.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tiltcal
{

namespace
{

/// What became of one arc.
struct MeasuredArc
{
	ArcPlace place;
	EdgeOutcome outcome = EdgeOutcome::FAILED;
	Edge edge;
};

/// Circles and what is known of them, improved by every sweep.
struct Grid
{
	const cv::Mat& grey;
	const Board& board;
	bool bright;
	double radius;                 // of the circles, in units of the spacing
	std::vector<Corner> centres;
	std::vector<CircleView> views;
	std::vector<int> arcs;         // of every circle

	size_t Index(const ArcPlace& p) const { return size_t(p.row * board.columns + p.index); }
};

template<typename Function>
void Parallel(size_t from, size_t to, const Function& each)
{
	cv::parallel_for_(cv::Range(int(from), int(to)), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
			each(size_t(k));
	});
}

void Look(Grid& grid)
{
	const GridMap map(grid.centres);
	const LightField light(grid.grey, grid.board, map, grid.centres);
	std::vector<std::vector<CircleView>> views(grid.centres.size());
	Parallel(0, views.size(), [&](size_t k) { views[k].emplace_back(grid.grey, grid.board, map, light, grid.centres[k], grid.radius, grid.bright); });
	grid.views.clear();
	for (auto& v : views)
		grid.views.push_back(std::move(v[0]));
}

/// Least smaller radius, px, of circles whose outline can be measured, and from which on it is measured in MOST_ARCS: the inner
/// quarter of an arc's pixels must be some ten.
const double LEAST_RADIUS = 6, RADIUS_OF_MOST = 9.5;
const int MOST_ARCS = 8, FEW_ARCS = 4;

void ChooseArcs(Grid& grid, const std::string& file)
{
	std::vector<double> radii;
	for (const CircleView& v : grid.views)
	{
		radii.push_back(v.SmallerRadius());
		grid.arcs.push_back(radii.back() < RADIUS_OF_MOST ? FEW_ARCS : MOST_ARCS);
	}
	const double median = Median(radii);
	if (median < LEAST_RADIUS)
		throw Refused(fmt::format("{}: the circles are only {:.1f} pixels across, at least {:.0f} are needed: go nearer, photograph with more pixels, or use a grid of larger circles",
			file, 2 * median, 2 * LEAST_RADIUS));
}

/// Place of a circle from its arcs, with their own uncertainties: it may move, and grow. Not solved: too few arcs.
struct Moved
{
	bool solved = false;
	Vec2 by{ 0, 0 };
	double growth = 0, growth_variance = 0;   // units of the spacing
	double sigma = 0;
	double misfit = 0;                        // chi square
	int freedom = 0;
};

Moved Move(const Grid& grid, size_t circle, const std::vector<const Edge*>& edges)
{
	Moved moved;
	if (int(edges.size()) * 8 < grid.arcs[circle] * 5)
		return moved;
	const Corner& c = grid.centres[circle];
	Eigen::MatrixX3d A(edges.size(), 3);
	Eigen::VectorXd b(edges.size());
	for (size_t k = 0; k < edges.size(); ++k)
	{
		const Edge& e = *edges[k];
		const double t = std::atan2(e.board_row - c.row, e.board_column - c.column), weight = 1 / std::max(e.offset_sigma, 1e-4);
		const Vec2 n(e.nx, e.ny);
		const double growth = grid.views[circle].Growth(t, n);
		A.row(long(k)) << weight * n.x(), weight * n.y(), weight * growth;
		b[long(k)] = weight * grid.views[circle].Offset(e);
	}
	const Eigen::Matrix3d covariance = (A.transpose() * A).inverse();
	const Eigen::Vector3d x = covariance * (A.transpose() * b);
	if (!x.allFinite())
		return moved;
	moved.by = x.head<2>();
	moved.growth = x[2];
	moved.growth_variance = covariance(2, 2);
	moved.sigma = std::sqrt(0.5 * covariance.topLeftCorner<2, 2>().trace());
	moved.misfit = (b - A * x).squaredNorm();
	moved.freedom = int(edges.size()) - 3;
	moved.solved = moved.sigma < 1;
	return moved;
}

/// Moves the centres to where the arcs are, and gives all circles the size that they have on average.
void MoveCentres(Grid& grid, const std::vector<MeasuredArc>& all)
{
	std::vector<std::vector<const Edge*>> edges(grid.centres.size());
	for (const MeasuredArc& m : all)
		if (m.outcome == EdgeOutcome::MEASURED)
			edges[grid.Index(m.place)].push_back(&m.edge);
	std::vector<Moved> moved;
	double misfit = 0, growth = 0, weights = 0;
	int freedom = 0;
	for (size_t k = 0; k < edges.size(); ++k)
	{
		moved.push_back(Move(grid, k, edges[k]));
		if (!moved[k].solved)
			continue;
		misfit += moved[k].misfit;
		freedom += moved[k].freedom;
		growth += moved[k].growth / moved[k].growth_variance;
		weights += 1 / moved[k].growth_variance;
	}
	// Arcs that agree less than their sigmas say: the centres are as much less certain.
	const double scale = std::sqrt(std::max(1.0, freedom > 0 ? misfit / freedom : 1.0));
	for (size_t k = 0; k < edges.size(); ++k)
	{
		Corner& c = grid.centres[k];
		if (moved[k].solved)
			c = { c.column, c.row, c.x + moved[k].by.x(), c.y + moved[k].by.y(), scale * moved[k].sigma };
		else if (!edges[k].empty())
			c.sigma = std::hypot(0.1, 0.03 * edges[k].front()->blur);
	}
	if (weights > 0)
		grid.radius += growth / weights;
}

/// All arcs that are wanted once; those that fail are replaced by the next in the order.
void MeasureFirst(const Grid& grid, const EdgeChoice& choice, std::vector<MeasuredArc>& all)
{
	for (const ArcPlace& place : SpreadArcs(grid.board, MOST_ARCS, choice.phase))
		if (place.arc < grid.arcs[grid.Index(place)])
			all.push_back({ place, EdgeOutcome::FAILED, {} });
	const size_t wanted = choice.most > 0 ? std::min(size_t(choice.most), all.size()) : all.size();
	size_t tried = 0, found = 0;
	while (found < wanted && tried < all.size())
	{
		const size_t end = std::min(tried + wanted - found, all.size());
		Parallel(tried, end, [&](size_t k) { all[k].outcome = grid.views[grid.Index(all[k].place)].Measure(all[k].place.arc, grid.arcs[grid.Index(all[k].place)], 0, true, all[k].edge); });
		for (; tried < end; ++tried)
			found += all[tried].outcome == EdgeOutcome::MEASURED;
	}
	all.resize(tried);
}

/// Once more, with better centres.
void Repeat(const Grid& grid, bool rough, std::vector<MeasuredArc>& all)
{
	Parallel(0, all.size(), [&](size_t k)
	{
		MeasuredArc& m = all[k];
		const double start = m.outcome == EdgeOutcome::MEASURED ? 0.5 * m.edge.blur : 0;
		m.edge = {};
		m.outcome = grid.views[grid.Index(m.place)].Measure(m.place.arc, grid.arcs[grid.Index(m.place)], start, rough, m.edge);
	});
}

void RefuseTooBlurred(const std::vector<MeasuredArc>& all, const std::string& file)
{
	const auto blurred = std::count_if(all.begin(), all.end(), [](const MeasuredArc& m) { return m.outcome == EdgeOutcome::TOO_BLURRED; });
	const auto lost = std::count_if(all.begin(), all.end(), [](const MeasuredArc& m) { return m.outcome != EdgeOutcome::MEASURED; });
	if (2 * lost < long(all.size()))
		return;
	if (2 * blurred < lost)
		throw Refused(fmt::format("{}: the outlines of {} of {} arcs of circles could not be fitted: is the picture sharp enough, without reflections and noise, and are the circles round?",
			file, lost, all.size()));
	throw Refused(fmt::format("{}: too blurred: in {} of {} arcs of circles the radius of the blur is above {:.2f} of the circle's radius, the most that can be measured. "
		"Stop down, move the board nearer to the plane of focus, or use a grid of larger circles", file, blurred, all.size(), MOST_CIRCLE_RATIO));
}

/// Diameters may differ from the board's by what printing and exposure do, not more.
const double DIAMETER_TOLERANCE = 0.12;

void CheckDiameter(const Board& board, double radius, const std::string& file)
{
	if (std::abs(radius / board.CircleRadius() - 1) > DIAMETER_TOLERANCE)
		throw Refused(fmt::format("{}: the circles' diameter is {:.3f} of their spacing, the board's {:.3f}: give `circle_diameter` {:.3g} if `square` {:g} is right",
			file, 2 * radius, 2 * board.CircleRadius(), 2 * radius * board.square_mm, board.square_mm));
}

}

void MeasureCircles(const cv::Mat& grey, const Board& board, const DetectOptions& options, Photo& photo, const EdgeChoice& choice)
{
	const FoundCircles found = FindCircles(grey, board, options, photo.file);
	Grid grid{ grey, board, found.bright, found.radius, found.centres, {}, {} };
	Look(grid);
	ChooseArcs(grid, photo.file);
	std::vector<MeasuredArc> all;
	MeasureFirst(grid, choice, all);
	MoveCentres(grid, all);
	for (const bool rough : { true, false })
	{
		Look(grid);
		Repeat(grid, rough, all);
		RefuseTooBlurred(all, photo.file);
		MoveCentres(grid, all);
	}
	CheckDiameter(board, grid.radius, photo.file);
	photo.bright_circles = grid.bright;
	photo.corners = grid.centres;
	photo.edges.clear();
	for (const MeasuredArc& m : all)
		if (m.outcome == EdgeOutcome::MEASURED)
			photo.edges.push_back(m.edge);
	std::sort(photo.edges.begin(), photo.edges.end(), [](const Edge& a, const Edge& b) { return std::tuple(a.row, a.column, a.arc) < std::tuple(b.row, b.column, b.arc); });
	photo.edges_dropped = int(all.size() - photo.edges.size());
}

}
