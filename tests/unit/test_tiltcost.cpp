// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcost's arithmetic, on pilots whose answers are known without it.

#include <tiltcal/error.h>
#include "pilot_run.h"
#include "prediction.h"
#include "report.h"
#include "search.h"

#include "lens/denoise.h"
#include "lens/pilot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <functional>
#include <string>
#include <vector>

using namespace tiltcost;
using testing::HasSubstr;
using tilt_lens::PilotLevel;

namespace
{

const int Side = tilt_lens::PilotBlockSize;

/// A block's text as the renderer writes it; `level(pixel, k)` is the pixel at 2^k samples.
std::string BlockText(int left, double seconds, int samples, const std::function<PilotLevel(int pixel, int k)>& level)
{
	std::vector<std::vector<PilotLevel>> pixels(Side * Side);
	for (int i = 0; i < Side * Side; ++i)
		for (int k = 0; (1 << k) <= samples; ++k)
		{
			pixels[size_t(i)].push_back(level(i, k));
			pixels[size_t(i)].back().samples = 1 << k;
		}
	return tilt_lens::PilotText(left, 0, Side, Side, seconds, seconds / samples, {0, 16, 0.0001, 0.9, false}, pixels);
}

PilotLevel Grey(double mean, double variance) { return {1, {mean, mean, mean}, variance}; }

std::string Flat(int left, double seconds, int samples, double mean, double variance)
{
	return BlockText(left, seconds, samples, [=](int, int) { return Grey(mean, variance); });
}

/// Number among the 16 pixels by which pixels inside a block are told apart, whose neighbours all lie in it too.
int InsideNumber(int pixel)
{
	return (pixel % Side - 2 + 4) % 4 + 4 * ((pixel / Side - 2 + 4) % 4);
}

int Parity(int bits)
{
	int parity = 0;
	for (; bits; bits &= bits - 1)
		parity ^= 1;
	return parity;
}

/// Means whose squared changes are v(n/2) - v(n) for v(n) = size n^-exponent in every pixel, with signs
/// (Walsh functions) that are orthogonal over the inside: averaged there, (m(n) - m(N))^2 is v(n) - v(N) exactly.
std::string PowerLaw(int left, int samples, double mean, double size, double exponent)
{
	return BlockText(left, 1, samples, [=](int pixel, int k)
	{
		double m = mean;
		for (int j = 1; j <= k; ++j)
		{
			const double change = std::sqrt(size * (std::pow(2.0, -exponent * (j - 1)) - std::pow(2.0, -exponent * j)));
			m += Parity(InsideNumber(pixel) & j) ? change : -change;
		}
		return Grey(m, 0.01);
	});
}

Setting Fixed(int samples) { return {0, samples, 0, 0.9}; }

}

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
	EXPECT_DOUBLE_EQ(SecondsPerSample(blocks), 0.75 / (2 * Side * Side * 4));
	// Cut in the last number of a pixel: what is left of it would be read as another number.
	EXPECT_EQ(ParsePilot(whole.substr(0, whole.size() - 2)).size(), 0u);
	EXPECT_TRUE(ParsePilot("").empty());
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
	EXPECT_EQ(SceneText(Fixed(37)), "blur_samples 37  variance 0");
}

TEST(Prediction, NeighboursVote)
{
	// One uncertain pixel in the middle of a calm block draws its neighbours along.
	const Pilot pilot(ParsePilot(BlockText(0, 1, 64, [](int pixel, int) { return Grey(0.5, pixel == 3 * Side + 3 ? 0.02 : 0); })));
	const double mean = pilot.Predict({4, 64, 1e-4, 0.9}).samples_per_pixel;
	// It alone at 64 and all others inside at 4 would be less.
	const double inside = (Side - 4) * (Side - 4);
	EXPECT_GT(mean, (64 + 4 * (inside - 1)) / inside + 0.25);
	EXPECT_LT(mean, 64);
}

TEST(Prediction, JackknifeLeavesOutEveryTenth)
{
	std::string text;
	for (int b = 0; b < 20; ++b)
		text += Flat(8 * b, b % 10 == 3 ? Side * Side * 16 * 1e-5 : Side * Side * 16 * 1e-6, 16, 0.5, 0);
	const Pilot pilot(ParsePilot(text));
	EXPECT_NEAR(pilot.Predict(Fixed(16), 3, 10).seconds_per_pixel, 16e-6, 1e-12);
	EXPECT_NEAR(pilot.Predict(Fixed(16)).seconds_per_pixel, 16e-6 * 1.9, 1e-12);
	// Two outlying blocks of twenty: the spread is neither nothing nor everything.
	const Machine machine{1e6, 0, 0, 1};
	const Spread spread = SpreadOf(pilot, machine, Fixed(16));
	EXPECT_GT(spread.seconds, 0.2);
	EXPECT_LT(spread.seconds, 0.8);
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

TEST(Search, RowsScaleToThePicture)
{
	const Pilot pilot(ParsePilot(Flat(0, Side * Side * 16 * 2e-6, 16, 0.5, 0)));
	const Row row = MakeRow(pilot, Machine{1e6, 3, 4, 8}, Fixed(10));
	EXPECT_DOUBLE_EQ(row.rays, 1e7);
	// Three rays a sample, as with chromatic.
	const Row three = MakeRow(pilot, Machine{1e6, 3, 4, 8, 3}, Fixed(10));
	EXPECT_DOUBLE_EQ(three.rays, 3e7);
	EXPECT_DOUBLE_EQ(three.rays_per_pixel, 30);
	EXPECT_EQ(three.cpu, row.cpu);
	EXPECT_NEAR(row.cpu, 3 + 20, 1e-9);
	EXPECT_NEAR(row.wall, 4 + 20.0 / 8, 1e-9);
}

TEST(Search, AnswersAndTable)
{
	const Pilot pilot(ParsePilot(PowerLaw(0, 64, 0.5, 4e-3, 1.5) + PowerLaw(8, 64, 0.3, 4e-3, 1.5)));
	const std::vector<Row> best = BestRows(AllRows(pilot, Machine{1e6, 0, 0, 1}));
	ASSERT_GT(best.size(), 5u);
	for (size_t i = 1; i < best.size(); ++i)
	{
		EXPECT_GE(best[i].cpu, best[i - 1].cpu);
		EXPECT_LT(best[i].predicted.error, best[i - 1].predicted.error);
	}
	const Figure error = [](const Row& row) { return row.predicted.error; };
	const auto row = CheapestBelow(best, error, 0.004);
	ASSERT_TRUE(row);
	EXPECT_LE(row->predicted.error, 0.004);
	EXPECT_FALSE(CheapestBelow(best, error, 1e-9));
	EXPECT_FALSE(BestWithin(best, best[0].wall / 2));
	EXPECT_EQ(BestWithin(best, best[2].wall)->predicted.error, best[2].predicted.error);

	const std::vector<Row> rows = TableRows(best, 10);
	EXPECT_LE(rows.size(), 10u);
	EXPECT_GE(rows.size(), 4u);
	for (size_t i = 1; i < rows.size(); ++i)
		EXPECT_LT(rows[i].predicted.error, rows[i - 1].predicted.error);
	const size_t stop = StopsPaying(rows, 1.0);
	ASSERT_LT(stop, rows.size());
	EXPECT_LE(rows[stop].predicted.Levels(), 1.0);
	EXPECT_GT(rows[stop - 1].predicted.Levels(), 1.0);
	EXPECT_EQ(StopsPaying(rows, 1e-9), rows.size());
}

namespace
{

/// A smooth field with much noise, which adaptive samples are spent on and denoise takes; or pixels that differ, with less noise, which it must
/// leave.
std::string Noisy(int left, bool smooth, int samples)
{
	std::mt19937 random(unsigned(left) + 3);
	std::normal_distribution<double> normal(0, 1);
	std::vector<double> sums(Side * Side);
	return BlockText(left, Side * Side * samples * 1e-6, samples, [&, sums](int pixel, int k) mutable
	{
		const double sigma = smooth ? 0.2 : 0.06, truth = smooth ? 0.5 : 0.3 + 0.4 * ((pixel % Side + pixel / Side) % 2);
		for (int i = k > 0 ? 1 << (k - 1) : 0; i < 1 << k; ++i)
			sums[size_t(pixel)] += sigma * normal(random);
		return Grey(truth + sums[size_t(pixel)] / (1 << k), sigma * sigma);
	});
}

}

// Against all settings, each with denoise: what is not looked at would not have been better by more than what the pilot's noise
// makes of two settings that are as good (a few per cent of these 1024 pixels).
TEST(Search, DenoisedWithinATimeIsTheBestOfAllSettings)
{
	const Pilot pilot(ParsePilot(Noisy(0, true, 256) + Noisy(16, false, 256) + Noisy(32, true, 256) + Noisy(48, false, 256)));
	const Machine machine{1e6, 0, 0, 1};
	const std::vector<Row> all = AllRows(pilot, machine), best = BestRows(all);
	std::vector<Row> denoised;
	for (const Row& row : all)
		if (row.setting.max <= pilot.Samples())
			denoised.push_back(WithDenoise(pilot, machine, row));
	int gained = 0;
	for (const double trace : {12.0, 19.0, 37.0, 74.0, 150.0})
	{
		const double seconds = trace + DenoiseWallSeconds(machine);
		const auto found = BestDenoisedWithin(pilot, machine, all, seconds);
		ASSERT_TRUE(found) << trace;
		EXPECT_LE(found->wall, seconds);
		EXPECT_TRUE(found->setting.denoise);
		double least = 1;
		for (const Row& row : denoised)
			if (row.wall <= seconds)
				least = std::min(least, row.denoised_error);
		EXPECT_LE(found->denoised_error, 1.03 * least) << trace;
		// What was asked before: the best without denoise, denoised.
		const auto raw = BestWithin(best, seconds);
		ASSERT_TRUE(raw);
		gained += raw->setting.max > pilot.Samples() || pilot.PredictDenoised(raw->setting) > 1.05 * found->denoised_error;
	}
	EXPECT_GE(gained, 1) << "the two searches are one here: nothing shown";
	// Time for denoising counts.
	EXPECT_FALSE(BestDenoisedWithin(pilot, machine, all, all.front().wall));
}

TEST(Search, ThreadsShareDenoisingByBands)
{
	Machine machine{1e6, 0, 0, 1};
	const double one = DenoiseWallSeconds(machine);
	const auto share = [&](int threads, int rows)
	{
		machine.threads = threads;
		machine.rows = rows;
		return DenoiseWallSeconds(machine) / one;
	};
	EXPECT_DOUBLE_EQ(share(2, 0), 0.5);
	EXPECT_DOUBLE_EQ(share(16, 0), 1.0 / tilt_lens::DenoiseThreads);
	EXPECT_DOUBLE_EQ(share(4, tilt_lens::DenoiseBand), 1);
	EXPECT_DOUBLE_EQ(share(2, 3 * tilt_lens::DenoiseBand), 2.0 / 3);
}

TEST(Search, APictureWithoutErrorHasOneRow)
{
	const std::vector<Row> best = BestRows(AllRows(Pilot(ParsePilot(Flat(0, 1, 64, 0.5, 0))), Machine{1e6, 0, 0, 1}));
	EXPECT_EQ(TableRows(best, 10).size(), 1u);
}

TEST(PilotRun, PlanFillsTheTime)
{
	// Blocks of 16 x 16. 0.5 us a sample, 10 s on 2 threads: 152 blocks of 1024 samples would fit.
	PilotPlan plan = PlanPilot(0.5e-6, 2, 10, 120);
	EXPECT_EQ(plan.blocks, 120);
	EXPECT_EQ(plan.samples, 1024);
	// 3 us: 25 blocks of 1024, 50 of 512. 48 are enough.
	plan = PlanPilot(3e-6, 2, 10, 120);
	EXPECT_EQ(plan.blocks, 50);
	EXPECT_EQ(plan.samples, 512);
	// Slower than anything: the least.
	plan = PlanPilot(1, 1, 10, 120);
	EXPECT_EQ(plan.blocks, 12);
	EXPECT_EQ(plan.samples, 64);
}

// By the suffix of the name, not by ".ini" anywhere in the path.
TEST(PilotRun, IniFilesAreToldByTheirSuffix)
{
	for (const char* const ini : {"a.ini", "A.INI", "a.ini[section]", "old.pov/a.ini"})
		EXPECT_TRUE(IsIniFile(ini)) << ini;
	for (const char* const scene : {"my.ini.d/a.pov", "a.ini.pov", "a.initial.pov", "ini", "a.pov[x]", ""})
		EXPECT_FALSE(IsIniFile(scene)) << scene;
}

TEST(PilotRun, ReadsPovraysMessages)
{
	const RenderLog log = ReadRenderLog(
		"  Image resolution.....640 by 480 (rows 11 to 20, columns 1 to 640).\n"
		"  Parse Time:       0 hours  0 minutes  0 seconds (0.001 seconds)\n              using 1 thread(s) with 0.000 CPU-seconds total\n"
		"  Photon Time:      0 hours  0 minutes  3 seconds (3.000 seconds)\n              using 5 thread(s) with 0.000 CPU-seconds total\n"
		"  Radiosity Time:   No radiosity\n"
		"  Trace Time:       0 hours  0 minutes  0 seconds (0.600 seconds)\n              using 4 thread(s) with 1.013 CPU-seconds total\n");
	EXPECT_EQ(log.width, 640);
	EXPECT_EQ(log.pixels, 6400);
	EXPECT_EQ(log.threads, 4);
	EXPECT_TRUE(log.photons);
	EXPECT_FALSE(log.writes);
	EXPECT_EQ(ReadRenderLog("Samples/Pixel:   min 16  mean 16.00  max 16   Camera Rays: 12288\n").camera_rays, 12288);
	// As the console breaks it.
	std::string refused = std::string("File 's.pov' line 2: Parse Error: ") + tilt_lens::PilotWritesNothing + ": log.txt\n";
	EXPECT_TRUE(ReadRenderLog(refused).writes);
	refused.replace(refused.find(' ', 60), 1, "\n   ");
	EXPECT_TRUE(ReadRenderLog(refused).writes);
	EXPECT_FALSE(log.radiosity);
	const std::string errors = ErrorLines("Parser Options\nFile 'bad.pov' line 1: Parse Error: No matching } in 'camera'\nFatal error in parser: Cannot parse input.\nRender failed\n");
	EXPECT_THAT(errors, HasSubstr("line 1: Parse Error"));
	EXPECT_THAT(errors, testing::Not(HasSubstr("Parser Options")));
	EXPECT_THAT(errors, testing::Not(HasSubstr("Render failed")));
}

TEST(Report, DurationsAndCounts)
{
	EXPECT_EQ(DurationText(0.24), "0.2 s");
	EXPECT_EQ(DurationText(99.94), "99.9 s");
	EXPECT_EQ(DurationText(119.6), "2 min 00 s");
	EXPECT_EQ(DurationText(125), "2 min 05 s");
	EXPECT_EQ(DurationText(7260), "2 h 01 min");
	EXPECT_EQ(CountText(512), "512");
	EXPECT_EQ(CountText(1.236e6), "1.24 M");
	EXPECT_EQ(CountText(2.5e9), "2.5 G");
}
