// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcost's predictions, from the pilot's file to a setting's error and time.

#include <tiltcal/error.h>
#include "pilot_blocks.h"
#include "prediction.h"
#include "search.h"

#include "lens/pilot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace tiltcost;
using testing::HasSubstr;
using tilt_lens::PilotLevel;

TEST(PilotFile, WholeBlocksAreReadAndTheCutOneLeftOut)
{
	const std::string whole = Flat(0, 0.5, 4, 0.25, 0.1), next = Flat(8, 0.25, 4, 0.5, 0.2);
	const auto blocks = ParsePilot(whole + next + Flat(16, 1, 4, 0, 0).substr(0, 700));
	ASSERT_EQ(blocks.size(), 2u);
	EXPECT_EQ(blocks[1].left, 8);
	EXPECT_EQ(blocks[1].pixels.size(), size_t(Side * Side));
	EXPECT_EQ(blocks[1].pixels.back().back().samples, 4);
	EXPECT_DOUBLE_EQ(blocks[1].pixels.back().back().variance, 0.2);
	EXPECT_DOUBLE_EQ(TraceSeconds(blocks), 0.75);
	// Cut in the last number of a pixel: what is left of it would be read as another number.
	EXPECT_EQ(ParsePilot(whole.substr(0, whole.size() - 2)).size(), 0u);
	EXPECT_TRUE(ParsePilot("").empty());
}

// The file has blocks as they were done: here the dear ones, which lie below, last.
TEST(PilotFile, FewerBlocksAreSpreadOverThePicture)
{
	std::vector<PilotBlock> blocks(20);
	for (int b = 0; b < 20; ++b)
		blocks[size_t(b)].top = 16 * b;
	std::vector<PilotBlock> few = blocks;
	ThinOut(5, few);
	ASSERT_EQ(few.size(), 5u);
	for (int k = 0; k < 5; ++k)
		EXPECT_EQ(few[size_t(k)].top / 64, k) << "one of each four";
	ThinOut(30, blocks);
	EXPECT_EQ(blocks.size(), 20u);
}

TEST(PilotFile, WhatIsNoPilotIsRefused)
{
	EXPECT_THROW(ParsePilot("P6 640 480\n"), tiltcal::Error);
	std::string text = Flat(0, 1, 4, 0.5, 0.1);
	text.replace(text.find('\n') + 1, 1, "7");
	EXPECT_THROW(ParsePilot(text), tiltcal::Error);
	try
	{
		ParsePilot(Flat(0, 1, 4, 0.5, 0.1) + Flat(0, 1, 4, 0.5, 0.1));
		FAIL() << "two frames in one pilot";
	}
	catch (const tiltcal::Error& e)
	{
		EXPECT_THAT(e.what(), HasSubstr("+SF"));
	}
}

TEST(Prediction, Chi2IsWhatIsExceededWithThatProbability)
{
	// Tables of the chi-squared distribution, lower tail 0.10 and 0.05.
	EXPECT_NEAR(Chi2(15, 0.9), 8.547, 0.0005);
	EXPECT_NEAR(Chi2(3, 0.95), 0.352, 0.0005);
}

// A step in the middle of a block, without noise.
TEST(Prediction, PixelsOfOneSampleGoOnWhereTheirNeighboursDiffer)
{
	const auto edge = [](int left, double dark, double bright)
	{
		return BlockText(left, 1, 64, [=](int pixel, int) { return Grey(pixel % Side < Side / 2 ? dark : bright, 0); });
	};
	const Setting setting = {1, 64, 1e-3, 0.9};
	EXPECT_EQ(Pilot(ParsePilot(edge(0, 0.3, 0.3))).Predict(setting).samples_per_pixel, 1);
	// 0.01^2 / 2 is below a tenth of the variance, 0.03^2 / 2 above, even of what two samples may have.
	EXPECT_EQ(Pilot(ParsePilot(edge(0, 0.3, 0.31))).Predict(setting).samples_per_pixel, 1);
	// Two of the twelve inside columns go on to four samples, which have no variance, and stop.
	EXPECT_EQ(Pilot(ParsePilot(edge(0, 0.3, 0.33))).Predict(setting).samples_per_pixel, (2 * 4 + 10) / 12.0);
	EXPECT_EQ(Pilot(ParsePilot(edge(0, 0.3, 0.33))).Predict({2, 64, 1e-3, 0.9}).samples_per_pixel, (2 * 4 + 10 * 2) / 12.0);
	EXPECT_EQ(Pilot(ParsePilot(edge(0, 0.3, 0.9))).Predict({4, 64, 1e-3, 0.9}).samples_per_pixel, 4) << "they ask no neighbour";
}

TEST(Prediction, FixedSamplesFollowThePowerLawAndGoOnBeyondThePilot)
{
	const double size = 4e-3;
	for (const double exponent : {1.0, 1.3, 1.6})
	{
		const Pilot pilot(ParsePilot(PowerLaw(0, 64, 0.5, size, exponent) + PowerLaw(8, 64, 0.4, size, exponent)));
		for (const int n : {1, 4, 16, 64, 256, 1024})
		{
			const Prediction p = pilot.Predict(Fixed(n));
			// The pilot's text has nine digits.
			EXPECT_NEAR(p.error / std::sqrt(size * std::pow(n, -exponent)), 1, 1e-6) << n << " samples, exponent " << exponent;
			EXPECT_DOUBLE_EQ(p.samples_per_pixel, n);
			EXPECT_DOUBLE_EQ(p.extrapolated, n > 64 ? 1 : 0);
		}
		// No power of two: between its neighbours, on the same law.
		EXPECT_NEAR(pilot.Predict(Fixed(96)).error / std::sqrt(size * std::pow(96, -exponent)), 1, 1e-6);
	}
}

TEST(Prediction, LevelsAreErrorsThroughTheDisplaysSlope)
{
	// Small enough that the slope is the same over all means.
	const double size = 1e-8, mean = 0.2;
	const Pilot pilot(ParsePilot(PowerLaw(0, 64, mean, size, 1.2)));
	const Prediction p = pilot.Predict(Fixed(16));
	const double slope = 1.055 / 2.4 * std::pow(mean, 1 / 2.4 - 1);
	// The sRGB encoding bends by 1 % over these means.
	EXPECT_NEAR(p.Levels() / (255 * slope * p.error), 1, 0.01);
}

TEST(Prediction, WhatIsBrighterThanWhiteIsNoError)
{
	const Pilot pilot(ParsePilot(BlockText(0, 1, 16, [](int pixel, int k) { return Grey(1.5 + 0.1 * k + 0.01 * pixel, 0.1); })));
	EXPECT_EQ(pilot.Predict(Fixed(4)).error, 0);
	EXPECT_EQ(pilot.Predict(Fixed(64)).error, 0);
}

TEST(Prediction, AdaptiveSamplesAndTheirTime)
{
	// One block without variance, 1 us a sample; one with 0.01, 3 us a sample.
	const double samples = Side * Side * 256.0;
	const Pilot pilot(ParsePilot(Flat(0, samples * 1e-6, 256, 0.5, 0) + Flat(8, samples * 3e-6, 256, 0.5, 0.01)));
	const Prediction p = pilot.Predict({0, 1024, 1e-4, 0.9});
	// The first stops at the first decision, 16. The second: 64 are too few even for 0.01 < 1e-4 n; at 128 the
	// upper bound is below too, 0.01 < 1e-4 * 128 * chi2(127, 0.9) / 127 = 1e-4 * 128 * 0.843 = 0.0108.
	EXPECT_DOUBLE_EQ(p.samples_per_pixel, (16 + 128) / 2.0);
	EXPECT_NEAR(p.seconds_per_pixel, (16 * 1e-6 + 128 * 3e-6) / 2, 1e-12);
	// A MIN and a MAX bind.
	EXPECT_DOUBLE_EQ(pilot.Predict({32, 64, 1e-4, 0.9}).samples_per_pixel, (32 + 64) / 2.0);
	// Three times the variance: 1e-4 * 3 * 64 * chi2(63, 0.9) / 63 = 0.0148 is enough, half of it is not.
	EXPECT_DOUBLE_EQ(pilot.Predict({16, 1024, 3e-4, 0.9}).samples_per_pixel, (16 + 64) / 2.0);
	EXPECT_EQ(SceneText({16, 1024, 2e-4, 0.9}), "blur_samples 16, 1024  variance 0.0002");
	EXPECT_EQ(SceneText({16, 1024, 2e-4, 0.99}), "blur_samples 16, 1024  variance 0.0002  confidence 0.99");
	EXPECT_EQ(SceneText(Fixed(37)), "blur_samples 37  variance 0");
}

TEST(Prediction, NeighboursVote)
{
	// One uncertain pixel in the middle of a calm block draws its neighbours along.
	const Pilot pilot(ParsePilot(BlockText(0, 1, 64, [](int pixel, int) { return Grey(0.5, pixel == 3 * Side + 3 ? 0.02 : 0); })));
	const double mean = pilot.Predict({4, 64, 1e-4, 0.9}).samples_per_pixel;
	// Of the pixels whose neighbours are all in the block, its own takes 64, the eight beside it a half, the seven farther off within reach an eighth, all others 4.
	const int inside = (Side - 4) * (Side - 4), far = 4 * 4 - 9;
	EXPECT_DOUBLE_EQ(mean, (64 + 8 * 32 + far * 8 + (inside - 9 - far) * 4.0) / inside);
}

TEST(Prediction, JackknifeLeavesOutEveryTenth)
{
	std::string text;
	for (int b = 0; b < 20; ++b)
		text += Flat(8 * b, b % 10 == 3 ? Side * Side * 16 * 1e-5 : Side * Side * 16 * 1e-6, 16, 0.5, 0);
	const Pilot pilot(ParsePilot(text));
	EXPECT_NEAR(pilot.Predict(Fixed(16), 3, 10).seconds_per_pixel, 16e-6, 1e-12);
	EXPECT_NEAR(pilot.Predict(Fixed(16)).seconds_per_pixel, 16e-6 * 1.9, 1e-12);
	// Both outlying blocks fall into one of the ten parts: without it 16 us, without any other 16 (16 + 20) / 18 = 32 us, 30.4 in the mean.
	// The jackknife's variance is 9/10 of the sum of squares about that mean, 14.4^2 + 9 1.6^2 = 230.4.
	const Machine machine{1e6, 0, 0, 1};
	const Spread spread = SpreadOf(pilot, machine, Fixed(16));
	// Of 1e6 pixels those that are traced are certain: 20 blocks, without the two columns or rows along each side that want neighbours.
	const double untraced = 1 - 20 * (Side - 4) * (Side - 4) / machine.pixels;
	EXPECT_NEAR(spread.seconds, std::sqrt(0.9 * 230.4 * untraced) / 30.4, 1e-6);
	const Pilot one(ParsePilot(Flat(0, 1, 16, 0.5, 0)));
	EXPECT_EQ(SpreadOf(one, machine, Fixed(16)).error, 0);
}

// What a pixel costs once counts once: 3 us for the first of 16 samples, 1 us for each other.
TEST(Prediction, FirstSamplesHaveATimeOfTheirOwn)
{
	const double pixels = Side * Side;
	std::vector<std::vector<PilotLevel>> levels(size_t(pixels), { { 1, { 0.5, 0.5, 0.5 }, 0 }, { 2, { 0.5, 0.5, 0.5 }, 0 }, { 4, { 0.5, 0.5, 0.5 }, 0 } });
	const Pilot pilot(ParsePilot(tilt_lens::PilotText(0, 0, Side, Side, pixels * 6e-6, pixels * 3e-6, {0, 16, 0.0001, 0.9, false}, levels)));
	EXPECT_NEAR(pilot.Predict(Fixed(1)).seconds_per_pixel, 3e-6, 1e-15);
	EXPECT_NEAR(pilot.Predict(Fixed(4)).seconds_per_pixel, 6e-6, 1e-15);
	EXPECT_NEAR(pilot.BlockCosts(Fixed(10))[0].seconds_per_pixel, 12e-6, 1e-15);
}

// What the renderer sees of transparency tiltcost sees too: between black and nothing, pixels of one sample go on.
TEST(Prediction, EdgesOfTransparencyTakeSamples)
{
	Setting few;
	few.min = 1;
	few.max = 4;
	few.variance = 0.01;
	const auto samples = [&](double transmit)
	{
		return Pilot(ParsePilot(BlockText(0, 1, 4, [=](int pixel, int) { return PilotLevel{ 1, { 0, 0, 0, 0, pixel % Side < Side / 2 ? 0 : transmit }, 0 }; }))).Predict(few).samples_per_pixel;
	};
	EXPECT_EQ(samples(0), 1);
	EXPECT_GT(samples(1), 1.1);
}

// A grey field with independent noise of variance 0.01/n: denoise finds it; a checkerboard of single pixels it must leave.
TEST(Prediction, DenoiseHelpsWhereNeighboursAreAlike)
{
	for (const bool checks : {false, true})
	{
		std::mt19937 random(3);
		std::normal_distribution<double> normal(0, 0.1);
		std::vector<double> sums(Side * Side);
		const Pilot pilot(ParsePilot(BlockText(0, 1, 1024, [&](int pixel, int k)
		{
			for (int i = k > 0 ? 1 << (k - 1) : 0; i < 1 << k; ++i)
				sums[size_t(pixel)] += normal(random);
			const double truth = checks ? 0.3 + 0.4 * ((pixel % Side + pixel / Side) % 2) : 0.5;
			return Grey(truth + sums[size_t(pixel)] / (1 << k), 0.01);
		})));
		const double raw = pilot.Predict(Fixed(16)).error, denoised = pilot.PredictDenoised(Fixed(16));
		EXPECT_NEAR(raw, 0.1 / 4, 0.004);
		if (checks)
		{
			EXPECT_NEAR(denoised, raw, 0.15 * raw);
			// A setting that takes the pilot's own samples keeps them here: it is as far from the truth as they are. Five changes of 64 pixels tell of that variance
			// to some 20 %, of its root to 10.
			EXPECT_NEAR(pilot.PredictDenoised(Fixed(1024)), 0.1 / 32, 0.3 * 0.1 / 32);
		}
		else
			EXPECT_LT(denoised, 0.5 * raw);
	}
}

// Only the middle of a block has all its neighbours. Where noise is twice as strong around it, and denoise must leave all of it, the picture's error is that of all pixels.
TEST(Prediction, DenoisedByTheMiddleOfBlocksIsTheErrorOfAll)
{
	std::mt19937 random(4);
	std::normal_distribution<double> normal(0, 1);
	std::string text;
	for (int b = 0; b < 20; ++b)
	{
		std::vector<double> sums(Side * Side);
		const bool noisy = b % 10 == 3;   // a part of the jackknife
		text += BlockText(Side * b, 1, 256, [&](int pixel, int k)
		{
			const int x = pixel % Side, y = pixel / Side;
			const bool middle = x >= 4 && y >= 4 && x < Side - 4 && y < Side - 4;
			const double sigma = (middle ? 0.05 : 0.1) * (noisy ? 3 : 1);
			for (int i = k > 0 ? 1 << (k - 1) : 0; i < 1 << k; ++i)
				sums[size_t(pixel)] += sigma * normal(random);
			return Grey(0.3 + 0.4 * ((x + y) % 2) + sums[size_t(pixel)] / (1 << k), sigma * sigma);
		});
	}
	const Pilot pilot(ParsePilot(text));
	const Machine machine{1e6, 0, 0, 1};
	Row row = MakeRow(pilot, machine, Fixed(16));
	std::vector<double> left_out;
	row.denoised_error = pilot.PredictDenoised(row.setting, &left_out, SpreadParts);
	// 1280 pixels tell of a variance to 4 %; denoise finds by chance what it may take in some.
	EXPECT_NEAR(row.denoised_error, row.predicted.error, 0.1 * row.predicted.error);
	// One part of ten has nine times the variance: errors are 1 without it and sqrt(17 / 9) without another, by which one standard deviation is 0.252. Two blocks tell of
	// their variance to 6 % (128 pixels, of one colour).
	const Spread spread = SpreadOf(pilot, machine, row.setting, left_out);
	EXPECT_NEAR(spread.error, 0.252, 0.06);
	EXPECT_NEAR(spread.denoised, 0.252, 0.06);
	EXPECT_EQ(SpreadOf(pilot, machine, row.setting).denoised, 0) << "it was not asked for";
}
