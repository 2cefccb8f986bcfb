// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/bright_patches.h"

#include <tiltcal/photo.h>
#include "measure/clipped.h"
#include "measure/corner_grid.h"
#include <tiltcal/error.h>
#include "picture/image_io.h"
#include "base/robust.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

/// Fewer pixels are no patch.
const size_t FEWEST_PIXELS = 25;

/// Beyond the blur: half a pixel's diagonal, and what corners and the lens's own blur are off by.
const double BEYOND_BLUR_PX = 1.5;

/// The paper goes on beyond the outermost corners, where the grid is continued from its inside: to some hundredths of a square.
const double OUTER_SHARE = 0.08;

struct Pictures
{
	cv::Mat grey, clipped;   ///< luminance; 255 where a channel is clipped, or empty
};

/// The pixels of one patch as they come.
struct Pixels
{
	std::vector<double> values;
	double u = 0, v = 0;
	size_t clipped = 0;

	void Add(const Pictures& p, int x, int y)
	{
		values.push_back(p.grey.at<float>(y, x));
		u += x;
		v += y;
		clipped += !p.clipped.empty() && p.clipped.at<uchar>(y, x) != 0;
	}

	bool Clipped() const { return 20 * clipped > values.size(); }

	/// Mean of the middle half of the values, which dust and scratches do not move; normal values scatter about it by
	/// 1.09 times as much as about the mean.
	BrightPatch Patch()
	{
		const size_t n = values.size(), from = n / 4, to = n - n / 4;
		std::sort(values.begin(), values.end());
		double all = 0, squares = 0, middle = 0;
		for (size_t k = 0; k < n; ++k)
		{
			all += values[k];
			squares += values[k] * values[k];
			middle += k >= from && k < to ? values[k] : 0;
		}
		const double variance = std::max(squares / double(n) - std::pow(all / double(n), 2), 0.0);
		return { u / double(n), v / double(n), middle / double(to - from), 1.09 * std::sqrt(variance / double(n)), 0, 0 };
	}
};

/// Pixels no nearer than `margin` to the sides of a convex figure. (Distances to its sides' lines.)
template<typename Each>
void ForEachInside(const std::vector<Vec2>& corners, double margin, const cv::Size& size, const Each& each)
{
	Vec2 least = corners[0], most = corners[0], centre = Vec2::Zero();
	for (const Vec2& c : corners)
	{
		least = least.cwiseMin(c);
		most = most.cwiseMax(c);
		centre += c / double(corners.size());
	}
	for (int y = std::max(0, int(std::ceil(least.y()))); y <= std::min(size.height - 1, int(std::floor(most.y()))); ++y)
		for (int x = std::max(0, int(std::ceil(least.x()))); x <= std::min(size.width - 1, int(std::floor(most.x()))); ++x)
		{
			bool inside = true;
			for (size_t k = 0; k < corners.size() && inside; ++k)
			{
				const Vec2& a = corners[k];
				const Vec2 along = (corners[(k + 1) % corners.size()] - a).normalized(), normal(-along.y(), along.x());
				const double side = normal.dot(centre - a) < 0 ? -1 : 1;
				inside = side * normal.dot(Vec2(x, y) - a) >= margin;
			}
			if (inside)
				each(x, y);
		}
}

/// Largest blur of the edges that touch the four features from (i, j) to (i + 1, j + 1); of the whole photograph where few do.
double BlurAround(const Photo& photo, int i, int j)
{
	double near = 0, all = 0;
	int count = 0;
	for (const Edge& e : photo.edges)
	{
		all = std::max(all, e.blur);
		bool touches = false;
		for (int k = 0; k < 4; ++k)
			touches = touches || e.Touches(i + k % 2, j + k / 2);
		near = touches ? std::max(near, e.blur) : near;
		count += touches;
	}
	return count >= 3 ? near : all;
}

/// Square (i, j) between the features (i, j) and (i + 1, j + 1), those outside of the grid continued.
Pixels SquarePixels(const Pictures& pictures, const Board& board, const CornerGrid& grid, const Photo& photo, int i, int j)
{
	const std::vector<Vec2> corners{ grid.At(i, j), grid.At(i + 1, j), grid.At(i + 1, j + 1), grid.At(i, j + 1) };
	const bool outer = i < 0 || j < 0 || i + 1 >= board.InnerColumns() || j + 1 >= board.InnerRows();
	double side = HUGE_VAL;
	for (size_t k = 0; k < 4; ++k)
		side = std::min(side, (corners[(k + 1) % 4] - corners[k]).norm());
	const double margin = 0.5 * BlurAround(photo, i, j) + BEYOND_BLUR_PX + (outer ? OUTER_SHARE * side : 0);
	Pixels pixels;
	ForEachInside(corners, margin, pictures.grey.size(), [&](int x, int y) { pixels.Add(pictures, x, y); });
	return pixels;
}

void MeasureSquares(const Pictures& pictures, const Board& board, Photo& photo)
{
	const CornerGrid grid(photo, board);
	std::vector<BrightPatch> patches[2];
	int clipped[2] = { 0, 0 };
	for (int j = -1; j < board.InnerRows(); ++j)
		for (int i = -1; i < board.InnerColumns(); ++i)
		{
			Pixels pixels = SquarePixels(pictures, board, grid, photo, i, j);
			const int parity = (i + j) & 1;
			if (pixels.values.size() < FEWEST_PIXELS)
				continue;
			if (pixels.Clipped())
			{
				++clipped[parity];
				continue;
			}
			BrightPatch patch = pixels.Patch();
			patch.board_column = i + 0.5;
			patch.board_row = j + 0.5;
			patches[parity].push_back(patch);
		}
	const auto brightness = [&](int parity)
	{
		std::vector<double> values(size_t(clipped[parity]), HUGE_VAL);
		for (const BrightPatch& p : patches[parity])
			values.push_back(p.value);
		return values.empty() ? 0 : Median(values);
	};
	const int white = brightness(0) > brightness(1) ? 0 : 1;
	photo.white = patches[white];
	photo.white_saturated = clipped[white];
}

/// Whether neighbouring cells differ as only a pattern makes them: brightness falls off smoothly, and by a rim steeply, but then in a narrow part of
/// the picture. Judged by second differences, which a gradient does not have.
bool ShowsAPattern(const std::vector<BrightPatch>& cells, int columns)
{
	const double STEEP = 0.03;         // of the brightness; cos^4 of a 17 mm lens on 36 mm has 0.005 from cell to cell
	const double MOST_STEEP = 0.15;    // of the cells; two rims of a lens that is wide open reach 0.1
	size_t steep = 0, judged = 0;
	for (size_t k = 1; k + 1 < cells.size(); ++k)
	{
		if (k % size_t(columns) == 0 || (k + 1) % size_t(columns) == 0)
			continue;
		const BrightPatch &l = cells[k - 1], &m = cells[k], &r = cells[k + 1];
		const double noise = std::sqrt(l.sigma * l.sigma + 4 * m.sigma * m.sigma + r.sigma * r.sigma);
		steep += std::abs(l.value - 2 * m.value + r.value) > 4 * noise + STEEP * std::max(m.value, 0.0);
		++judged;
	}
	return judged > 0 && double(steep) > MOST_STEEP * double(judged);
}

/// ClippedPixels of a plain bright surface. One that is clipped nearly everywhere has no darker pixels whose noise tells its white level from a
/// render's even light; no lens lights half of a picture to the very same value.
cv::Mat ClippedField(const cv::Mat& linear)
{
	cv::Mat clipped = ClippedPixels(linear);
	std::vector<cv::Mat> channels;
	cv::split(linear, channels);
	for (const cv::Mat& channel : channels)
	{
		double most = 0;
		cv::minMaxLoc(channel, nullptr, &most);
		const cv::Mat here = channel >= most;
		if (2 * size_t(cv::countNonZero(here)) > channel.total())
			clipped = clipped.empty() ? here : cv::Mat(clipped | here);
	}
	return clipped;
}

}

void MeasureWhite(const cv::Mat& linear, const Board& board, Photo& photo)
{
	photo.white.clear();
	photo.white_saturated = 0;
	if (board.IsCheckerboard())
		MeasureSquares({ Luminance(linear), ClippedPixels(linear) }, board, photo);
}

std::vector<BrightPatch> MeasureFlatField(const cv::Mat& linear, const std::string& file, bool floating_point)
{
	const Pictures pictures{ Luminance(linear), ClippedField(linear) };
	const int cell = std::max(4, linear.cols / 40), columns = linear.cols / cell, rows = linear.rows / cell;
	std::vector<BrightPatch> patches, all;
	int clipped = 0;
	for (int j = 0; j < rows; ++j)
		for (int i = 0; i < columns; ++i)
		{
			Pixels pixels;
			for (int y = j * cell; y < (j + 1) * cell; ++y)
				for (int x = i * cell; x < (i + 1) * cell; ++x)
					pixels.Add(pictures, x, y);
			all.push_back(pixels.Patch());
			if (pixels.Clipped())
				++clipped;
			else
				patches.push_back(all.back());
		}
	if (2 * clipped > columns * rows)
		throw Refused(fmt::format("`flat_field` {}: {} of {} cells are clipped, which hides the fall-off: expose less, so that the brightest part stays below full scale (a render of one even colour has no fall-off to tell)", file, clipped, columns * rows));
	double brightest = 0;
	for (const BrightPatch& p : patches)
		brightest = std::max(brightest, p.value);
	if (floating_point && !(brightest > 0))
		throw Refused(fmt::format("`flat_field` {}: is black", file));
	if (!floating_point && brightest < 0.01)
		throw Refused(fmt::format("`flat_field` {}: the brightest cell is {:.4f} of full scale: too dark to measure; expose more", file, brightest));
	if (ShowsAPattern(all, columns))
		throw Refused(fmt::format("`flat_field` {}: shows a pattern, not an evenly lit plain surface: photograph a white wall or paper out of focus, or leave it out", file));
	return patches;
}

}
