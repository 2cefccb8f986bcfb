// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/find_crossing.h"

#include "lens/angles.h"
#include "picture/image_io.h"

#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

/// Standard deviation around the crossing: below 2 of 255 levels noise of 8-bit photographs is as large.
const double LEAST_CONTRAST = 2 / 255.;
/// Opposite sides of a crossing are alike (correlation 1), of an edge opposite (-1), of a box's corner unrelated.
const double LEAST_LIKENESS = 0.7;

bool Inside(const cv::Mat& image, const cv::Point2d& p, double margin)
{
	return p.x >= margin && p.y >= margin && p.x <= image.cols - 1 - margin && p.y <= image.rows - 1 - margin;
}

/// Whether the brightness on a circle around `p` repeats after half a turn and not after a quarter.
bool IsCrossing(const cv::Mat& grey, const cv::Point2d& p, double radius)
{
	constexpr size_t STEPS = 64;
	std::array<double, STEPS> g;
	double mean = 0;
	for (size_t i = 0; i < STEPS; ++i)
	{
		const double angle = 2 * tilt_lens::Pi * static_cast<double>(i) / STEPS;
		g[i] = Bilinear(grey, p.x + radius * std::cos(angle), p.y + radius * std::sin(angle));
		mean += g[i] / STEPS;
	}
	double variance = 0, half_turn = 0, quarter_turn = 0;
	for (size_t i = 0; i < STEPS; ++i)
	{
		variance += (g[i] - mean) * (g[i] - mean) / STEPS;
		half_turn += (g[i] - mean) * (g[(i + STEPS / 2) % STEPS] - mean) / STEPS;
		quarter_turn += (g[i] - mean) * (g[(i + STEPS / 4) % STEPS] - mean) / STEPS;
	}
	return variance > LEAST_CONTRAST * LEAST_CONTRAST && half_turn > LEAST_LIKENESS * variance && quarter_turn < 0;
}

/// cv::cornerSubPix, which returns its start where it gives up.
cv::Point2f Refined(const cv::Mat& grey, const cv::Point2f& start, int half)
{
	std::vector<cv::Point2f> one{ start };
	cv::cornerSubPix(grey, one, { half, half }, { -1, -1 }, { cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-3 });
	return one[0];
}

}

std::optional<cv::Point2d> FindCrossing(const cv::Mat& grey, const cv::Point2d& start, int half, double reach)
{
	// cornerSubPix asks for five pixels around its window.
	if (!Inside(grey, start, half + 5))
		return {};
	const cv::Point2f first = start, found = Refined(grey, first, half);
	// Right where it was looked for, or given up? From beside it a crossing is found all the same.
	if (found == first && !(cv::norm(Refined(grey, first + cv::Point2f(0.6f, -0.4f), half) - first) < 0.1))
		return {};
	const double radius = 0.7 * half;
	if (!(cv::norm(found - first) <= reach) || !Inside(grey, found, radius + 1) || !IsCrossing(grey, found, radius))
		return {};
	return cv::Point2d(found);
}

}
