// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The samples of one pixel of a tilt_lens picture, summed up.

#ifndef TILT_LENS_SAMPLE_SUMS_H
#define TILT_LENS_SAMPLE_SUMS_H

#include <algorithm>
#include <cmath>
#include <limits>

#include "lens/adaptive.h"
#include "lens/convergence.h"
#include "lens/sampler.h"
#include "lens/statistics.h"

namespace tilt_lens
{

using pov::Colour;

/// Running sums of a pixel's samples, in double so that thousands of them lose nothing.
struct SampleSums
{
	static const int Channels = 5;
	double sum[Channels], squares[Channels];
	int count;
	/// Light that vignetting or a bokeh pigment kept back, in samples: what lies behind the
	/// picture is not darkened with it.
	double withheld;
	/// Rays that were not traced, because a rim stops them or the pixel looks behind the lens.
	int stopped;
	/// The most red, green or blue of a sample.
	float brightest;
	/// Under a bokeh pigment: of every colour's weights the sum and the sum of squares, and the sum of weight times
	/// light. Means are divided by the weights that the samples have, not by what they have on
	/// average: light that is the same all over the lens has no grain then.
	bool painted;
	double weights[3], square_weights[3], weighted[3];
	/// Samples that the pigment lets a colour through for.
	int lit[3];
	/// What Clear divides by is summed up sample by sample: sums of squared weights and of weight times filter or transmit, which is weighted itself.
	bool weighs;
	double square_weight, clear_weighted[2];

	/// How the first samples differ from the neighbours', where that is asked.
	Between between;

	/// Mean red, green and blue as they stood at the latest powers of two, latest first; NaN where the pigment had let none of a colour through yet.
	double earlier[ChangesKept + 1][3];
	int earlier_counts[ChangesKept + 1];
	/// Filter and transmit at the latest two of them.
	double earlier_clear[2][2];

	SampleSums() : count(0), withheld(0.0), stopped(0), brightest(0.0f), painted(false), weighs(false), square_weight(0.0)
	{
		for(int i = 0; i < 3; i++)
			weights[i] = square_weights[i] = weighted[i] = lit[i] = 0;
		clear_weighted[0] = clear_weighted[1] = 0.0;
		for(int i = 0; i < Channels; i++)
			sum[i] = squares[i] = 0.0;
		for(int j = 0; j <= ChangesKept; j++)
			earlier_counts[j] = 0;
		for(int i = 0; i < 2; i++)
			earlier_clear[0][i] = earlier_clear[1][i] = 0.0;
	}

	void Add(const Colour& c)
	{
		brightest = std::max(std::max(brightest, c[0]), std::max(c[1], c[2]));
		SumUp(c);
	}

	/// The same for light that is multiplied by `paint` already: its red, green and blue are the weights.
	void AddPainted(const Colour& c, const Colour& paint)
	{
		painted = true;
		for(int i = 0; i < 3; i++)
		{
			weights[i] += paint[i];
			square_weights[i] += double(paint[i]) * double(paint[i]);
			weighted[i] += double(paint[i]) * double(c[i]);
			if(paint[i] > 0.0f)
			{
				lit[i]++;
				brightest = std::max(brightest, c[i] / paint[i]);
			}
		}
		SumUp(c);
	}

	void SumUp(const Colour& c)
	{
		for(int i = 0; i < Channels; i++)
		{
			sum[i] += c[i];
			squares[i] += double(c[i]) * double(c[i]);
		}
		count++;
		if((count & (count - 1)) == 0)
			KeepMean();
	}

	/// Of the sample that is added next: how much of its light arrives.
	void Weigh(double weight, const Colour& c)
	{
		weighs = true;
		withheld += 1.0 - weight;
		square_weight += weight * weight;
		for(int i = 0; i < 2; i++)
			clear_weighted[i] += weight * double(c[3 + i]);
	}

	/// Whether so few samples fell where the pigment, whose `gain` of each colour is above 0 where it has any, is not black that they say nothing: of
	/// one alone not how it varies, of none not even what there is.
	bool IsTooDark(const double gain[3]) const
	{
		for(int i = 0; i < 3; i++)
			if(painted && (gain[i] > 0.0) && (lit[i] < std::min(count, 2)))
				return true;
		return false;
	}
	/// Beyond so many samples a pixel looks for no more of them.
	static const int MostInTheDark = 1 << 14;

	/// Mean of red, green or blue. A colour that no sample's place on the lens lets through is black.
	double Light(int i) const
	{
		return !painted ? sum[i] / count : weights[i] > 0.0 ? sum[i] / weights[i] : 0.0;
	}

	static double Square(double x) { return x * x; }

	/// A picture file holds 0 to 1: what is beyond is not seen.
	static double Clipped(double x) { return std::min(1.0, std::max(0.0, x)); }

	void KeepMean()
	{
		for(int j = ChangesKept; j > 0; j--)
		{
			earlier_counts[j] = earlier_counts[j - 1];
			for(int i = 0; i < 3; i++)
				earlier[j][i] = earlier[j - 1][i];
		}
		earlier_counts[0] = count;
		for(int i = 0; i < 3; i++)
			earlier[0][i] = painted && (lit[i] == 0) ? std::numeric_limits<double>::quiet_NaN() : Light(i);
		for(int i = 0; (i < 2) && IsClear(); i++)
		{
			earlier_clear[1][i] = earlier_clear[0][i];
			earlier_clear[0][i] = Clear(3 + i);
		}
	}
	bool IsClear() const { return (sum[3] != 0.0) || (sum[4] != 0.0); }

	/// The first part of the samples: as many as the last power of two below all of them.
	/// 0 for a single sample.
	int FirstPart() const { return earlier_counts[First()]; }
	/// Mean of that part in a channel.
	double FirstMean(int channel) const
	{
		if(channel >= 3)
			return earlier_clear[First()][channel - 3];
		const double first = earlier[First()][channel];
		return std::isnan(first) ? Light(channel) : first;
	}
	int First() const { return earlier_counts[0] < count ? 0 : 1; }

	/// Mean filter or transmit, of the light that arrived. Where none did: black, and nothing behind it.
	double Clear(int i) const
	{
		const double arrived = count - withheld;
		return arrived > 0.0 ? sum[i] / arrived : 0.0;
	}

	Colour Mean() const { return Colour(Light(0), Light(1), Light(2), Clear(3), Clear(4)); }

	/// The pixel's share in the estimate of the picture's error: squared changes over
	/// the latest powers of two, averaged over red, green and blue.
	LevelChanges Changes() const
	{
		LevelChanges c;

		c.pixels = 1.0;
		for(c.changes = 0; (c.changes < ChangesKept) && (earlier_counts[c.changes + 1] > 0); c.changes++)
			for(int i = 0; i < 3; i++)
				c.change[c.changes] += SquaredChange(i, c.changes) / 3.0;
		return c;
	}

	/// Of the doubling j; where it began in the dark, as much as the samples that are not there let expect.
	double SquaredChange(int channel, int j) const
	{
		return std::isnan(earlier[j + 1][channel]) ? PaintedVariance(channel) / count * (VarianceFall - 1.0) * std::pow(VarianceFall, j) : Square(SeenChange(channel, j));
	}

	/// How much a channel's mean changed by the doubling j. Where it is within what a file holds in
	/// the end, it counts as it is, even if few samples with a bright light among them had been
	/// beyond: clipping those would hide how fast the means settle.
	double SeenChange(int channel, int j) const
	{
		const double last = earlier[0][channel], change = earlier[j][channel] - earlier[j + 1][channel];
		return (last >= 0.0) && (last <= 1.0) ? change : Clipped(earlier[j][channel]) - Clipped(earlier[j + 1][channel]);
	}

	/// The pixel's samples as evidence of rare bright lights, which pixels with no more than the `first`
	/// may have missed: its brightest sample is farther out than that of as many normal ones would be. One or two samples miss what
	/// is not rare too; of that, what is beyond the range of a picture file counts, beside which all else is small.
	RareLight Rarity(int first) const
	{
		if(count < 2)
			return RareLight();
		const int i = Light(0) >= Light(1) && Light(0) >= Light(2) ? 0 : Light(1) >= Light(2) ? 1 : 2;
		const double mean = Light(i), above = brightest - mean, variance = Variance();
		const bool rare = above * above > 2.0 * std::log(double(count)) * variance, too_bright = (first < LeastOwnVariance) && (brightest > 1.0f);
		if(!(variance > 0.0) || !(above > 0.0) || !(rare || too_bright))
			return RareLight();
		// As of bright samples that are alike among dark ones that are, a part p of all.
		const double odds = variance * (count - 1) / (above * above * count), p = odds / (1.0 + odds);
		const double bright = above * (1.0 + odds), dark = mean - p * bright;
		int j = 0;
		while((j < ChangesKept) && (earlier_counts[j] > first))
			j++;
		// Of one or two samples the mean may be forgotten: then of the fewest that are remembered.
		const int least = (first < LeastOwnVariance) ? std::max(first, earlier_counts[j]) : first;
		const bool met = (count <= first) || (std::fabs(earlier[j][i] - dark) * least > 0.5 * bright);
		// Where so few meet a light, all pixels around that it reaches go on and find it, and where they do not, none: what was found says
		// nothing of what was missed, and is not taken off.
		if(too_bright && !met)
			return RareLight();
		return RareLight::Of(Clipped(mean) - Clipped(dark), p, std::min(least, count), met);
	}

	/// The same for a pixel that may have stopped early because its few samples agreed
	/// by chance: a part of what `variance`, that of a sample in the pixels around, lets
	/// expect is added.
	LevelChanges Changes(double variance) const
	{
		LevelChanges c = Changes();

		if(count >= FewSamples)
			return c;
		if((c.changes == 0) && between.known)
		{
			// A single sample: of its error only its neighbours tell. v(1) = change / (2^1 - 1).
			c.changes = 1;
			c.change[0] = between.mean;
		}
		double change = variance / count * HiddenPart * (VarianceFall - 1.0);
		for(int j = 0; j < c.changes; j++, change *= VarianceFall)
			c.change[j] += change;
		return c;
	}
	static const int FewSamples = 16;
	/// Nets of so few points are a little better than independent samples: v(n) ~ n^-1.2, 2^1.2 a doubling.
	static constexpr double VarianceFall = 2.2974;
	static constexpr double HiddenPart = 0.06;  // measured: 0.02 to 0.12 where it counts (tests/accuracy/estimate.sh)

	/// Of a quotient of sums: how far light is from the mean, times its weight, which is 1 on average. The mean is that of
	/// the samples that have a weight.
	double PaintedVariance(int i) const
	{
		const double mean = Light(i);
		return std::max(0.0, squares[i] - 2.0 * mean * weighted[i] + mean * mean * square_weights[i]) / count * lit[i] / std::max(lit[i] - 1, 1);
	}

	/// The same of filter or transmit, whose weights are as much on average as arrived.
	double ClearVariance(int i) const
	{
		const double mean = Clear(i), arrived = (count - withheld) / count;
		return !(arrived > 0.0) ? 0.0 :
		       std::max(0.0, squares[i] - 2.0 * mean * clear_weighted[i - 3] + mean * mean * square_weight) / ((count - 1) * arrived * arrived);
	}

	/// Variance of a sample in one of the channels.
	double Variance(int i) const
	{
		if(painted && (i < 3))
			return PaintedVariance(i);
		if(weighs && (i >= 3))
			return ClearVariance(i);
		const double mean = sum[i] / count;
		return (squares[i] / count - mean * mean) * count / (count - 1);
	}

	/// Largest variance of a sample over the channels.
	double Variance() const
	{
		double worst = 0.0;
		for(int i = 0; i < Channels; i++)
			worst = std::max(worst, Variance(i));
		return worst;
	}

	/// The same, or less than four samples' differences from the neighbours': what the decision to stop goes by.
	double VarianceToJudgeBy() const { return tilt_lens::VarianceToJudgeBy(count, count > 1 ? Variance() : 0.0, between); }

	/// Estimated error of the mean, RMS of red, green and blue, from this pixel alone: the mean of what each of the latest
	/// doublings says of v(n) ~ n^-1.4, which its own share in a picture's estimate (convergence.h) is too noisy
	/// to fit. 1 of a single sample, which says nothing of its error, unless it was compared with its neighbours'. `neighbourhood`: as in Changes.
	double StandardError(double neighbourhood) const
	{
		const LevelChanges c = Changes(neighbourhood);
		if(count < 2)
			return between.known ? std::sqrt(c.change[0]) : 1.0;
		const double fall = 2.639;              // 2^1.4, between nets' 1.1 and 1.7
		double variance = 0.0, weight = 1.0 / (fall - 1.0);
		for(int j = 0; j < c.changes; j++, weight /= fall)
			variance += c.change[j] * weight / c.changes;
		return std::sqrt(variance * std::pow(double(earlier_counts[0]) / count, 1.4));
	}
};

/// A pixel that is being sampled, so that it can go on later where it stopped.
struct TilePixel
{
	PixelSampler sampler;
	SampleSums sums;
	int x, y;
	/// Index of the level that it has reached, or is to reach at least.
	size_t level;
	/// Variance per sample of the pixels around, where that was asked; else 0.
	double neighbourhood_variance;

	TilePixel(int pixel_x, int pixel_y, uint32_t seed) :
		sampler((uint32_t)pixel_x, (uint32_t)pixel_y, seed), x(pixel_x), y(pixel_y), level(0), neighbourhood_variance(0.0)
	{
	}
};

}

#endif
