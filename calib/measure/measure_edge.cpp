// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/measure_edge.h"

#include <tiltcal/photo.h>
#include "edge/binned_profile.h"
#include "edge/blurred_checker.h"
#include "edge/edge_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// The line through a and b: signed distance of p, positive to the right of a->b (y down).
double Distance(const Vec2& a, const Vec2& b, const Vec2& p)
{
	const Vec2 d = (b - a).normalized();
	return d.x() * (p.y() - a.y()) - d.y() * (p.x() - a.x());
}

/// The surroundings of one edge from A to B: the parallel edges on both sides and the
/// cross edges at both ends, whose blur must not reach the pixels that are used.
struct Surroundings
{
	Vec2 A, B;
	Vec2 left[2], right[2];    // next parallel edges
	Vec2 start[2], end[2];     // cross edges through A and through B

	/// Least distance of p from any of the four, negative when p lies beyond one.
	double Clearance(const Vec2& p) const
	{
		const double side = std::min(-Distance(right[0], right[1], p), Distance(left[0], left[1], p));
		const double ends = std::min(std::abs(Distance(start[0], start[1], p)), std::abs(Distance(end[0], end[1], p)));
		return std::min(side, ends);
	}
};

Surroundings SurroundingsOf(const CornerGrid& grid, int i, int j, bool along_columns)
{
	const int di = along_columns, dj = !along_columns;
	// "right" of A->B in a picture with y down: the next row, or the previous column.
	const int ri = along_columns ? 0 : -1, rj = along_columns ? 1 : 0;
	Surroundings s;
	s.A = grid.At(i, j);
	s.B = grid.At(i + di, j + dj);
	s.right[0] = grid.At(i + ri, j + rj);
	s.right[1] = grid.At(i + di + ri, j + dj + rj);
	s.left[0] = grid.At(i - ri, j - rj);
	s.left[1] = grid.At(i + di - ri, j + dj - rj);
	s.start[0] = s.left[0];
	s.start[1] = s.right[0];
	s.end[0] = s.left[1];
	s.end[1] = s.right[1];
	return s;
}

struct Axes
{
	Vec2 middle, normal;
	Vec2 along;          // (normal.y, -normal.x)
	double length;
	double gap;          // to the nearer parallel edge

	double Side() const { return std::min(gap, length); }
};

/// Pixels within `reach` of the edge that other edges, blurred by `radius`, do not touch.
std::vector<EdgeSample> Collect(const cv::Mat& grey, const Surroundings& s, const Axes& axes, double radius, double reach)
{
	const double margin = radius + 1.5;   // a pixel's half diagonal and the lens's own blur
	const Vec2 extent = 0.5 * axes.length * axes.along.cwiseAbs() + reach * axes.normal.cwiseAbs();
	const int x0 = std::max(0, static_cast<int>(std::ceil(axes.middle.x() - extent.x())));
	const int x1 = std::min(grey.cols - 1, static_cast<int>(std::floor(axes.middle.x() + extent.x())));
	const int y0 = std::max(0, static_cast<int>(std::ceil(axes.middle.y() - extent.y())));
	const int y1 = std::min(grey.rows - 1, static_cast<int>(std::floor(axes.middle.y() + extent.y())));
	std::vector<EdgeSample> samples;
	for (int y = y0; y <= y1; ++y)
		for (int x = x0; x <= x1; ++x)
		{
			const Vec2 p(x, y);
			const Vec2 d = p - axes.middle;
			const double across = axes.normal.dot(d), along = axes.along.dot(d);
			if (std::abs(across) > reach || std::abs(along) > 0.5 * axes.length || s.Clearance(p) < margin)
				continue;
			samples.push_back({ across, along, grey.at<float>(y, x) });
		}
	return samples;
}

/// Every k-th sample so that no more than `most` are left: enough for the noise not to
/// matter, and the time does not grow with the size of the picture.
std::vector<EdgeSample> Thin(const std::vector<EdgeSample>& samples, size_t most)
{
	// An odd step does not fall in with the rows, whose lengths differ anyway.
	const size_t step = samples.size() / most | 1;
	std::vector<EdgeSample> thinned;
	for (size_t k = 0; k < samples.size(); k += step)
		thinned.push_back(samples[k]);
	return thinned;
}

/// Dark to bright across the edge, from the light half way to the next edge on both sides.
bool BrightOnNormalSide(const cv::Mat& grey, const Surroundings& s, const Axes& axes)
{
	const double quarter = 0.25 * std::min(std::abs(Distance(s.right[0], s.right[1], axes.middle)), std::abs(Distance(s.left[0], s.left[1], axes.middle)));
	const auto light = [&](double side)
	{
		double sum = 0;
		for (int k = -3; k <= 3; ++k)
		{
			const Vec2 p = axes.middle + side * axes.normal + (k * axes.length / 16) * axes.along;
			sum += grey.at<float>(std::clamp(static_cast<int>(std::lround(p.y())), 0, grey.rows - 1),
				std::clamp(static_cast<int>(std::lround(p.x())), 0, grey.cols - 1));
		}
		return sum;
	};
	return light(2 * quarter) > light(-2 * quarter);
}

/// Axes of the edge, the normal from dark to bright.
Axes AxesOf(const cv::Mat& grey, const Surroundings& s)
{
	Axes axes;
	axes.middle = 0.5 * (s.A + s.B);
	axes.length = (s.B - s.A).norm();
	axes.along = (s.B - s.A) / axes.length;
	axes.normal = Vec2(-axes.along.y(), axes.along.x());
	axes.gap = std::min(std::abs(Distance(s.right[0], s.right[1], axes.middle)), std::abs(Distance(s.left[0], s.left[1], axes.middle)));
	if (!BrightOnNormalSide(grey, s, axes))
	{
		axes.normal = -axes.normal;
		axes.along = -axes.along;
	}
	return axes;
}

/// (column, row).
Vec2 MiddleOf(const EdgePlace& place) { return { place.column + 0.5 * place.along_columns, place.row + 0.5 * !place.along_columns }; }

/// A corner that was found beside its place moves the middle of an edge and turns it about its other end: both as far as that.
bool Trustworthy(const EdgeFit& fit, const Axes& axes)
{
	const double most = 0.15 * axes.gap;
	return std::abs(fit.offset) <= most && std::abs(fit.slope) <= std::min(most / (0.5 * axes.length), 0.25) && fit.radius_sigma <= 0.25 * fit.radius + 0.5;
}

/// What was fitted, at the middle of the samples.
void Fill(const EdgeFit& fit, const std::vector<EdgeSample>& samples, const Axes& axes, const CornerGrid& grid, const EdgePlace& place, Edge& edge)
{
	double s_mean = 0;
	for (const EdgeSample& sample : samples)
		s_mean += sample.s;
	s_mean /= static_cast<double>(samples.size());
	const Vec2 where = axes.middle + s_mean * axes.along + (fit.offset + fit.slope * s_mean) * axes.normal;
	const Vec2 square = grid.Square(where);
	edge.column = place.column;
	edge.row = place.row;
	edge.along_columns = place.along_columns;
	edge.board_column = place.along_columns ? square.x() : place.column;
	edge.board_row = place.along_columns ? place.row : square.y();
	edge.reach = edge.span = 0;
	edge.x = where.x();
	edge.y = where.y();
	edge.nx = axes.normal.x();
	edge.ny = axes.normal.y();
	edge.slope = fit.slope;
	edge.blur = 2 * fit.radius;
	edge.blur_sigma = 2 * fit.radius_sigma;
	edge.offset_sigma = fit.offset_sigma;
	edge.slope_sigma = fit.slope_sigma;
	edge.low = fit.low;
	edge.high = fit.high;
	edge.square_px = axes.Side();
	for (const EdgeSample& sample : samples)
	{
		edge.reach = std::max(edge.reach, std::abs(sample.x));
		edge.span = std::max(edge.span, std::abs(sample.s - s_mean));
	}
}

/// The lines around an edge, in its own axes.
struct Lines
{
	std::vector<CheckerLine> across, along;    // as BlurredChecker wants them
	size_t before = 0, start = 0;
	std::vector<CheckerLine> outline;          // of these, where the pattern ends

	BlurredChecker Profile() const { return BlurredChecker(across, before, along, start); }
};

/// The line through P and Q.
CheckerLine LineThrough(const Axes& axes, const Vec2& P, const Vec2& Q, bool is_across, const Vec2& growth)
{
	const Vec2 n = Vec2(Q.y() - P.y(), P.x() - Q.x()).normalized();
	CheckerLine l;
	l.nx = n.dot(axes.normal);
	l.ns = n.dot(axes.along);
	l.at = n.dot(P - axes.middle);
	l.grow = growth.dot(l.at * n);
	if ((is_across ? l.nx : l.ns) < 0)
	{
		l.nx = -l.nx;
		l.ns = -l.ns;
		l.at = -l.at;
	}
	return l;
}

/// Lines through up to two squares around; none beyond the board's outline, which is at -1 and at the count of corners.
Lines LinesAround(const CornerGrid& grid, const EdgePlace& place, const Axes& axes, const Vec2& growth)
{
	const int di = place.along_columns, dj = !place.along_columns;
	Lines lines;
	const auto add = [&](std::vector<CheckerLine>& to, bool is_across, int index, int count, const Vec2& P, const Vec2& Q)
	{
		if (index < -1 || index > count)
			return;
		to.push_back(LineThrough(axes, P, Q, is_across, growth));
		if (index == -1 || index == count)
			lines.outline.push_back(to.back());
	};
	for (const int k : { -2, -1, 1, 2 })
	{
		const int i = place.column + k * dj, j = place.row + k * di;
		add(lines.across, true, dj ? i : j, dj ? grid.Columns() : grid.Rows(), grid.At(i, j), grid.At(i + di, j + dj));
	}
	for (const int k : { -1, 0, 1, 2 })
	{
		const int i = place.column + k * di, j = place.row + k * dj;
		add(lines.along, false, di ? i : j, di ? grid.Columns() : grid.Rows(), grid.At(i - dj, j - di), grid.At(i + dj, j + di));
	}
	const auto by_place = [](const CheckerLine& a, const CheckerLine& b) { return a.at < b.at; };
	const auto negative = [](const CheckerLine& l) { return l.at < 0; };
	std::sort(lines.across.begin(), lines.across.end(), by_place);
	std::sort(lines.along.begin(), lines.along.end(), by_place);
	lines.before = static_cast<size_t>(std::count_if(lines.across.begin(), lines.across.end(), negative));
	lines.start = static_cast<size_t>(std::count_if(lines.along.begin(), lines.along.end(), negative));
	return lines;
}

/// Pixels of the parallelogram around the edge, half way to its neighbours, that see nothing beyond the board's outline.
std::vector<EdgeSample> CollectBlurred(const cv::Mat& grey, const Axes& axes, const Lines& lines, double radius)
{
	const double reach = std::min(0.55 * axes.gap, 1.5 * radius + 6), half = 0.5 * axes.length;
	const Vec2 extent = half * axes.along.cwiseAbs() + reach * axes.normal.cwiseAbs();
	const int x0 = std::max(0, static_cast<int>(std::ceil(axes.middle.x() - extent.x())));
	const int x1 = std::min(grey.cols - 1, static_cast<int>(std::floor(axes.middle.x() + extent.x())));
	const int y0 = std::max(0, static_cast<int>(std::ceil(axes.middle.y() - extent.y())));
	const int y1 = std::min(grey.rows - 1, static_cast<int>(std::floor(axes.middle.y() + extent.y())));
	const auto sees_beyond = [&](double x, double s)
	{
		return std::any_of(lines.outline.begin(), lines.outline.end(), [&](const CheckerLine& l)
			{ return std::abs(l.at) - (l.nx * x + l.ns * s) * (l.at < 0 ? -1 : 1) < radius + l.grow + 1; });
	};
	std::vector<EdgeSample> samples;
	for (int y = y0; y <= y1; ++y)
		for (int x = x0; x <= x1; ++x)
		{
			const Vec2 d = Vec2(x, y) - axes.middle;
			const double across = axes.normal.dot(d), along = axes.along.dot(d);
			if (std::abs(across) <= reach && std::abs(along) <= half && !sees_beyond(across, along))
				samples.push_back({ across, along, grey.at<float>(y, x) });
		}
	return samples;
}

/// The lines around are other edges' results: their errors become errors of this one. Each of the nearest is moved and
/// turned a little. Neighbours are taken to be as uncertain as this edge, in place and, by half a length, in direction,
/// so that the variances v solve v = v of the fit alone + M v.
void AddNeighboursUncertainty(const Lines& lines, const std::vector<EdgeSample>& samples, double length, EdgeFit& fit)
{
	const double step = 0.1, half = 0.5 * length;   // px
	Eigen::Matrix2d M = Eigen::Matrix2d::Zero();
	Vec2 on_radius = Vec2::Zero();
	const BlurredChecker profile = lines.Profile();
	for (const bool is_across : { true, false })
		for (const int side : { -1, 0 })
			for (const int kind : { 0, 1 })   // moved, turned
			{
				Lines other = lines;
				std::vector<CheckerLine>& family = is_across ? other.across : other.along;
				const size_t index = (is_across ? other.before : other.start) + static_cast<size_t>(side);
				if (index >= family.size())
					continue;
				CheckerLine& l = family[index];
				if (kind == 0)
					l.at += step;
				else
				{
					// About the point nearest to the edge's middle.
					const double turn = step / half, nx = l.nx;
					l.nx -= turn * l.ns;
					l.ns += turn * nx;
				}
				const EdgeChange shift = FirstOrderChange(samples, profile, other.Profile(), fit);
				M(0, kind) += std::pow(shift.offset / step, 2);
				M(1, kind) += std::pow(shift.slope * half / step, 2);
				on_radius[kind] += std::pow(shift.radius / step, 2);
			}
	const double largest = std::max(M.col(0).sum(), M.col(1).sum());
	if (largest > 0.9)
		M *= 0.9 / largest;   // the series must converge, as the repeated fits do
	const Vec2 alone(std::pow(fit.offset_sigma, 2), std::pow(fit.slope_sigma * half, 2));
	const Vec2 both = (Eigen::Matrix2d::Identity() - M).inverse() * alone;
	fit.offset_sigma = std::sqrt(both[0]);
	fit.slope_sigma = std::sqrt(both[1]) / half;
	fit.radius_sigma = std::sqrt(fit.radius_sigma * fit.radius_sigma + on_radius.dot(both));
}

}

EdgeOutcome MeasureLoneEdge(const cv::Mat& grey, const CornerGrid& grid, const LightField& light, const EdgePlace& place, Edge& edge)
{
	const Surroundings s = SurroundingsOf(grid, place.column, place.row, place.along_columns);
	const Axes axes = AxesOf(grey, s);
	if (axes.gap < LEAST_SQUARE_PX || axes.length < LEAST_SQUARE_PX)
		return EdgeOutcome::FAILED;

	// The window depends on the blur: start from a guess, measure, choose again until
	// the window fits the blur that was measured in it.
	const EdgeShading shading = ShadingOfEdge(light.Change(MiddleOf(place)), axes.normal);
	EdgeFit fit;
	std::vector<EdgeSample> samples;
	double radius = 0.12 * axes.Side();
	bool settled = false;
	for (int round = 0; round < 6 && !settled; ++round)
	{
		const double reach = std::min(axes.gap - radius - 1.5, 1.5 * radius + 6);
		if (reach < 1.1 * radius + 2 || radius > LONE_RATIO * axes.Side() + 1.5)
			return EdgeOutcome::TOO_BLURRED;
		// A blur that fills the window is not known well enough yet for the full number to be of use.
		const bool rough = round == 0 || (round == 1 && radius > 0.15 * axes.Side());
		samples = Thin(Collect(grey, s, axes, radius, reach), rough ? 500 : 6000);
		fit = FitEdge(samples, LoneEdge(axes.normal.x(), axes.normal.y()), shading, round == 0 ? 0.5 * radius : radius);
		if (!fit.valid)
			return EdgeOutcome::FAILED;
		settled = (!rough || round == 0) && std::abs(std::max(fit.radius, 0.0) - radius) < 0.05 * radius + 0.1;
		radius = std::max(fit.radius, 0.0);
	}
	if (radius > LONE_RATIO * axes.Side() || axes.gap - radius - 1.5 < 1.1 * radius + 2)
		return EdgeOutcome::TOO_BLURRED;
	if (!settled || !Trustworthy(fit, axes))
		return EdgeOutcome::FAILED;
	Fill(fit, samples, axes, grid, place, edge);
	edge.noise = fit.rms;
	edge.profile = BinnedProfile(samples, fit);
	return EdgeOutcome::MEASURED;
}

EdgeOutcome MeasureBlurredEdge(const cv::Mat& grey, const CornerGrid& grid, const LightField& light, const EdgePlace& place, double start_radius,
	const Vec2& growth, bool last, Edge& edge)
{
	const Axes axes = AxesOf(grey, SurroundingsOf(grid, place.column, place.row, place.along_columns));
	if (axes.gap < LEAST_SQUARE_PX || axes.length < LEAST_SQUARE_PX)
		return EdgeOutcome::FAILED;
	const Lines lines = LinesAround(grid, place, axes, growth);
	const BlurredChecker profile = lines.Profile();
	const EdgeShading shading = ShadingOfEdge(light.Change(MiddleOf(place)), axes.normal);
	EdgeFit fit;
	std::vector<EdgeSample> samples;
	double radius = start_radius;
	bool settled = false;
	for (int round = 0; round < 5 && !settled; ++round)
	{
		samples = Thin(CollectBlurred(grey, axes, lines, radius), last ? 2000 : round == 0 ? 400 : 800);
		fit = FitEdge(samples, profile, shading, radius);
		edge.square_px = axes.Side();
		if (!fit.valid)
			return EdgeOutcome::FAILED;
		settled = round > 0 && std::abs(fit.radius - radius) < 0.05 * radius + 0.1;
		radius = std::max(fit.radius, 0.0);
		edge.blur = 2 * radius;
		if (radius > 0.9 * axes.Side())
			return EdgeOutcome::TOO_BLURRED;
	}
	if (radius > MOST_RATIO * axes.Side())
		return EdgeOutcome::TOO_BLURRED;
	if (fit.high - fit.low < LEAST_CONTRAST * (fit.high + fit.low) && radius > LONE_RATIO * axes.Side())
	{
		edge.low = fit.low;
		edge.high = fit.high;
		return EdgeOutcome::LOW_CONTRAST;
	}
	// Below, the pixel is not small beside the disc, and lone edges should have been found.
	if (!settled || radius < 1.5 || !Trustworthy(fit, axes))
		return EdgeOutcome::FAILED;
	if (last)
		AddNeighboursUncertainty(lines, Thin(samples, 500), axes.length, fit);
	Fill(fit, samples, axes, grid, place, edge);
	return EdgeOutcome::MEASURED;
}

}
