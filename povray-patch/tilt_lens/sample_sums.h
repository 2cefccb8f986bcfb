// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The samples of one pixel of a tilt_lens picture, summed up.

#ifndef TILT_LENS_SAMPLE_SUMS_H
#define TILT_LENS_SAMPLE_SUMS_H

#include <algorithm>

#include "backend/tilt_lens/sampler.h"

namespace tilt_lens
{

using pov::Colour;

/// Running sums of a pixel's samples, in double so that thousands of them lose nothing.
struct SampleSums
{
	static const int Channels = 5;
	double sum[Channels], squares[Channels];
	int count;
	// the sums as they stood at the last power of two below count
	double earlier_sum[Channels];
	int earlier_count;

	SampleSums() : count(0), earlier_count(0)
	{
		for(int i = 0; i < Channels; i++)
			sum[i] = squares[i] = earlier_sum[i] = 0.0;
	}

	void Add(const Colour& c)
	{
		if((count & (count - 1)) == 0)
			KeepEarlier();
		for(int i = 0; i < Channels; i++)
		{
			sum[i] += c[i];
			squares[i] += double(c[i]) * double(c[i]);
		}
		count++;
	}

	static double Square(double x) { return x * x; }

	void KeepEarlier()
	{
		for(int i = 0; i < Channels; i++)
			earlier_sum[i] = sum[i];
		earlier_count = count;
	}

	Colour Mean() const
	{
		return Colour(sum[0] / count, sum[1] / count, sum[2] / count, sum[3] / count, sum[4] / count);
	}

	/// Squared error of the mean, averaged over red, green and blue: what the later
	/// half of the samples changed. Rough for one pixel, right on average over many,
	/// and it sees what a digital net gains over independent samples.
	double SquaredError() const
	{
		double error = 0.0;
		for(int i = 0; (i < 3) && (earlier_count > 0); i++)
			error += Square(earlier_sum[i] / earlier_count - sum[i] / count);
		return error / 3.0;
	}

	/// Largest variance of the mean over the channels (taken as if the samples were
	/// independent, which for a digital net is on the safe side).
	double VarianceOfMean() const
	{
		double worst = 0.0;
		for(int i = 0; i < Channels; i++)
		{
			const double mean = sum[i] / count;
			worst = std::max(worst, (squares[i] / count - mean * mean) / (count - 1));
		}
		return worst;
	}
};

/// A pixel that is being sampled, so that it can go on later where it stopped.
struct TilePixel
{
	PixelSampler sampler;
	SampleSums sums;
	int x, y;
	/// Index of the level at which the pixel by itself had converged.
	size_t own_level;

	TilePixel(int pixel_x, int pixel_y) :
		sampler((uint32_t)pixel_x, (uint32_t)pixel_y), x(pixel_x), y(pixel_y), own_level(0)
	{
	}
};

}

#endif
