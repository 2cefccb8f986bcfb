// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/measure.h"

#include <tiltcal/photo.h>
#include "measure/bright_patches.h"
#include <tiltcal/error.h>
#include "picture/image_io.h"
#include "measure/clipped.h"
#include "measure/measure_circles.h"
#include "measure/measure_colours.h"
#include "measure/measure_edge.h"
#include "measure/refine_corners.h"
#include "base/robust.h"
#include "measure/spread_order.h"

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tiltcal
{

namespace
{

/// After the first, of photographs with edges that run into each other: corners, which start some tenths of a pixel
/// off, have settled to some thousandths.
const int BLURRED_SWEEPS = 4;

/// What became of one place, in the order of SpreadOrder.
struct Measured
{
	EdgePlace place;
	EdgeOutcome outcome = EdgeOutcome::FAILED;
	bool with_neighbours = false;   ///< by MeasureBlurredEdge
	Edge edge;
};

/// The picture reduced so that squares are some 50 px: edges that run into each other are wide, and need no more.
struct Reduced
{
	cv::Mat grey;
	double factor = 1;      ///< full size over reduced size
	CornerGrid grid;
	LightField light;
};

Reduced Reduce(const cv::Mat& grey, const Board& board, const Photo& photo)
{
	const CornerGrid full(photo, board);
	const double side = (full.At(1, 1) - full.At(0, 0)).norm() / std::sqrt(2.0);
	const int k = std::max(1, static_cast<int>(side / 50));
	Photo small = photo;
	for (Corner& c : small.corners)
	{
		c.x = (c.x + 0.5) / k - 0.5;
		c.y = (c.y + 0.5) / k - 0.5;
	}
	cv::Mat reduced = grey;
	// Whole pixels only: each reduced one is the mean of k x k.
	if (k > 1)
		cv::resize(grey(cv::Rect(0, 0, grey.cols / k * k, grey.rows / k * k)), reduced, cv::Size(grey.cols / k, grey.rows / k), 0, 0, cv::INTER_AREA);
	const CornerGrid grid(small, board);
	return { reduced, double(k), grid, LightField(reduced, grid) };
}

/// MeasureBlurredEdge with lengths of the full picture.
EdgeOutcome MeasureReduced(const Reduced& r, const EdgePlace& place, double start_radius, const Vec2& growth, bool last, Edge& edge)
{
	edge = {};   // no profile of the pixels of the reduced picture
	const EdgeOutcome outcome = MeasureBlurredEdge(r.grey, r.grid, r.light, place, start_radius / r.factor, growth, last, edge);
	edge.x = (edge.x + 0.5) * r.factor - 0.5;
	edge.y = (edge.y + 0.5) * r.factor - 0.5;
	for (double* length : { &edge.blur, &edge.blur_sigma, &edge.offset_sigma, &edge.square_px, &edge.reach, &edge.span })
		*length *= r.factor;
	return outcome;
}

void MeasureOne(const cv::Mat& grey, const CornerGrid& grid, const LightField& light, const Reduced& reduced, Measured& m)
{
	// Large pictures are not searched at full size for edges that the reduced one shows to run into each other.
	const bool alone = reduced.factor == 1 || MeasureLoneEdge(reduced.grey, reduced.grid, reduced.light, m.place, m.edge) == EdgeOutcome::MEASURED;
	m.outcome = alone ? MeasureLoneEdge(grey, grid, light, m.place, m.edge) : EdgeOutcome::TOO_BLURRED;
	if (m.outcome == EdgeOutcome::MEASURED)
		return;
	m.with_neighbours = true;
	const Vec2 A = grid.At(m.place.column, m.place.row), B = grid.At(m.place.column + m.place.along_columns, m.place.row + !m.place.along_columns);
	for (const double start : { 0.3, 0.5 })
	{
		m.outcome = MeasureReduced(reduced, m.place, start * (B - A).norm(), Vec2::Zero(), false, m.edge);
		if (m.outcome != EdgeOutcome::LOW_CONTRAST)
			break;
	}
}

/// Gradient of the blur radius around `m`, a plane through what was measured within two and a half squares.
Vec2 Growth(const std::vector<Measured>& all, const Measured& m)
{
	Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
	Eigen::Vector3d b = Eigen::Vector3d::Zero();
	int count = 0;
	for (const Measured& o : all)
	{
		// Nearer to the focus the radius has a kink, and the lines there do not matter.
		if (o.outcome != EdgeOutcome::MEASURED || o.edge.BlurRatio() < 0.1)
			continue;
		const double di = o.edge.board_column - m.edge.board_column, dj = o.edge.board_row - m.edge.board_row;
		if (di * di + dj * dj > 2.5 * 2.5)
			continue;
		const Eigen::Vector3d row(1, o.edge.x - m.edge.x, o.edge.y - m.edge.y);
		A += row * row.transpose();
		b += row * (0.5 * o.edge.blur);
		++count;
	}
	if (count < 8)
		return Vec2::Zero();
	const Vec2 growth = A.ldlt().solve(b).tail<2>();
	// The radius cannot change faster than this in front of a lens; a fit that says so has failed.
	return growth.allFinite() && growth.norm() < 0.2 ? growth : Vec2(Vec2::Zero());
}

/// Whether the bright side is the one that the board's first square would have were it black. Past a blur radius of 0.86
/// squares the contrast reverses, and such an edge differs from the others.
bool BlackFirst(const Edge& e, const CornerGrid& grid)
{
	const Vec2 on = grid.Square(Vec2(e.x, e.y)), beside = grid.Square(Vec2(e.x + e.nx, e.y + e.ny));
	const int step = (e.along_columns ? beside.y() - on.y() : beside.x() - on.x()) > 0 ? 1 : 0;
	// Square (i, j) has the inner corner (i - 1, j - 1) at its top left.
	const int i = e.column + (e.along_columns ? 1 : step), j = e.row + (e.along_columns ? step : 1);
	return (i + j) % 2 != 0;
}

/// Runs `each(k)` for k in [from, to) on all threads.
template<typename Function>
void Parallel(size_t from, size_t to, const Function& each)
{
	cv::parallel_for_(cv::Range(static_cast<int>(from), static_cast<int>(to)), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
			each(static_cast<size_t>(k));
	});
}

/// Measured edges, row by row: sums do not depend on the order in which the edges were chosen.
std::vector<Edge> Good(const std::vector<Measured>& all, const CornerGrid& grid)
{
	std::vector<Edge> edges;
	for (const Measured& m : all)
		if (m.outcome == EdgeOutcome::MEASURED)
			edges.push_back(m.edge);
	const auto black = [&grid](const Edge& e) { return BlackFirst(e, grid); };
	const bool most = 2 * std::count_if(edges.begin(), edges.end(), black) > static_cast<long>(edges.size());
	edges.erase(std::remove_if(edges.begin(), edges.end(), [&](const Edge& e) { return black(e) != most; }), edges.end());
	std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b)
		{ return std::tuple(a.row, a.column, b.along_columns) < std::tuple(b.row, b.column, a.along_columns); });
	return edges;
}

/// Once more with better corners and with the change of the blur over the board, which the first time knew nothing of.
void Repeat(const cv::Mat& grey, const Board& board, Photo& photo, bool last, std::vector<Measured>& all)
{
	const Reduced reduced = Reduce(grey, board, photo);
	const std::vector<Measured> before = all;
	Parallel(0, all.size(), [&](size_t k)
	{
		if (before[k].with_neighbours && before[k].outcome == EdgeOutcome::MEASURED)
			all[k].outcome = MeasureReduced(reduced, all[k].place, 0.5 * before[k].edge.blur, Growth(before, before[k]), last, all[k].edge);
	});
}

/// Too few edges are left to say anything: says which blur was seen.
void RefuseTooBlurred(const std::vector<Measured>& all, const std::string& file)
{
	std::vector<double> ratios, contrasts;
	for (const Measured& m : all)
	{
		if (m.edge.square_px > 0)
			ratios.push_back(m.edge.BlurRatio());
		if (m.outcome == EdgeOutcome::LOW_CONTRAST)
			contrasts.push_back((m.edge.high - m.edge.low) / (m.edge.high + m.edge.low));
	}
	const auto beyond = std::count_if(all.begin(), all.end(), [](const Measured& m) { return m.outcome != EdgeOutcome::MEASURED && m.edge.square_px > 0; });
	if (2 * beyond < static_cast<long>(all.size()) || ratios.empty())
		return;
	const std::string advice = "Stop down, move the board nearer to the plane of focus, or use a board of larger squares";
	// A fit that fails or says less than the limit has taken contrast for blur.
	if (!contrasts.empty() && (2 * static_cast<long>(contrasts.size()) > beyond || Median(ratios) < MOST_RATIO))
		throw Refused(fmt::format("{}: too blurred: what is left of the board's contrast ({:.2f}, at least {:.2f} is needed) shows a blur radius above {:.2f} of a square, "
			"the most that can be measured. {}", file, Median(contrasts), LEAST_CONTRAST, MOST_RATIO, advice));
	throw Refused(fmt::format("{}: too blurred: the radius of the blur is {:.2f} of a square (median), {:.2f} can be measured at most. {}",
		file, Median(ratios), MOST_RATIO, advice));
}

}

void MeasureEdges(const cv::Mat& grey, const Board& board, Photo& photo, const EdgeChoice& choice)
{
	const CornerGrid grid(photo, board);
	const LightField light(grey, grid);
	const Reduced reduced = Reduce(grey, board, photo);
	std::vector<Measured> all;
	for (const EdgePlace& place : SpreadOrder(board, choice.phase))
		all.push_back({ place, EdgeOutcome::FAILED, false, {} });
	const size_t wanted = choice.most > 0 ? std::min(size_t(choice.most), all.size()) : all.size();
	size_t tried = 0, found = 0;
	// Edges that fail are replaced by the next in the order.
	while (found < wanted && tried < all.size())
	{
		const size_t end = std::min(tried + wanted - found, all.size());
		Parallel(tried, end, [&](size_t k) { MeasureOne(grey, grid, light, reduced, all[k]); });
		for (; tried < end; ++tried)
			found += all[tried].outcome == EdgeOutcome::MEASURED;
	}
	all.resize(tried);
	photo.edges = Good(all, grid);
	RefineCorners(photo);
	if (std::any_of(all.begin(), all.end(), [](const Measured& m) { return m.with_neighbours; }))
		for (int sweep = 0; sweep < BLURRED_SWEEPS; ++sweep)
		{
			Repeat(grey, board, photo, sweep + 1 == BLURRED_SWEEPS, all);
			photo.edges = Good(all, grid);
			RefineCorners(photo);
		}
	RefuseTooBlurred(all, photo.file);
	if (photo.edges.empty())
		throw Refused(fmt::format("{}: none of its {} edges can be measured; photograph the board larger and sharper: its squares must be at least {:.0f} px wide, however inclined",
			photo.file, all.size(), LEAST_SQUARE_PX));
	photo.edges_dropped = static_cast<int>(tried - photo.edges.size());
}

Photo MeasurePhoto(const std::string& file, const Board& board, const Transfer& transfer, const DetectOptions& options, const EdgeChoice& choice, cv::Mat* grey)
{
	Photo photo;
	const cv::Mat picture = ReadLinear(file, transfer, &photo.facts), linear = Luminance(picture);
	photo.file = file;
	photo.width = linear.cols;
	photo.height = linear.rows;
	if (board.IsCheckerboard())
	{
		photo.corners = DetectCorners(linear, board, options, file);
		MeasureEdges(linear, board, photo, choice);
	}
	else
		MeasureCircles(linear, board, options, photo, choice);
	photo.saturated_share = ClippedShare(ClippedPixels(picture), photo);
	MeasureWhite(picture, board, photo);
	MeasureColours(picture, board, photo);
	if (grey)
		*grey = linear;
	return photo;
}

}
