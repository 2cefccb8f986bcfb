// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/measure_colours.h"

#include <tiltcal/photo.h>
#include "model/footprint.h"
#include "edge/soft_radius.h"
#include "measure/measure_edge.h"
#include "picture/image_io.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Of a photograph: three fits each, so that a calibration takes about a quarter longer.
const size_t EDGES = 24;

/// Channels of a photograph in colour differ by noise at least. `white`: the light that is white.
bool ChannelsDiffer(const std::vector<cv::Mat>& channels, double white)
{
	const float least = float(0.002 * white);
	size_t different = 0, all = 0;
	for (int y = 0; y < channels[0].rows; y += 3)
		for (int x = 0; x < channels[0].cols; x += 3, ++all)
			different += std::abs(channels[2].at<float>(y, x) - channels[1].at<float>(y, x)) + std::abs(channels[0].at<float>(y, x) - channels[1].at<float>(y, x)) > least;
	return 1000 * different > all;
}

/// The edges measured, in the order of SpreadOrder.
std::vector<const Edge*> Spread(const Photo& photo, const Board& board)
{
	std::vector<const Edge*> spread;
	for (const EdgePlace& place : SpreadOrder(board, 0))
		for (const Edge& e : photo.edges)
			if (e.column == place.column && e.row == place.row && e.along_columns == place.along_columns && e.BlurRatio() < LONE_RATIO)
				spread.push_back(&e);
	if (spread.size() > EDGES)
		spread.resize(EDGES);
	return spread;
}

/// False: not all three were measured.
bool Measure(const std::vector<cv::Mat>& channels, const CornerGrid& grid, const std::vector<LightField>& light, const Edge& edge, ColourEdge& out)
{
	Edge fits[3];   // blue, green, red
	for (size_t k = 0; k < 3; ++k)
		if (MeasureLoneEdge(channels[k], grid, light[k], { edge.column, edge.row, edge.along_columns }, fits[k]) != EdgeOutcome::MEASURED)
			return false;
	out.green = fits[1];
	out.green.profile.clear();
	const Point normal = EdgeNormal(out.green);
	for (size_t k = 0; k < 2; ++k)
	{
		const Edge& colour = fits[k == 0 ? 2 : 0];
		out.shift[k] = (colour.x - out.green.x) * normal[0] + (colour.y - out.green.y) * normal[1];
		out.shift_sigma[k] = std::hypot(colour.offset_sigma, out.green.offset_sigma);
		out.widening[k] = SoftDiameter(colour.blur) - SoftDiameter(out.green.blur);
		out.widening_sigma[k] = std::hypot(colour.blur_sigma, out.green.blur_sigma);
	}
	return true;
}

}

void MeasureColours(const cv::Mat& linear, const Board& board, Photo& photo)
{
	photo.coloured = false;
	photo.colours.clear();
	if (linear.channels() != 3)
		return;
	std::vector<cv::Mat> channels;
	cv::split(linear, channels);
	photo.coloured = ChannelsDiffer(channels, photo.facts.floating_point ? BrightestHundredth(linear) : 1);
	if (!photo.coloured || !board.IsCheckerboard() || photo.facts.subsampled_colour)
		return;
	const CornerGrid grid(photo, board);
	std::vector<LightField> light;
	for (const cv::Mat& channel : channels)
		light.emplace_back(channel, grid);
	const std::vector<const Edge*> edges = Spread(photo, board);
	std::vector<ColourEdge> measured(edges.size());
	std::vector<char> good(edges.size(), 0);
	cv::parallel_for_(cv::Range(0, int(edges.size())), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
			good[size_t(k)] = Measure(channels, grid, light, *edges[size_t(k)], measured[size_t(k)]);
	});
	for (size_t k = 0; k < edges.size(); ++k)
		if (good[k])
			photo.colours.push_back(measured[k]);
}

}
