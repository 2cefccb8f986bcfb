// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure.h"

#include "edge_fit.h"
#include "edge_profile.h"
#include "image_io.h"
#include "spread_order.h"

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tiltcal
{

namespace
{

using Vec2 = Eigen::Vector2d;

/// The line through a and b: signed distance of p, positive to the right of a->b (y down).
double Distance(const Vec2& a, const Vec2& b, const Vec2& p)
{
	const Vec2 d = (b - a).normalized();
	return d.x() * (p.y() - a.y()) - d.y() * (p.x() - a.x());
}

/// Corner positions with one ring of extrapolated ones around them.
class Grid
{
public:
	Grid(const Photo& photo, const Board& b) : board(b), points(photo.corners.size())
	{
		std::vector<cv::Point2d> pixels, squares;
		for (const Corner& c : photo.corners)
		{
			points[Index(c.column, c.row)] = Vec2(c.x, c.y);
			pixels.emplace_back(c.x, c.y);
			squares.emplace_back(c.column, c.row);
		}
		squares_from_pixels = cv::Matx33d(cv::findHomography(pixels, squares));
	}

	/// (column, row) of a pixel, in squares from the first inner corner.
	Vec2 Square(const Vec2& pixel) const
	{
		const cv::Vec3d p = squares_from_pixels * cv::Vec3d(pixel.x(), pixel.y(), 1);
		return { p[0] / p[2], p[1] / p[2] };
	}

	Vec2 At(int i, int j) const
	{
		const int ci = std::clamp(i, 0, board.InnerColumns() - 1), cj = std::clamp(j, 0, board.InnerRows() - 1);
		if (ci == i && cj == j)
			return points[Index(i, j)];
		// One step beyond: as far outside as the neighbour is inside.
		return 2 * points[Index(ci, cj)] - At(2 * ci - i, 2 * cj - j);
	}

private:
	size_t Index(int i, int j) const { return static_cast<size_t>(j * board.InnerColumns() + i); }

	Board board;
	std::vector<Vec2> points;
	cv::Matx33d squares_from_pixels;
};

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

Surroundings SurroundingsOf(const Grid& grid, int i, int j, bool along_columns)
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

/// Dark to bright across the edge, from the light a quarter square away on both sides.
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

/// One edge; false when it cannot be measured.
bool MeasureEdge(const cv::Mat& grey, const Grid& grid, int i, int j, bool along_columns, Edge& edge)
{
	const Surroundings s = SurroundingsOf(grid, i, j, along_columns);
	Axes axes;
	axes.middle = 0.5 * (s.A + s.B);
	axes.length = (s.B - s.A).norm();
	axes.along = (s.B - s.A) / axes.length;
	axes.normal = Vec2(-axes.along.y(), axes.along.x());
	if (!BrightOnNormalSide(grey, s, axes))
	{
		axes.normal = -axes.normal;
		axes.along = -axes.along;
	}

	const double gap = std::min(std::abs(Distance(s.right[0], s.right[1], axes.middle)), std::abs(Distance(s.left[0], s.left[1], axes.middle)));
	if (gap < 8 || axes.length < 8)
		return false;

	// The window depends on the blur: start from a guess, measure, choose again until
	// the window fits the blur that was measured in it.
	EdgeFit fit;
	std::vector<EdgeSample> samples;
	double radius = 0.12 * std::min(gap, axes.length);
	bool settled = false;
	for (int round = 0; round < 6 && !settled; ++round)
	{
		const double reach = std::min(gap - radius - 1.5, 1.5 * radius + 6);
		if (reach < 1.1 * radius + 2)
			return false;
		samples = Thin(Collect(grey, s, axes, radius, reach), round == 0 ? 500 : 6000);
		fit = FitEdge(samples, axes.normal.x(), axes.normal.y(), round == 0 ? 0.5 * radius : radius);
		if (!fit.valid)
			return false;
		settled = std::abs(fit.radius - radius) < 0.05 * radius + 0.1;
		radius = fit.radius;
	}
	if (!settled || gap - radius - 1.5 < 1.1 * radius + 2)
		return false;
	if (std::abs(fit.offset) > 0.15 * gap || std::abs(fit.slope) > 0.1 || fit.radius_sigma > 0.25 * fit.radius + 0.5)
		return false;

	double s_mean = 0;
	for (const EdgeSample& sample : samples)
		s_mean += sample.s;
	s_mean /= static_cast<double>(samples.size());
	const Vec2 where = axes.middle + s_mean * axes.along + (fit.offset + fit.slope * s_mean) * axes.normal;
	const Vec2 square = grid.Square(where);
	edge.column = i;
	edge.row = j;
	edge.along_columns = along_columns;
	edge.board_column = along_columns ? square.x() : i;
	edge.board_row = along_columns ? j : square.y();
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
	edge.noise = fit.rms;
	edge.profile = EdgeProfile(samples, fit);
	return true;
}

/// A corner as the intersection of the lines of its edges (the paper's features), least
/// squares with the edges' own uncertainties. False: not both directions are there.
bool Intersect(const std::vector<Edge>& edges, Corner& corner)
{
	Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
	Vec2 b = Vec2::Zero();
	bool columns = false, rows = false;
	for (const Edge& e : edges)
	{
		const bool touches = (e.column == corner.column && e.row == corner.row)
			|| (e.along_columns && e.column + 1 == corner.column && e.row == corner.row)
			|| (!e.along_columns && e.column == corner.column && e.row + 1 == corner.row);
		if (!touches)
			continue;
		const Vec2 nominal(e.nx, e.ny), along(e.ny, -e.nx);
		const double side = along.dot(Vec2(corner.x - e.x, corner.y - e.y));
		const Vec2 normal = (nominal - e.slope * along).normalized();
		const double variance = e.offset_sigma * e.offset_sigma + side * side * e.slope_sigma * e.slope_sigma;
		const double weight = 1 / std::max(variance, 1e-8);
		A += weight * normal * normal.transpose();
		b += weight * normal * normal.dot(Vec2(e.x, e.y));
		(e.along_columns ? columns : rows) = true;
	}
	if (!columns || !rows)
		return false;
	const Eigen::Matrix2d covariance = A.inverse();
	const Vec2 p = covariance * b;
	corner.x = p.x();
	corner.y = p.y();
	corner.sigma = std::sqrt(0.5 * covariance.trace());
	return true;
}

}

void MeasureEdges(const cv::Mat& grey, const Board& board, Photo& photo, const EdgeChoice& choice)
{
	const Grid grid(photo, board);
	const std::vector<EdgePlace> places = SpreadOrder(board, choice.phase);
	const size_t wanted = choice.most > 0 ? std::min(size_t(choice.most), places.size()) : places.size();
	std::vector<Edge> edges(places.size());
	std::vector<char> measured(places.size(), 0);
	size_t tried = 0, found = 0;
	// Edges that fail are replaced by the next in the order.
	while (found < wanted && tried < places.size())
	{
		const size_t end = std::min(tried + wanted - found, places.size());
		cv::parallel_for_(cv::Range(static_cast<int>(tried), static_cast<int>(end)), [&](const cv::Range& range)
		{
			for (int k = range.start; k < range.end; ++k)
			{
				const size_t t = static_cast<size_t>(k);
				measured[t] = MeasureEdge(grey, grid, places[t].column, places[t].row, places[t].along_columns, edges[t]);
			}
		});
		found += static_cast<size_t>(std::count(measured.begin() + static_cast<long>(tried), measured.begin() + static_cast<long>(end), 1));
		tried = end;
	}
	photo.edges.clear();
	for (size_t k = 0; k < tried; ++k)
		if (measured[k])
			photo.edges.push_back(edges[k]);
	// Row by row again: sums do not depend on the order in which the edges were chosen.
	std::sort(photo.edges.begin(), photo.edges.end(), [](const Edge& a, const Edge& b)
		{ return std::tuple(a.row, a.column, b.along_columns) < std::tuple(b.row, b.column, a.along_columns); });
	const auto clipped = std::count_if(photo.edges.begin(), photo.edges.end(), [](const Edge& e) { return e.high > 0.995; });
	photo.edges_dropped = static_cast<int>(tried - photo.edges.size());
	photo.saturated_share = photo.edges.empty() ? 0 : double(clipped) / double(photo.edges.size());
	for (Corner& corner : photo.corners)
		Intersect(photo.edges, corner);
}

Photo MeasurePhoto(const std::string& file, const Board& board, const Transfer& transfer, const DetectOptions& options, const EdgeChoice& choice, cv::Mat* grey)
{
	Photo photo;
	const cv::Mat linear = Luminance(ReadLinear(file, transfer, &photo.facts));
	photo.file = file;
	photo.width = linear.cols;
	photo.height = linear.rows;
	photo.corners = DetectCorners(linear, board, options, file);
	MeasureEdges(linear, board, photo, choice);
	if (grey)
		*grey = linear;
	return photo;
}

}
