// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/prediction.h"

#include <tiltcal/transfer.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tiltcost
{

using tilt_lens::PilotLevel;
using tilt_lens::SampleLevel;

namespace
{

double Square(double x) { return x * x; }

double Clipped(double x) { return std::min(1.0, std::max(0.0, x)); }

struct Rgb
{
	double c[3];

	double SquaredDistance(const Rgb& o) const { return (Square(c[0] - o.c[0]) + Square(c[1] - o.c[1]) + Square(c[2] - o.c[2])) / 3; }
};

}

double Chi2(double df, double c)
{
	return boost::math::quantile(boost::math::complement(boost::math::chi_squared(df), c));
}

std::string SceneText(const Setting& setting)
{
	const std::string samples = setting.min > 0 ? fmt::format("blur_samples {}, {}", setting.min, setting.max) : fmt::format("blur_samples {}", setting.max);
	const std::string confidence = setting.confidence != DefaultConfidence ? fmt::format("  confidence {:.9g}", setting.confidence) : "";
	return samples + fmt::format("  variance {:.9g}", setting.variance) + confidence + (setting.denoise ? "  tilt_lens { denoise }" : "");
}

Pilot::Pilot(const std::vector<PilotBlock>& read, const std::vector<Population>& pictures) : populations(pictures)
{
	for (const PilotBlock& from : read)
	{
		Block block;
		block.x = from.left + 0.5 * from.width;
		block.y = from.top + 0.5 * from.height;
		block.sampled = from.sampled;
		block.picture = from.picture;
		populations.resize(std::max(populations.size(), block.picture + 1));
		block.width = from.width;
		block.height = from.height;
		samples = from.pixels[0].back().samples;
		block.seconds_per_pixel = from.first_seconds / double(from.pixels.size());
		block.seconds_per_sample = (from.seconds - from.first_seconds) / (double(from.pixels.size()) * std::max(samples - 1, 1));
		for (const auto& levels : from.pixels)
			block.pixels.push_back(Prepare(levels));
		for (int i = 0; i < block.width * block.height; ++i)
			pixel_count += IsInside(block, i % block.width, i / block.width);
		blocks.push_back(std::move(block));
	}
}

/// How much each block counts, on average 1 in each picture; 0 for those whose index is `part` modulo `parts` (parts > 1).
std::vector<double> Pilot::Weights(int part, int parts) const
{
	std::vector<double> weights(blocks.size(), 0.0);
	for (size_t picture = 0; picture < populations.size(); ++picture)
	{
		std::vector<size_t> of;
		std::vector<SampledBlock> sampled;
		for (size_t b = 0; b < blocks.size(); ++b)
			if (blocks[b].picture == picture && (parts <= 1 || int(b) % parts != part))
			{
				of.push_back(b);
				sampled.push_back(blocks[b].sampled);
			}
		const Population& all = populations[picture];
		const std::vector<double> numbers = all.blocks > 0 ? CalibratedWeights(sampled, all.blocks, all.worth) : std::vector<double>(of.size(), 1.0);
		for (size_t i = 0; i < of.size(); ++i)
			weights[of[i]] = all.blocks > 0 ? numbers[i] * double(of.size()) / all.blocks : 1;
	}
	return weights;
}

Pilot::Pixel Pilot::Prepare(const std::vector<PilotLevel>& levels)
{
	std::vector<Rgb> means[SCALES];
	for (const PilotLevel& level : levels)
	{
		Rgb linear{}, encoded{};
		for (int i = 0; i < 3; ++i)
		{
			linear.c[i] = Clipped(level.mean[i]);
			encoded.c[i] = tiltcal::EncodeSrgb(linear.c[i]);
		}
		means[LINEAR].push_back(linear);
		means[ENCODED].push_back(encoded);
	}

	Pixel pixel;
	for (size_t k = 0; k < levels.size(); ++k)
	{
		const double* mean = levels[k].mean;
		pixel.levels.push_back({{float(mean[0]), float(mean[1]), float(mean[2]), float(mean[3]), float(mean[4])}, levels[k].variance,
			{means[LINEAR][k].SquaredDistance(means[LINEAR].back()), means[ENCODED][k].SquaredDistance(means[ENCODED].back())}});
	}
	for (int scale = 0; scale < SCALES; ++scale)
	{
		tilt_lens::LevelChanges& c = pixel.changes[scale];
		c.pixels = 1;
		c.changes = std::min(tilt_lens::ChangesKept, int(levels.size()) - 1);
		for (int j = 0; j < c.changes; ++j)
			c.change[j] = means[scale][levels.size() - 1 - size_t(j)].SquaredDistance(means[scale][levels.size() - 2 - size_t(j)]);
	}
	return pixel;
}

/// Index of the largest power of two that the pilot has and that is not above `count`.
size_t Pilot::Known(int count) const
{
	size_t k = 0;
	while ((2 << k) <= std::min(count, samples))
		++k;
	return k;
}

/// Whether a pixel's whole neighbourhood lies in the block. Near the edge neighbours are missing that
/// a render has: errors of settings that start with few samples came out a third too large.
bool Pilot::IsInside(const Block& block, int x, int y, int reach)
{
	// Blocks at the picture's right and bottom edge may be too narrow to have an inside.
	const bool wide = block.width > 2 * reach, high = block.height > 2 * reach;
	return (!wide || (x >= reach && x < block.width - reach)) && (!high || (y >= reach && y < block.height - reach));
}

/// What the first samples of a block's pixels differ by; nothing where they are too many to be compared.
std::vector<tilt_lens::Between> Pilot::CompareFirst(const Block& block, int first) const
{
	if (first >= tilt_lens::LeastOwnVariance)
		return std::vector<tilt_lens::Between>(block.pixels.size());
	std::vector<float> means;
	for (const Pixel& pixel : block.pixels)
		means.insert(means.end(), std::begin(pixel.levels[Known(first)].mean), std::end(pixel.levels[Known(first)].mean));
	return tilt_lens::BetweenNeighbours(means, block.width, block.height, tilt_lens::PictureChannels, first);
}

/// The level that each pixel of a block goes on to, as if the block were the picture.
std::vector<size_t> Pilot::LevelsOf(const Block& block, const std::vector<SampleLevel>& levels) const
{
	std::vector<size_t> chosen(block.pixels.size(), 0);
	if (levels.size() == 1)
		return chosen;

	std::vector<size_t> known;
	for (const SampleLevel& level : levels)
		known.push_back(Known(level.samples));
	const std::vector<tilt_lens::Between> between = CompareFirst(block, levels[0].samples);
	const auto Variance = [&](size_t i)
	{
		return tilt_lens::VarianceToJudgeBy(levels[chosen[i]].samples, block.pixels[i].levels[known[chosen[i]]].variance, between[i]);
	};
	const auto Converge = [&](size_t i)
	{
		while (chosen[i] + 1 < levels.size() && !StopsAt(levels[chosen[i]], Variance(i)))
			++chosen[i];
	};
	std::vector<tilt_lens::Uncertainty> uncertainty;
	for (size_t i = 0; i < block.pixels.size(); ++i)
	{
		Converge(i);
		uncertainty.push_back(tilt_lens::ToUncertainty(Variance(i)));
	}
	const tilt_lens::Neighbourhoods around(uncertainty, block.width, block.height);
	for (size_t i = 0; i < block.pixels.size(); ++i)
	{
		chosen[i] = NeighbourhoodLevel(levels, chosen[i], around.near[i], around.far[i]);
		Converge(i);
	}
	return chosen;
}

/// Adds the squared errors of the pixels that take `count` samples.
void Pilot::AddErrors(const Class& of, int count, Prediction& sum) const
{
	const size_t k = Known(count);
	for (int scale = 0; scale < SCALES; ++scale)
	{
		double exponent = 1;
		const double left = of.changes[scale].SumOfVariances(&exponent);
		// Beyond what the pilot has (a power of two up to N) the error goes on falling.
		const double fall = std::pow(double(1 << k) / count, exponent);
		(scale == LINEAR ? sum.error : sum.encoded_error) += (of.off[scale] + left) * fall;
		if (scale == LINEAR && count > samples)
			sum.extrapolated += (of.off[scale] + left) * fall;
	}
}

std::vector<BlockCost> Pilot::BlockCosts(const Setting& setting) const
{
	const std::vector<SampleLevel> levels = tilt_lens::SampleLevels(setting.min, setting.max, setting.variance, setting.confidence, &Chi2);
	std::vector<BlockCost> costs;
	for (const Block& block : blocks)
	{
		double samples_taken = 0;
		for (const size_t level : LevelsOf(block, levels))
			samples_taken += levels[level].samples;
		const double pixels = double(block.pixels.size());
		costs.push_back({block.x, block.y, block.Seconds(pixels, samples_taken) / pixels});
	}
	return costs;
}

Prediction Pilot::Predict(const Setting& setting, int part, int parts) const
{
	const std::vector<SampleLevel> levels = tilt_lens::SampleLevels(setting.min, setting.max, setting.variance, setting.confidence, &Chi2);
	std::vector<size_t> known;
	for (const SampleLevel& level : levels)
		known.push_back(Known(level.samples));
	std::vector<Class> classes(levels.size());
	Prediction sum;
	double pixels = 0;

	const std::vector<double> weights = Weights(part, parts);
	for (size_t b = 0; b < blocks.size(); ++b)
	{
		const Block& block = blocks[b];
		const double weight = weights[b];
		if (weight == 0)
			continue;
		const std::vector<size_t> chosen = LevelsOf(block, levels);
		double taken = 0, inside = 0;
		for (size_t i = 0; i < block.pixels.size(); ++i)
		{
			if (!IsInside(block, int(i) % block.width, int(i) / block.width))
				continue;
			Class& c = classes[chosen[i]];
			c.pixels += weight;
			inside += weight;
			taken += weight * levels[chosen[i]].samples;
			for (int scale = 0; scale < SCALES; ++scale)
			{
				c.off[scale] += weight * block.pixels[i].levels[known[chosen[i]]].off[scale];
				c.changes[scale] += block.pixels[i].changes[scale] * weight;
			}
		}
		pixels += inside;
		sum.samples_per_pixel += taken;
		sum.seconds_per_pixel += block.Seconds(inside, taken);
	}
	for (size_t l = 0; l < levels.size(); ++l)
		if (classes[l].pixels > 0)
			AddErrors(classes[l], levels[l].samples, sum);

	sum.extrapolated = sum.error > 0 ? sum.extrapolated / sum.error : 0;
	sum.error = std::sqrt(sum.error / pixels);
	sum.encoded_error = std::sqrt(sum.encoded_error / pixels);
	sum.samples_per_pixel /= pixels;
	sum.seconds_per_pixel /= pixels;
	return sum;
}

}
