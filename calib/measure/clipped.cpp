// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/clipped.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tiltcal
{

namespace
{

/// Full scale, less the roundings of a transfer curve.
const double FULL_SCALE = 0.995;
/// At the white level, of all pixels, at least.
const double LEAST_SHARE = 1e-4;
/// And of those within 2 % below it: noise's own greatest value is had by a few of many.
const double LEAST_PILE = 0.2;

/// So many equal pixels in a row: with noise of half a step of the file two neighbours are equal in 0.56 of cases, 16 in 2e-4.
const int FLAT_RUN = 16;
/// Of a picture's dark pixels in such rows, at most, where it has noise.
const double MOST_FLAT = 0.05;

/// Whether dark pixels differ from their neighbours, as noise makes them everywhere; in a render, light that falls off makes some of them differ too.
bool HasNoise(const cv::Mat& channel, double most)
{
	size_t dark = 0, equal = 0, flat = 0;
	for (int y = 0; y < channel.rows; y += 3)
	{
		const float* row = channel.ptr<float>(y);
		for (int x = 0, run = 1; x + 1 < channel.cols; ++x)
		{
			run = x > 0 && row[x] == row[x - 1] ? run + 1 : 1;
			if (!(row[x] < 0.5 * most))
				continue;
			++dark;
			equal += row[x] == row[x + 1];
			// Black may be clipped too.
			if (row[x] > 0 && run >= FLAT_RUN)
				flat += run == FLAT_RUN ? FLAT_RUN : 1;
		}
	}
	return 2 * equal < dark && double(flat) < MOST_FLAT * double(dark);
}

std::optional<double> WhiteLevel(const cv::Mat& channel)
{
	double most = 0;
	cv::minMaxLoc(channel, nullptr, &most);
	if (!(most > 0))
		return std::nullopt;
	const double pixels = double(channel.total());
	const double at = cv::countNonZero(channel >= most * (1 - 1e-6)), below = cv::countNonZero(channel >= most * 0.98) - at;
	if (at < LEAST_SHARE * pixels)
		return std::nullopt;
	if (most >= FULL_SCALE && most <= 1)
		return FULL_SCALE;
	if (at < LEAST_PILE * below || !HasNoise(channel, most))
		return std::nullopt;
	return most * (1 - 1e-6);
}

}

cv::Mat ClippedPixels(const cv::Mat& linear)
{
	std::vector<cv::Mat> channels;
	cv::split(linear, channels);
	cv::Mat clipped;
	for (const cv::Mat& channel : channels)
	{
		const std::optional<double> white = WhiteLevel(channel);
		if (!white)
			continue;
		const cv::Mat here = channel >= *white;
		clipped = clipped.empty() ? here : cv::Mat(clipped | here);
	}
	return clipped;
}

double ClippedShare(const cv::Mat& clipped, const Photo& photo)
{
	if (clipped.empty() || photo.edges.empty())
		return 0;
	int edges = 0;
	for (const Edge& e : photo.edges)
	{
		// Where only bright light is: from beyond the blur to half way to the next edge.
		const double from = 0.5 * std::max(e.blur, 0.0) + 1, to = std::max(from + 1, 0.45 * e.square_px);
		int seen = 0, hit = 0;
		for (int i = 0; i <= 4; ++i)
			for (int j = -2; j <= 2; ++j)
			{
				const double t = from + i * (to - from) / 4, s = 0.1 * j * e.square_px;
				const int x = int(std::lround(e.x + t * e.nx + s * e.ny)), y = int(std::lround(e.y + t * e.ny - s * e.nx));
				if (x < 0 || y < 0 || x >= clipped.cols || y >= clipped.rows)
					continue;
				++seen;
				hit += clipped.at<uchar>(y, x) != 0;
			}
		edges += 5 * hit > seen;
	}
	return edges / double(photo.edges.size());
}

}
