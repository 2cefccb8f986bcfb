// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/find_circles.h"

#include "lens/angles.h"
#include <tiltcal/photo.h>
#include "measure/circle_outline.h"
#include <tiltcal/error.h>
#include "measure/find_board.h"
#include "base/robust.h"

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using Points = std::vector<cv::Point2f>;

using tilt_lens::Pi;

/// Dark blobs of an 8-bit picture.
std::vector<cv::KeyPoint> Blobs(const cv::Mat& picture, const Board& board, float convexity)
{
	const double shorter = std::min(picture.cols, picture.rows);
	cv::SimpleBlobDetector::Params params;
	params.minThreshold = 30;
	params.maxThreshold = 230;
	params.filterByColor = true;
	params.blobColor = 0;
	// A circle of 5 px is the least that can be told from noise; the largest leave no room for the grid.
	params.minArea = 20;
	params.maxArea = float(shorter * shorter / (board.columns * board.rows) * 2);
	params.minDistBetweenBlobs = 4;
	params.minInertiaRatio = 0.08f;   // inclined by 70 degrees
	params.minConvexity = convexity;
	std::vector<cv::KeyPoint> keys;
	cv::SimpleBlobDetector::create(params)->detect(picture, keys);
	return keys;
}

/// Middles of the blobs within the span (a factor) of sizes that holds most of them.
Points OfOneSize(const std::vector<cv::KeyPoint>& keys, double factor)
{
	std::vector<double> sizes;
	for (const cv::KeyPoint& k : keys)
		sizes.push_back(std::log(k.size));
	std::sort(sizes.begin(), sizes.end());
	const double span = std::log(factor);
	size_t best = 0, most = 0;
	for (size_t a = 0, b = 0; a < sizes.size(); ++a)
	{
		while (b < sizes.size() && sizes[b] <= sizes[a] + span)
			++b;
		if (b - a > most)
			most = b - a, best = a;
	}
	Points points;
	for (const cv::KeyPoint& k : keys)
		if (std::log(k.size) >= sizes[best] && std::log(k.size) <= sizes[best] + span)
			points.push_back(k.pt);
	return points;
}

/// Row by row in some numbering of OpenCV's; empty when not found.
Points Grid(const Points& blobs, const Board& board)
{
	const cv::Size size(board.columns, board.rows);
	if (blobs.size() < size_t(size.area()))
		return {};
	const int kind = board.kind == TargetKind::CIRCLES ? cv::CALIB_CB_SYMMETRIC_GRID : cv::CALIB_CB_ASYMMETRIC_GRID;
	// Clustering takes perspective well and clutter badly.
	for (const int flags : { kind | cv::CALIB_CB_CLUSTERING, kind })
	{
		// It takes whatever there is for a grid when there are more blobs than circles.
		if ((flags & cv::CALIB_CB_CLUSTERING) && blobs.size() > size_t(2 * size.area()))
			continue;
		try
		{
			Points points;
			if (cv::findCirclesGrid(blobs, size, points, flags, cv::Ptr<cv::FeatureDetector>()) && points.size() == size_t(size.area()))
				return points;
		}
		catch (const cv::Exception&)
		{
			// Blobs on a line, for example: no grid.
		}
	}
	return {};
}

std::vector<Corner> Numbered(const Points& points, const Board& board)
{
	std::vector<Corner> centres;
	for (int j = 0; j < board.rows; ++j)
		for (int i = 0; i < board.columns; ++i)
		{
			const cv::Point2f& p = points[size_t(j * board.columns + i)];
			centres.push_back({ board.CircleColumn(i, j), j, p.x, p.y, 0.1 });
		}
	return centres;
}

double Light(const cv::Mat& grey, const Vec2& p)
{
	const long x = std::lround(p.x()), y = std::lround(p.y());
	return x < 0 || y < 0 || x >= grey.cols || y >= grey.rows ? -1 : grey.at<float>(int(y), int(x));
}

/// Contrast of the circle at `place`, there or not, to the darkest of what lies around it (white circles: the brightest), so that a change of the
/// ground is not one: |around - middle| / (around + middle), negative when it is the other way round. -2: outside the picture.
/// `along`: half a step to the circle's neighbours on either side, between which is looked too; zero: not.
double Contrast(const cv::Mat& grey, const Board& board, const GridMap& map, const Vec2& place, bool bright, const Vec2& along = Vec2::Zero())
{
	const bool diagonal = board.kind == TargetKind::CIRCLES;
	std::vector<double> around;
	double middle = 0;
	for (const double side : { -1.0, 1.0 })
		if (const double far = along.isZero() ? -1 : Light(grey, map.Pixel(place + side * along)); far >= 0)
			around.push_back(far);
	for (int k = 0; k < 4; ++k)
	{
		const double t = Pi / 2 * k + (diagonal ? Pi / 4 : 0);
		const Vec2 way(std::cos(t), std::sin(t));
		const double far = Light(grey, map.Pixel(place + (diagonal ? std::sqrt(0.5) : 1) * way)), near = Light(grey, map.Pixel(place + 0.4 * board.CircleRadius() * way));
		if (near < 0)
			return -2;
		middle += near / 4;
		if (far >= 0)
			around.push_back(far);
	}
	// A grid may reach to the picture's rim.
	if (around.size() < 2)
		return -2;
	const double ground = bright ? *std::max_element(around.begin(), around.end()) : *std::min_element(around.begin(), around.end());
	return (bright ? -1 : 1) * (ground - middle) / std::max(ground + middle, 1e-9);
}

/// Whether the points lie as a grid does, and there is a circle at each.
bool Plausible(const cv::Mat& grey, const Board& board, const std::vector<Corner>& centres, bool bright)
{
	const GridMap map(centres);
	size_t good = 0;
	for (const Corner& c : centres)
	{
		const Vec2 place(c.column, c.row);
		const double side = std::sqrt(std::abs(map.Jacobian(place).determinant()));
		if (!((map.Pixel(place) - Vec2(c.x, c.y)).norm() < 0.15 * side))
			return false;
		good += Contrast(grey, board, map, place, bright) > 0.1;
	}
	return good >= centres.size() * 95 / 100;
}

/// A grid is as much of a larger one as of itself.
void RefuseLarger(const cv::Mat& grey, const Board& board, const std::vector<Corner>& centres, bool bright, const std::string& file)
{
	const GridMap map(centres);
	// `along`: half a step along the row or column. Where the ground ends beyond the outermost circles, and the picture soon after, only what lies beside a place tells that it is no circle.
	const auto least = [&](const Vec2& along)
	{
		std::vector<double> inside;
		for (const Corner& c : centres)
			inside.push_back(Contrast(grey, board, map, Vec2(c.column, c.row), bright, along));
		return 0.4 * Median(inside);
	};
	const auto check = [&](const char* side, int count, const Vec2& along, double least_contrast, auto place)
	{
		std::vector<double> beyond;
		for (int k = 0; k < count; ++k)
		{
			const double c = Contrast(grey, board, map, place(k), bright, along);
			if (c > -2)
				beyond.push_back(c);
		}
		if (2 * beyond.size() >= size_t(count) && Median(beyond) > least_contrast)
			throw Refused(fmt::format("{}: the grid goes on beyond {}x{} circles at its {}: count the circles again for `board`", file, board.columns, board.rows, side));
	};
	// Contrast() looks there anyway in asymmetric grids.
	const double half = board.kind == TargetKind::CIRCLES ? 0.5 : 0;
	const Vec2 across(half, 0), down(0, half);
	const double least_of_columns = least(down), least_of_rows = least(across);
	check("left", board.rows, down, least_of_columns, [&](int j) { return Vec2(board.CircleColumn(-1, j), j); });
	check("right", board.rows, down, least_of_columns, [&](int j) { return Vec2(board.CircleColumn(board.columns, j), j); });
	check("top", board.columns, across, least_of_rows, [&](int i) { return Vec2(board.CircleColumn(i, -1), -1); });
	check("bottom", board.columns, across, least_of_rows, [&](int i) { return Vec2(board.CircleColumn(i, board.rows), board.rows); });
}

bool RightHanded(const Points& p, const Board& b)
{
	const cv::Point2f across = p[size_t(b.columns - 1)] - p[0], down = p[size_t((b.rows - 1) / 2 * 2 * b.columns)] - p[0];
	return across.x * down.y - across.y * down.x > 0;
}

void ReverseColumns(Points& p, const Board& b)
{
	for (int j = 0; j < b.rows; ++j)
		std::reverse(p.begin() + j * b.columns, p.begin() + (j + 1) * b.columns);
}

void ReverseRows(Points& p, const Board& b)
{
	ReverseColumns(p, b);
	std::reverse(p.begin(), p.end());
}

/// A square grid's numbering turned by 90 degrees.
void Turn90(Points& p, const Board& b)
{
	Points turned(p.size());
	for (int j = 0; j < b.rows; ++j)
		for (int i = 0; i < b.columns; ++i)
			turned[size_t(j * b.columns + i)] = p[size_t((b.columns - 1 - i) * b.columns + j)];
	p = turned;
}

/// Of the numberings that are alike the one that begins nearest to the picture's top left.
void BeginTopLeft(Points& p, const Board& b)
{
	const bool square = b.kind == TargetKind::CIRCLES && b.columns == b.rows;
	Points best = p;
	for (int k = 1; k < (square ? 4 : 2); ++k)
	{
		if (square)
			Turn90(p, b);
		else
			std::reverse(p.begin(), p.end());
		if (p[0].x + p[0].y < best[0].x + best[0].y)
			best = p;
	}
	p = best;
}

/// Right-handed in the picture (y down), and begun where the header says.
void Orient(Points& p, const Board& b, const DetectOptions& options, const std::string& file)
{
	// All grids look the same when their rows are counted from the other end.
	if (!RightHanded(p, b))
		ReverseRows(p, b);
	if (b.kind == TargetKind::CIRCLES)
	{
		BeginTopLeft(p, b);
		return;
	}
	if (p[size_t(b.columns - 1)].x < p[0].x && !options.any_orientation)
		throw Refused(fmt::format("{}: the picture is mirrored or the board is upside down (the circles cannot tell which): un-mirror or turn the picture, "
			"or pass `any_orientation` if the board really was upside down", file));
}

/// Where the brightness along rays from the centres is half way between inside and outside: the circles' radius, median, in units
/// of the spacing.
double SeenRadius(const cv::Mat& grey, const Board& board, const std::vector<Corner>& centres)
{
	const GridMap map(centres);
	std::vector<double> radii;
	for (const Corner& c : centres)
	{
		const Vec2 place = map.Place(Vec2(c.x, c.y));
		for (int k = 0; k < 8; ++k)
		{
			const double t = Pi / 4 * k, outer = 0.5 * board.CirclePitch(), step = outer / 60;
			const auto light = [&](double r) { return Light(grey, map.Pixel(place + r * Vec2(std::cos(t), std::sin(t)))); };
			const double in = light(0), out = light(outer);
			if (in < 0 || out < 0)
				continue;
			for (double r = step; r < outer; r += step)
				if ((light(r) - in) / (out - in) > 0.5)
				{
					radii.push_back(r - 0.5 * step);
					break;
				}
		}
	}
	return radii.empty() ? 0 : Median(radii);
}

/// Blobs' middles to centres.
void Unbias(std::vector<Corner>& centres, double radius)
{
	const std::vector<Corner> blobs = centres;
	for (int round = 0; round < 2; ++round)
	{
		const GridMap map(centres);
		for (size_t k = 0; k < centres.size(); ++k)
		{
			const Vec2 place(blobs[k].column, blobs[k].row), now(centres[k].x, centres[k].y);
			const Vec2 bias = CircleOutline(map, place, radius, now).Centroid() - now;
			centres[k].x = blobs[k].x - bias.x();
			centres[k].y = blobs[k].y - bias.y();
		}
	}
}

/// Longer sides, px, of the pictures that are searched; 0: as it is, when that is not large.
const double SIZES[] = { 900, 1500, 0, 600 };
const double LARGE = 2500;

struct Search
{
	const cv::Mat& grey;
	const Board& board;
	size_t most_blobs = 0;

	/// One picture; empty when there is nothing.
	Points In(const cv::Mat& picture, double scale, bool bright)
	{
		cv::Mat dark = picture;
		if (bright)
			cv::bitwise_not(picture, dark);
		cv::Mat full_from_small;
		cv::invertAffineTransform(ScaleMap(scale), full_from_small);
		// A single blob too many can lead OpenCV astray: the strictest choice first.
		for (const float convexity : { 0.95f, 0.85f })
		{
			const std::vector<cv::KeyPoint> keys = Blobs(dark, board, convexity);
			for (const double factor : { 2.5, 1.7 })   // what perspective spans, at most and usually
			{
				const Points blobs = OfOneSize(keys, factor);
				most_blobs = std::max(most_blobs, blobs.size());
				Points points = Grid(blobs, board);
				if (points.empty())
					continue;
				cv::transform(points, points, full_from_small);
				if (Plausible(grey, board, Numbered(points, board), bright))
					return points;
			}
		}
		return {};
	}

	Points Everywhere(bool& bright)
	{
		const cv::Mat picture = ForDetector(grey);
		const double longer = std::max(picture.cols, picture.rows);
		for (const bool flat : { false, true })
			for (const bool white : { false, true })
				for (const double size : SIZES)
				{
					const double scale = size == 0 ? 1 : size / longer;
					if (size == 0 ? longer > LARGE : longer <= 1.2 * size)
						continue;
					cv::Mat small;
					cv::resize(picture, small, cv::Size(), scale, scale, cv::INTER_AREA);
					// The window takes in a circle and its surroundings in grids of usual size.
					if (flat)
						small = Flatten(small, std::max(small.cols, small.rows) / 30.0);
					const Points points = In(small, scale, white);
					if (points.empty())
						continue;
					bright = white;
					return points;
				}
		return {};
	}
};

}

FoundCircles FindCircles(const cv::Mat& grey, const Board& board, const DetectOptions& options, const std::string& file)
{
	if (board.kind == TargetKind::ASYMMETRIC_CIRCLES && board.rows % 2 == 0)
		throw UsageError(fmt::format("`board` {}x{}: asymmetric grids with an even number of rows look the same turned by 180 degrees, and OpenCV does not find them reliably: "
			"use one with an odd number, such as 4x11", board.columns, board.rows));
	FoundCircles found;
	Search search{ grey, board };
	Points points = search.Everywhere(found.bright);
	const size_t wanted = size_t(board.columns * board.rows);
	if (points.empty())
		throw Refused(fmt::format("{}: no grid of {}x{} circles ({}) found; {} spots like circles of one size were seen, it has {}: are `board` and `target` right, is the whole grid in the picture "
			"with its margin, and inclined by no more than 60 degrees? Keep the blur's radius well below the circles'", file, board.columns, board.rows, NameOf(board.kind), search.most_blobs, wanted));
	Orient(points, board, options, file);
	found.centres = Numbered(points, board);
	RefuseLarger(grey, board, found.centres, found.bright, file);
	found.radius = SeenRadius(grey, board, found.centres);
	Unbias(found.centres, found.radius);
	return found;
}

}
