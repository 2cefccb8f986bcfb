// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What denoise makes of a setting: the renderer's own function, run over the pilot's blocks.

#include "tiltcost/prediction.h"

#include "lens/denoise.h"

#include <algorithm>
#include <cmath>

namespace tiltcost
{

namespace
{

double Clipped(double x) { return std::min(1.0, std::max(0.0, x)); }

/// Pixels so near a block's edge lack neighbours that they have in the picture.
const int EdgePixels = 4;

}

/// Squared errors of the block's inner pixels, averaged over the channels, summed. `known`: the level that each pixel
/// stops at.
double Pilot::DenoisedError(const Block& block, const std::vector<size_t>& known) const
{
	tilt_lens::NoisyPicture picture;
	picture.Resize(block.width, block.height);
	std::vector<float> denoised[tilt_lens::PictureChannels];
	for (auto& plane : denoised)
		plane.assign(block.pixels.size(), 0.0f);
	for (size_t i = 0; i < block.pixels.size(); ++i)
	{
		const auto& levels = block.pixels[i].levels;
		picture.count[i] = float(std::size_t(1) << known[i]);
		for (int c = 0; c < 3; ++c)
		{
			picture.mean[c][i] = levels[known[i]].mean[c];
			picture.first[c][i] = levels[known[i] > 0 ? known[i] - 1 : 0].mean[c];
		}
	}
	tilt_lens::DenoiseRows(picture, 0, block.height - 1, denoised);

	double sum = 0;
	for (size_t i = 0; i < block.pixels.size(); ++i)
		if (IsInside(block, int(i) % block.width, int(i) / block.width, EdgePixels))
			for (int c = 0; c < 3; ++c)
				sum += std::pow(Clipped(denoised[c][i]) - Clipped(block.pixels[i].levels.back().mean[c]), 2) / 3;
	return sum;
}

double Pilot::PredictDenoised(const Setting& setting) const
{
	const std::vector<tilt_lens::SampleLevel> levels = tilt_lens::SampleLevels(setting.min, setting.max, setting.variance, setting.confidence, &Chi2);
	double sum = 0, pixels = 0;
	for (const Block& block : blocks)
	{
		std::vector<size_t> known;
		for (const size_t level : LevelsOf(block, levels))
			known.push_back(Known(levels[level].samples));
		sum += DenoisedError(block, known);
		for (int i = 0; i < block.width * block.height; ++i)
			pixels += IsInside(block, i % block.width, i / block.width, EdgePixels);
	}
	// The truth's own noise adds where a pixel keeps little of its own mean, and takes away where it keeps much: left out.
	return std::sqrt(sum / pixels);
}

}
