// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/find_board.h"

#include "lens/angles.h"
#include <tiltcal/error.h>
#include "picture/image_io.h"

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

/// Full-scale corners found in `picture`, which `small_from_full` (2x3, pixel centres) made; empty when not found.
Points Find(const cv::Mat& picture, cv::Size size, const cv::Mat& small_from_full, int flags, cv::Mat* meta = nullptr)
{
	Points points;
	cv::Mat unused;
	try
	{
		if (!cv::findChessboardCornersSB(picture, size, points, flags, meta ? *meta : unused))
			return {};
	}
	catch (const cv::Exception&)   // of OpenCV 4.10, where it looks for a corner beside the picture
	{
		return {};
	}
	cv::Mat full_from_small;
	cv::invertAffineTransform(small_from_full, full_from_small);
	cv::transform(points, points, full_from_small);
	return points;
}

Points FindAtScale(const cv::Mat& picture, cv::Size size, double scale, int flags, cv::Mat* meta = nullptr)
{
	cv::Mat small;
	cv::resize(picture, small, cv::Size(), scale, scale, cv::INTER_AREA);
	return Find(small, size, ScaleMap(scale), flags | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY, meta);
}

/// Longer side, px, of pictures whose detection at full scale takes long.
const double LARGE = 2000;

/// Scales to try: blurred corners are found best when squares are some 20 to 60 pixels. OpenCV misses a plain board at one scale in ten; the last two are for that, where a board
/// of `inner` corners that fills the picture has squares of 40 and of 28 pixels.
std::vector<double> Scales(const cv::Mat& picture, cv::Size inner)
{
	const double longer = std::max(picture.cols, picture.rows), squares = std::max(inner.width, inner.height) + 1;
	std::vector<double> scales;
	const auto reduce_to = [&](double target)
	{
		if (longer > target * 1.2)
			scales.push_back(target / longer);
	};
	for (const double target : { 900.0, 1500.0, 600.0 })
		reduce_to(target);
	if (longer <= LARGE)
		scales.push_back(1);
	// In smaller pictures anything looks like a board of few squares.
	for (const double square : { 40.0, 28.0 })
		reduce_to(std::max(250.0, square * squares));
	return scales;
}

/// Reduced by `scale` and stretched twofold in direction `degrees`; `map` receives small_from_full.
cv::Mat Stretch(const cv::Mat& picture, double scale, double degrees, cv::Mat& map)
{
	const double c = std::cos(degrees * tilt_lens::Pi / 180), s = std::sin(degrees * tilt_lens::Pi / 180);
	const cv::Matx22d A = scale * cv::Matx22d(1 + c * c, c * s, c * s, 1 + s * s);
	double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
	for (const double x : { 0.0, picture.cols - 1.0 })
		for (const double y : { 0.0, picture.rows - 1.0 })
		{
			const cv::Vec2d p = A * cv::Vec2d(x, y);
			x0 = std::min(x0, p[0]), x1 = std::max(x1, p[0]);
			y0 = std::min(y0, p[1]), y1 = std::max(y1, p[1]);
		}
	map = (cv::Mat_<double>(2, 3) << A(0, 0), A(0, 1), -x0, A(1, 0), A(1, 1), -y0);
	// The warp takes single pixels: take the mean over what falls together first.
	cv::Mat smooth, warped;
	cv::GaussianBlur(picture, smooth, cv::Size(), 0.3 / scale);
	cv::warpAffine(smooth, warped, map, cv::Size(static_cast<int>(x1 - x0) + 1, static_cast<int>(y1 - y0) + 1), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
	return warped;
}

/// Widths of Flatten's window, px of the reduced picture: half a square to a square of boards of usual size.
const double WINDOWS[] = { 14, 30 };

/// Reduced sizes at which flattened pictures are searched, px.
const double FLAT_SIZES[] = { 800, 450 };

/// Strongly blurred or vignetted boards.
Points FindFlattened(const cv::Mat& picture, cv::Size size)
{
	for (const double target : FLAT_SIZES)
	{
		const double scale = std::min(1.0, target / std::max(picture.cols, picture.rows));
		cv::Mat small;
		cv::resize(picture, small, cv::Size(), scale, scale, cv::INTER_AREA);
		for (const double window : WINDOWS)
		{
			Points points = Find(Flatten(small, window), size, ScaleMap(scale), 0);
			if (!points.empty())
				return points;
		}
	}
	return {};
}

/// Foreshortened boards.
Points FindStretched(const cv::Mat& picture, cv::Size size)
{
	for (const double target : FLAT_SIZES)
		for (const double degrees : { 90.0, 0.0, 45.0, 135.0 })
		{
			const double scale = std::min(1.0, target / std::max(picture.cols, picture.rows));
			cv::Mat map;
			const cv::Mat stretched = Stretch(picture, scale, degrees, map);
			for (const double window : WINDOWS)
			{
				Points points = Find(Flatten(stretched, window), size, map, 0);
				if (!points.empty())
					return points;
			}
		}
	return {};
}

/// Inner corners (longer, shorter side) of the largest grid seen; 0x0 where there is none of 4x4.
cv::Size LargestGrid(const cv::Mat& picture)
{
	cv::Mat meta;
	const double scale = std::min(1.0, 900.0 / std::max(picture.cols, picture.rows));
	FindAtScale(picture, cv::Size(3, 3), scale, cv::CALIB_CB_LARGER, &meta);
	// Small grids are found in any texture; they would mislead.
	return std::min(meta.cols, meta.rows) < 4 ? cv::Size() : cv::Size(std::max(meta.cols, meta.rows), std::min(meta.cols, meta.rows));
}

[[noreturn]] void RefuseNotFound(const std::string& file, const Board& board, cv::Size seen)
{
	const std::string what = fmt::format("{}: no board of {}x{} squares found: ", file, board.columns, board.rows);
	if (seen.width > 0 && seen != cv::Size(board.InnerColumns(), board.InnerRows()))
		throw Refused(what + fmt::format("it shows about {}x{} squares; is `board` {}x{} right (squares, not inner corners), and is the whole board in the picture?",
			seen.width + 1, seen.height + 1, board.columns, board.rows));
	throw Refused(what + "show the whole board with its white margin, inclined by no more than 60 degrees, and keep the radius of the blur below 0.4 of a square "
		"(stop down, or move the board nearer to the plane of focus)");
}

}

cv::Mat ScaleMap(double scale)
{
	return (cv::Mat_<double>(2, 3) << scale, 0, 0.5 * (scale - 1), 0, scale, 0.5 * (scale - 1));
}

cv::Mat Flatten(const cv::Mat& picture, double window)
{
	cv::Mat value, mean, square;
	picture.convertTo(value, CV_32F);
	cv::GaussianBlur(value, mean, cv::Size(), window);
	value -= mean;
	cv::GaussianBlur(value.mul(value), square, cv::Size(), window);
	double most = 0;
	cv::minMaxLoc(square, nullptr, &most);
	cv::Mat flat(picture.size(), CV_8UC1);
	const float least = static_cast<float>(1e-3 * std::sqrt(most) + 1e-6);
	for (int y = 0; y < flat.rows; ++y)
		for (int x = 0; x < flat.cols; ++x)
		{
			const float z = value.at<float>(y, x) / (std::sqrt(square.at<float>(y, x)) + least);
			flat.at<uchar>(y, x) = cv::saturate_cast<uchar>(127.5f + 127.5f * std::tanh(3 * z));
		}
	return flat;
}

cv::Mat ForDetector(const cv::Mat& grey)
{
	return ToDisplay(grey, 0.9 / std::max(BrightestHundredth(grey), 1e-6));
}

std::vector<cv::Point2f> FindCheckerboard(const cv::Mat& grey, const Board& board, const std::string& file)
{
	const cv::Mat picture = ForDetector(grey);
	const cv::Size size(board.InnerColumns(), board.InnerRows());
	for (const double scale : Scales(picture, size))
	{
		Points points = FindAtScale(picture, size, scale, 0);
		if (!points.empty())
			return points;
	}
	// A grid that is larger in a direction is another board, not a part of this one; one of the same size stands the other way.
	const cv::Size seen = LargestGrid(picture), asked(std::max(size.width, size.height), std::min(size.width, size.height));
	const bool another = seen == asked || seen.width > asked.width || seen.height > asked.height;
	// Smaller pictures hold no board of 4x4 squares, and the windows do not fit in.
	const int longer = std::max(picture.cols, picture.rows), shorter = std::min(picture.cols, picture.rows);
	Points points;
	if (!another && shorter >= 40)
		points = FindFlattened(picture, size);
	// All of a large picture's pixels are of use only to boards that are small in it.
	if (points.empty() && !another && longer > LARGE)
		points = FindAtScale(picture, size, std::min(1.0, 3000.0 / longer), 0);
	if (points.empty() && !another && shorter >= 40)
		points = FindStretched(picture, size);
	if (points.empty())
		RefuseNotFound(file, board, seen);
	return points;
}

}
