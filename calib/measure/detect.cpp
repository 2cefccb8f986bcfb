// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/detect.h"

#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "measure/find_board.h"

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using Points = std::vector<cv::Point2f>;

cv::Point2f& At(Points& p, const Board& b, int column, int row) { return p[static_cast<size_t>(row * b.InnerColumns() + column)]; }

/// Homography from board squares (column, row) to pixels.
cv::Matx33d BoardToPixels(const Points& points, const Board& board)
{
	Points squares;
	for (int j = 0; j < board.InnerRows(); ++j)
		for (int i = 0; i < board.InnerColumns(); ++i)
			squares.emplace_back(static_cast<float>(i), static_cast<float>(j));
	return cv::Matx33d(cv::findHomography(squares, points));
}

cv::Point2d Map(const cv::Matx33d& H, double column, double row)
{
	const cv::Vec3d p = H * cv::Vec3d(column, row, 1);
	return { p[0] / p[2], p[1] / p[2] };
}

/// Mean light in the middle of square (i, j); the square's first inner corner is (i-1, j-1).
/// Negative when it is outside the picture.
double SquareLight(const cv::Mat& grey, const cv::Matx33d& H, int i, int j)
{
	double sum = 0;
	for (const double u : { -0.75, -0.5, -0.25 })
		for (const double v : { -0.75, -0.5, -0.25 })
		{
			const cv::Point2d p = Map(H, i + u, j + v);
			const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
			if (x < 0 || y < 0 || x >= grey.cols || y >= grey.rows)
				return -1;
			sum += grey.at<float>(y, x);
		}
	return sum / 9;
}

/// How well squares of a range alternate: mean contrast (bright - dark) / (bright + dark)
/// of neighbours with (i + j) even taken as dark. +1 black at even, -1 black at odd.
double Alternation(const cv::Mat& grey, const cv::Matx33d& H, int i0, int i1, int j0, int j1)
{
	double sum = 0;
	int n = 0;
	for (int j = j0; j < j1; ++j)
		for (int i = i0; i < i1; ++i)
			for (const auto& [di, dj] : { std::pair{ 1, 0 }, std::pair{ 0, 1 } })
			{
				if (i + di >= i1 || j + dj >= j1)
					continue;
				double even = SquareLight(grey, H, i, j), odd = SquareLight(grey, H, i + di, j + dj);
				if (even < 0 || odd < 0)
					continue;
				if ((i + j) % 2 != 0)
					std::swap(even, odd);
				sum += (odd - even) / std::max(odd + even, 1e-9);
				++n;
			}
	return n ? sum / n : 0;
}

/// The detector can lock on to a part of a larger board, or take a margin for squares:
/// the outermost squares must alternate and what lies outside them must not.
void RefuseWrongSize(const cv::Mat& grey, const cv::Matx33d& H, const Board& b, const std::string& file)
{
	const double inside = std::abs(Alternation(grey, H, 1, b.columns - 1, 1, b.rows - 1));
	const struct { const char* side; double ring, beyond; } sides[] = {
		{ "left", Alternation(grey, H, 0, 1, 0, b.rows), Alternation(grey, H, -1, 0, 0, b.rows) },
		{ "right", Alternation(grey, H, b.columns - 1, b.columns, 0, b.rows), Alternation(grey, H, b.columns, b.columns + 1, 0, b.rows) },
		{ "top", Alternation(grey, H, 0, b.columns, 0, 1), Alternation(grey, H, 0, b.columns, -1, 0) },
		{ "bottom", Alternation(grey, H, 0, b.columns, b.rows - 1, b.rows), Alternation(grey, H, 0, b.columns, b.rows, b.rows + 1) },
	};
	for (const auto& s : sides)
	{
		if (std::abs(s.ring) < 0.4 * inside)
			throw Refused(fmt::format("{}: the outermost squares at the board's {} are missing: is `board` {}x{} right (squares, not inner corners), and is the whole board in the picture?",
				file, s.side, b.columns, b.rows));
		if (std::abs(s.beyond) > 0.4 * inside)
			throw Refused(fmt::format("{}: the board goes on beyond {}x{} squares at its {}: count the squares again for `board`",
				file, b.columns, b.rows, s.side));
	}
}

void Turn180(Points& points) { std::reverse(points.begin(), points.end()); }

/// Right-handed in the picture (y down): columns to the right, rows downwards. A
/// detector that counts rows upwards is corrected; on a plain checkerboard this is
/// a change of numbering, not of the picture.
void MakeRightHanded(Points& points, const Board& b)
{
	const cv::Point2f across = At(points, b, b.InnerColumns() - 1, 0) - At(points, b, 0, 0);
	const cv::Point2f down = At(points, b, 0, b.InnerRows() - 1) - At(points, b, 0, 0);
	if (across.x * down.y - across.y * down.x < 0)
		for (int j = 0; j < b.InnerRows(); ++j)
			std::reverse(points.begin() + j * b.InnerColumns(), points.begin() + (j + 1) * b.InnerColumns());
}

/// The columns run up or down the picture, to 15 degrees: neither way is more upright than the other.
bool OnItsSide(Points& points, const Board& b)
{
	const cv::Point2f across = At(points, b, b.InnerColumns() - 1, 0) - At(points, b, 0, 0);
	return std::abs(across.x) < 0.27f * std::abs(across.y);
}

bool UpsideDown(Points& points, const Board& b)
{
	return At(points, b, b.InnerColumns() - 1, 0).x < At(points, b, 0, 0).x;
}

/// Puts square (0, 0) at index 0.
///   columns + rows odd:  the ends differ in colour, black decides. A mirrored picture
///                        looks like a board upside down, and is refused as such.
///   both even:           black at (0, 0) and at the opposite corner; if both are white
///                        the picture is mirrored.
///   both odd:            all four corners alike: the picture's top left decides.
void Orient(Points& points, const cv::Mat& grey, const Board& b, const DetectOptions& options, const std::string& file)
{
	MakeRightHanded(points, b);
	if (OnItsSide(points, b) && !options.any_orientation)
		throw Refused(fmt::format("{}: the board stands on its side: its {} columns run up and down the picture. Is `board` {}x{} meant (columns are counted across the picture)? "
			"If camera or board was turned, turn all pictures upright, or pass `any_orientation`", file, b.columns, b.rows, b.columns));
	const bool black_first = Alternation(grey, BoardToPixels(points, b), 0, b.columns, 0, b.rows) > 0;
	if ((b.columns + b.rows) % 2 != 0)
	{
		if (!black_first)
			Turn180(points);
		if (UpsideDown(points, b) && !options.any_orientation)
			throw Refused(fmt::format("{}: the picture is mirrored or the board is upside down (colours cannot tell which): un-mirror or turn the picture, "
				"or pass `any_orientation` if the board really was upside down", file));
		return;
	}
	if (UpsideDown(points, b))
		Turn180(points);
	if (b.columns % 2 == 0 && !black_first)
		throw Refused(fmt::format("{}: the board's top left square is white: the picture is mirrored, or the board was turned by 90 degrees; un-mirror or turn it", file));
}

}

std::vector<Corner> DetectCorners(const cv::Mat& grey, const Board& board, const DetectOptions& options, const std::string& file)
{
	Points points = FindCheckerboard(grey, board, file);
	RefuseWrongSize(grey, BoardToPixels(points, board), board, file);
	Orient(points, grey, board, options, file);

	std::vector<Corner> corners;
	for (int j = 0; j < board.InnerRows(); ++j)
		for (int i = 0; i < board.InnerColumns(); ++i)
		{
			// A window as large as the neighbours allow: more of the blurred edges is seen.
			double side = 1e9;
			for (const auto& [di, dj] : { std::pair{ 1, 0 }, std::pair{ -1, 0 }, std::pair{ 0, 1 }, std::pair{ 0, -1 } })
			{
				if (i + di < 0 || j + dj < 0 || i + di >= board.InnerColumns() || j + dj >= board.InnerRows())
					continue;
				const cv::Point2f d = At(points, board, i + di, j + dj) - At(points, board, i, j);
				side = std::min(side, static_cast<double>(std::max(std::abs(d.x), std::abs(d.y))));
			}
			const int half = std::clamp(static_cast<int>(0.45 * side), 2, 100);
			Points one{ At(points, board, i, j) };
			// One that the finder puts beside the picture stays there; newer OpenCVs throw, by its nearest pixel.
			if (cv::Rect(0, 0, grey.cols, grey.rows).contains(cv::Point(one[0])))
				cv::cornerSubPix(grey, one, cv::Size(half, half), cv::Size(-1, -1),
					cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 60, 1e-4));
			const cv::Point2f moved = one[0] - At(points, board, i, j);
			if (std::hypot(moved.x, moved.y) > 0.25 * side)
				one[0] = At(points, board, i, j);
			// 0.05 px is what this refinement reaches in blur up to 0.2 squares; edges give a better one.
			corners.push_back({ i, j, one[0].x, one[0].y, 0.05 });
		}
	return corners;
}

}
