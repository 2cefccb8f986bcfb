// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What denoise makes of a setting: the renderer's own function, run over the pilot's blocks.

#include "tiltcost/prediction.h"

#include "lens/denoise.h"
#include "program/process.h"

#include <algorithm>
#include <cmath>

namespace tiltcost
{

namespace
{

double Clipped(double x) { return std::min(1.0, std::max(0.0, x)); }

/// Sums over a block's inner pixels.
struct Errors
{
	double denoised = 0, raw = 0;      ///< squared
	double pixels = 0;
};

/// Pixels so near a block's edge lack neighbours that they have in the picture.
const int EdgePixels = 4;

}

/// Of the block's inner pixels, added to the class of the level that each stops at. `known`: that level, by pixel.
void Pilot::AddDenoised(const Block& block, const std::vector<size_t>& known, std::vector<DenoisedClass>& classes) const
{
	tilt_lens::NoisyPicture picture;
	picture.Resize(block.width, block.height);
	std::vector<float> denoised[tilt_lens::PictureChannels], own(block.pixels.size());
	for (auto& plane : denoised)
		plane.assign(block.pixels.size(), 0.0f);
	for (size_t i = 0; i < block.pixels.size(); ++i)
	{
		const auto& levels = block.pixels[i].levels;
		picture.count[i] = float(std::size_t(1) << known[i]);
		for (int c = 0; c < tilt_lens::PictureChannels; ++c)
		{
			picture.mean[c][i] = levels[known[i]].mean[c];
			picture.first[c][i] = levels[known[i] > 0 ? known[i] - 1 : 0].mean[c];
		}
	}
	tilt_lens::DenoiseRows(picture, 0, block.height - 1, denoised, nullptr, &own);

	for (size_t i = 0; i < block.pixels.size(); ++i)
		if (IsInside(block, int(i) % block.width, int(i) / block.width, EdgePixels))
		{
			DenoisedClass& of = classes[known[i]];
			for (int c = 0; c < 3; ++c)
				of.off += std::pow(Clipped(denoised[c][i]) - Clipped(block.pixels[i].levels.back().mean[c]), 2) / 3;
			of.raw_off += block.pixels[i].levels[known[i]].off[LINEAR];
			of.changes += block.pixels[i].changes[LINEAR];
			of.kept += block.pixels[i].changes[LINEAR] * own[i];
			of.kept_squared += block.pixels[i].changes[LINEAR] * (own[i] * own[i]);
		}
}

/// The sum of squared errors. m(N) is off by v(N) itself; of that the pixel's own mean, the first of the same samples, has v(N) in common
/// with it (as independent samples do, whatever their numbers). With a share w of it in the denoised value d,
///   E (d - truth)^2 = E (d - m(N))^2 + (2 w - 1) v(N),
/// and at least w^2 v(N), the own mean's. Of one block: where a setting takes the pilot's own samples the first is a difference of two that are nearly alike, and
/// below the second in some blocks, which must not make up for others.
double Pilot::DenoisedClass::SquaredErrors() const
{
	return std::max(off + 2 * kept.SumOfVariances() - changes.SumOfVariances(), kept_squared.SumOfVariances());
}

/// What denoise makes of the error in the few pixels that have all their neighbours, times the error without of all pixels: where a picture is
/// hard is chance, and the same for both.
double Pilot::PredictDenoised(const Setting& setting, std::vector<double>* left_out, int parts) const
{
	const std::vector<tilt_lens::SampleLevel> levels = tilt_lens::SampleLevels(setting.min, setting.max, setting.variance, setting.confidence, &Chi2);
	const size_t count = Known(samples) + 1;
	std::vector<Errors> errors(blocks.size());
	for (size_t b = 0; b < blocks.size(); ++b)
	{
		tiltcal::CheckInterrupt();     // some seconds for a table
		std::vector<size_t> known;
		for (const size_t level : LevelsOf(blocks[b], levels))
			known.push_back(Known(levels[level].samples));
		std::vector<DenoisedClass> classes(count);
		AddDenoised(blocks[b], known, classes);
		for (const DenoisedClass& of : classes)
			if (of.changes.pixels > 0)
			{
				errors[b].denoised += of.SquaredErrors();
				errors[b].raw += of.RawSquaredErrors();
				errors[b].pixels += of.changes.pixels;
			}
	}
	const auto error = [&](int without)
	{
		double denoised = 0, raw = 0, pixels = 0;
		const std::vector<double> weights = Weights(without, without < 0 ? 1 : parts);
		for (size_t b = 0; b < blocks.size(); ++b)
		{
			denoised += weights[b] * errors[b].denoised;
			raw += weights[b] * errors[b].raw;
			pixels += weights[b] * errors[b].pixels;
		}
		return raw > 0 ? Predict(setting, without, without < 0 ? 1 : parts).error * std::sqrt(denoised / raw) : std::sqrt(denoised / pixels);
	};
	if (left_out)
	{
		left_out->clear();
		for (int part = 0; part < parts; ++part)
			left_out->push_back(error(part));
	}
	return error(-1);
}

}
