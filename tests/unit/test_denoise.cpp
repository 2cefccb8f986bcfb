// SPDX-License-Identifier: AGPL-3.0-or-later
//
// denoise on pictures whose truth is known.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "lens/denoise.h"
#include "lens/kernels.h"

using namespace tilt_lens;

namespace
{

struct Result
{
	double before, after, estimate;     // RMS errors
	std::vector<float> channels[PictureChannels];
};

/// The truth with normal noise of standard deviation `sigma` in every mean. The parts' noise is as opposed as that of
/// nets whose variance falls like n^-1.3, which denoise assumes: var(half) = 2^1.3 var(all).
NoisyPicture Noisy(int width, int height, double sigma, const std::function<double(int, int)>& truth, float count = 16, unsigned seed = 7)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal;
	NoisyPicture p;
	p.Resize(width, height);
	const double common = sigma, opposed = sigma * std::sqrt(std::exp2(1.3) - 1.0);
	for(int y = 0; y < height; y++)
		for(int x = 0; x < width; x++)
		{
			const int i = y * width + x;
			p.count[i] = count;
			for(int c = 0; c < 3; c++)
			{
				const double mean = truth(x, y) + common * normal(random);
				p.mean[c][i] = float(mean);
				p.first[c][i] = float(mean + opposed * normal(random));
			}
		}
	return p;
}

double Rms(const std::vector<float> (&a)[PictureChannels], int width, const std::function<double(int, int)>& truth)
{
	double sum = 0.0;
	for(int c = 0; c < 3; c++)
		for(size_t i = 0; i < a[c].size(); i++)
			sum += std::pow(a[c][i] - truth(int(i) % width, int(i) / width), 2);
	return std::sqrt(sum / (3.0 * a[0].size()));
}

Result Denoise(const NoisyPicture& p, const std::function<double(int, int)>& truth, int band = 1000)
{
	Result r;
	double squares = 0.0;
	for(auto& c : r.channels)
		c.assign(p.mean[0].size(), 0.0f);
	for(int y = 0; y < p.height; y += band)
		squares += DenoiseRows(p, y, std::min(y + band, p.height) - 1, r.channels);
	r.before = Rms(p.mean, p.width, truth);
	r.after = Rms(r.channels, p.width, truth);
	r.estimate = std::sqrt(squares / double(p.mean[0].size()));
	return r;
}

double Wave(int x, int y) { return 0.5 + 0.3 * std::sin(0.12 * x) * std::cos(0.09 * y); }
double Edge(int x, int) { return x < 40 ? 0.2 : 0.8; }

/// With noisy transparency above row `bottom`, and none below.
NoisyPicture TransparentAbove(int bottom, float count)
{
	NoisyPicture p = Noisy(90, 120, 0.05, Edge, count);
	const NoisyPicture alpha = Noisy(90, 120, 0.05, Wave, count, 8);
	for(int i = 0; i < bottom * p.width; i++)
	{
		p.mean[4][i] = alpha.mean[0][i];
		p.first[4][i] = alpha.first[0][i];
	}
	return p;
}

double Checks(int x, int y) { return (x + y) % 2 ? 0.1 : 0.9; }

}

TEST(Denoise, SmoothPicturesGainMuch)
{
	const Result r = Denoise(Noisy(90, 70, 0.05, Wave), Wave);
	EXPECT_NEAR(r.before, 0.05, 0.002);
	EXPECT_LT(r.after, 0.33 * r.before);          // a ninth of the rays
	EXPECT_NEAR(r.estimate / r.after, 1.0, 0.35);       // of few degrees of freedom
}

TEST(Denoise, EdgesStay)
{
	const Result r = Denoise(Noisy(80, 80, 0.02, Edge), Edge);
	EXPECT_LT(r.after, 0.5 * r.before);
	EXPECT_NEAR(r.estimate / r.after, 1.0, 0.35);
	// What leaks over the edge is less than the noise that went.
	for(int x : { 38, 39, 40, 41 })
	{
		double sum = 0.0;
		for(int y = 0; y < 80; y++)
			sum += r.channels[1][y * 80 + x] / 80.0;
		EXPECT_NEAR(sum, Edge(x, 0), 0.02) << "column " << x;
	}
}

// Black before nothing: colours say nothing, and what is transparent is judged by its own samples, with the bounds of colours. Its error is not that of red, green and blue.
TEST(Denoise, TransparencyIsJudgedByItself)
{
	const auto black = [](int, int) { return 0.0; };
	for(const auto& truth : { Edge, Checks })
	{
		const NoisyPicture alpha = Noisy(80, 80, 0.02, truth);
		NoisyPicture p = Noisy(80, 80, 0.0, black);
		p.mean[4] = alpha.mean[0];
		p.first[4] = alpha.first[0];
		const Result r = Denoise(p, black);
		double squares = 0.0;
		for(size_t i = 0; i < r.channels[4].size(); i++)
			squares += std::pow(r.channels[4][i] - truth(int(i) % 80, int(i) / 80), 2) / 6400.0;
		// Edges gain as those of colours do; checks of single pixels stay, within what the noise of 6400 pixels (1 %) lets tell.
		EXPECT_LT(std::sqrt(squares), truth == Edge ? 0.5 * 0.02 : 1.03 * 0.02);
		EXPECT_EQ(r.after, 0.0);
		EXPECT_LT(r.estimate, 1e-6);
	}
}

// A picture that is transparent alike everywhere is denoised as if it were not.
TEST(Denoise, WhatIsClearEverywhereChangesNothing)
{
	NoisyPicture p = Noisy(90, 70, 0.05, Wave);
	const Result opaque = Denoise(p, Wave);
	p.mean[4].assign(p.mean[4].size(), 0.25f);
	p.first[4] = p.mean[4];
	const Result clear = Denoise(p, Wave);
	for(int c = 0; c < 3; c++)
		EXPECT_EQ(opaque.channels[c], clear.channels[c]);
	// Sums of weights that are 1 to rounding.
	for(const float transmit : clear.channels[4])
		EXPECT_NEAR(transmit, 0.25f, 1e-5f);
	EXPECT_NEAR(clear.estimate, opaque.estimate, 1e-6 * opaque.estimate);
}

// The best of eighteen promises of a few samples is luck. Pictures that differ in nothing but how their kernels are chosen: where several of them
// are about as good averaging gains (by a tenth here), where the largest is far the best it loses next to nothing. The
// means' standard errors over 8 seeds are 1 %.
TEST(Denoise, FewSamplesAverageTheirKernels)
{
	for(const auto& truth : { Wave, Edge })
		for(const float few : { 4.0f, 8.0f })
		{
			double averaged = 0.0, chosen = 0.0;
			for(unsigned seed = 0; seed < 8; seed++)
			{
				chosen += Denoise(Noisy(80, 80, 0.1, truth, 16, seed), truth).after;
				averaged += Denoise(Noisy(80, 80, 0.1, truth, few, seed), truth).after;
			}
			EXPECT_LT(averaged, (truth == Wave ? 0.95 : 1.06) * chosen) << few;
		}
}

TEST(Denoise, DetailOfOnePixelIsNotSmoothedAway)
{
	for(const float count : { 4.0f, 8.0f, 16.0f })
	{
		const Result r = Denoise(Noisy(64, 64, 0.02, Checks, count), Checks);
		EXPECT_LT(r.after, 1.02 * r.before) << count;
	}
}

TEST(Denoise, WithoutNoiseNothingChanges)
{
	for(const float count : { 4.0f, 8.0f, 16.0f })
	{
		const Result r = Denoise(Noisy(64, 64, 0.0, Wave, count), Wave);
		EXPECT_LT(r.after, 1e-6) << count;
		const Result flat = Denoise(Noisy(20, 20, 0.0, [](int, int) { return 0.25; }, count), [](int, int) { return 0.25; });
		EXPECT_LT(flat.after, 1e-7) << count;
	}
}

// Strips and tiles must not show: a row's pixels are the same bits whatever rows are asked for with it.
TEST(Denoise, RowsDoNotDependOnTheBand)
{
	for(const float count : { 4.0f, 8.0f, 16.0f })
	{
		const NoisyPicture p = Noisy(50, 77, 0.05, Wave, count);
		const Result whole = Denoise(p, Wave), rows = Denoise(p, Wave, 1), bands = Denoise(p, Wave, 30);
		for(int c = 0; c < PictureChannels; c++)
		{
			EXPECT_EQ(whole.channels[c], rows.channels[c]) << count;
			EXPECT_EQ(whole.channels[c], bands.channels[c]) << count;
		}
	}
}

// Whether anything is transparent is looked at by bands: those that have none give the bits that they give beside transparency, and transparent rows those of the whole.
TEST(Denoise, RowsDoNotDependOnTransparencyElsewhere)
{
	for(const float count : { 8.0f, 16.0f })
	{
		const NoisyPicture p = TransparentAbove(20, count);
		const Result whole = Denoise(p, Edge), rows = Denoise(p, Edge, 1), bands = Denoise(p, Edge, 30);
		EXPECT_NE(whole.channels[4], p.mean[4]);        // it was denoised too
		for(int c = 0; c < PictureChannels; c++)
		{
			EXPECT_EQ(whole.channels[c], rows.channels[c]) << count << ", channel " << c;
			EXPECT_EQ(whole.channels[c], bands.channels[c]) << count << ", channel " << c;
		}
	}
}

// A strip that knows where it lies, and DenoiseReach beyond what is asked of it, gives the whole picture's bits.
TEST(Denoise, StripsGiveTheWholePicture)
{
	const NoisyPicture p = Noisy(90, 80, 0.05, Edge, 8);
	const Result whole = Denoise(p, Edge);
	NoisyPicture strip;
	const int left = 27 - DenoiseReach, top = 29 - DenoiseReach;       // pixels from (27, 29) on are asked for
	strip.Resize(p.width - left, p.height - top);
	strip.left = left;
	strip.top = top;
	for(int y = 0; y < strip.height; y++)
		for(int x = 0; x < strip.width; x++)
		{
			const int to = y * strip.width + x, from = (y + top) * p.width + x + left;
			strip.count[to] = p.count[from];
			for(int c = 0; c < 3; c++)
			{
				strip.mean[c][to] = p.mean[c][from];
				strip.first[c][to] = p.first[c][from];
			}
		}
	const Result part = Denoise(strip, Edge);
	for(int y = 29; y < p.height; y++)
		for(int x = 27; x < p.width; x++)
			ASSERT_EQ(part.channels[1][(y - top) * strip.width + x - left], whole.channels[1][y * p.width + x]) << x << ", " << y;
}

TEST(Denoise, SmallAndSingleSamplePicturesAreLeftInOrder)
{
	for(int size : { 1, 2, 3 })
		EXPECT_TRUE(std::isfinite(Denoise(Noisy(size, size, 0.05, Wave), Wave).after)) << size;
	NoisyPicture p = Noisy(30, 30, 0.05, Wave);
	p.count.assign(p.count.size(), 1.0f);               // one sample: nothing is known of its noise
	const Result r = Denoise(p, Wave);
	EXPECT_NEAR(r.after, r.before, 1e-6);
}

TEST(Denoise, AnInfiniteLightSpoilsNothingElse)
{
	for(const float count : { 4.0f, 16.0f })
	{
		NoisyPicture p = Noisy(60, 60, 0.05, Wave, count);
		const size_t sun = 30 * 60 + 30;
		p.mean[0][sun] = p.first[0][sun] = std::numeric_limits<float>::infinity();
		const Result r = Denoise(p, Wave);
		for(int c = 0; c < 3; c++)
			for(size_t i = 0; i < r.channels[c].size(); i++)
				ASSERT_TRUE((c == 0 && i == sun) || (r.channels[c][i] > -1.0f && r.channels[c][i] < 2.0f)) << count << ": " << c << ", " << i;
	}
}

TEST(Kernels, WeighOneInSumAndNothingAtTheCentre)
{
	for(const Kernel& k : AllKernels())
	{
		PixelPlane p(41, 41);
		p.At(20, 20) = 1.0f;
		PixelPlane rows(p.width, p.height), response(p.width, p.height), squared(p.width, p.height);
		k.Apply(p, rows, response);
		k.ApplySquared(p, rows, squared);
		double sum = 0.0, squares = 0.0, squared_sum = 0.0;
		for(size_t i = 0; i < response.v.size(); i++)
		{
			sum += response.v[i];
			squares += double(response.v[i]) * response.v[i];
			squared_sum += squared.v[i];
		}
		EXPECT_NEAR(sum, 1.0, 1e-5);
		EXPECT_NEAR(response.v[20 * 41 + 20], 0.0, 1e-6);
		EXPECT_NEAR(squared_sum, squares, 1e-5);
	}
}

TEST(Kernels, RowsAreReflectedAboutTheirEnds)
{
	EXPECT_EQ(Reflected(-1, 5), 1);
	EXPECT_EQ(Reflected(4, 5), 4);
	EXPECT_EQ(Reflected(5, 5), 3);
	EXPECT_EQ(Reflected(-9, 5), 1);
	EXPECT_EQ(Reflected(-16, 1), 0);
	EXPECT_EQ(Reflected(17, 2), 1);
}
