// SPDX-License-Identifier: AGPL-3.0-or-later
//
// When a pixel has enough, and what error is left: against definitions, independent
// samples, and power laws whose answer is known.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "lens/adaptive.h"
#include "lens/convergence.h"
#include "lens/neighbourhood.h"
#include "lens/pilot.h"

using namespace tilt_lens;

namespace
{

double Half(double df, double) { return 0.5 * df; }

std::vector<int> Samples(const std::vector<SampleLevel>& levels)
{
	std::vector<int> n;
	for(const SampleLevel& l : levels)
		n.push_back(l.samples);
	return n;
}

}

TEST(Levels, ArePowersOfTwoFromMinToMax)
{
	EXPECT_EQ(Samples(SampleLevels(0, 100, 1e-4, 0.9, Half)), (std::vector<int>{ 16, 32, 64, 100 }));
	EXPECT_EQ(Samples(SampleLevels(5, 64, 1e-4, 0.9, Half)), (std::vector<int>{ 8, 16, 32, 64 }));
	EXPECT_EQ(Samples(SampleLevels(1, 8, 1e-4, 0.9, Half)), (std::vector<int>{ 1, 2, 4, 8 }));
	EXPECT_EQ(Samples(SampleLevels(2, 8, 1e-4, 0.9, Half)), (std::vector<int>{ 2, 4, 8 }));
	EXPECT_EQ(Samples(SampleLevels(3, 8, 1e-4, 0.9, Half)), (std::vector<int>{ 4, 8 }));
	EXPECT_DOUBLE_EQ(SampleLevels(1, 8, 1e-4, 0.9, Half)[0].stop_below, ShareBetween * 1e-4) << "one sample has no variance of its own";
	EXPECT_EQ(Samples(SampleLevels(64, 64, 1e-4, 0.9, Half)), (std::vector<int>{ 64 }));
	EXPECT_EQ(Samples(SampleLevels(4, 1000, 0.0, 0.9, Half)), (std::vector<int>{ 1000 })) << "variance 0: all samples everywhere";
	EXPECT_EQ(Samples(SampleLevels(0, 3, 1e-4, 0.9, Half)), (std::vector<int>{ 3 }));
	EXPECT_DOUBLE_EQ(SampleLevels(0, 100, 1e-4, 0.9, Half)[1].stop_below, 0.5e-4);
	EXPECT_EQ(SampleLevels(0, 100, 1e-4, 0.9, Half).back().stop_below, 0.0) << "the last level always stops";
	// The doubling must not run past what an int holds.
	EXPECT_EQ(Samples(SampleLevels(0, 2147483647, 1e-4, 0.9, Half)).back(), 2147483647);
}

TEST(Uncertainty, IsTheVarianceWithinAnEighthOfAnOctave)
{
	EXPECT_EQ(ToUncertainty(0.0), 0);
	EXPECT_EQ(FromUncertainty(0), 0.0);
	for(double v = 1e-13; v < 6e4; v *= 1.37)
	{
		EXPECT_NEAR(std::log2(FromUncertainty(ToUncertainty(v)) / v), 0.0, 0.1251) << v;
		EXPECT_NE(ToUncertainty(v), UnknownUncertainty);
	}
	EXPECT_NE(ToUncertainty(1e300), UnknownUncertainty);
	EXPECT_GT(FromUncertainty(ToUncertainty(1e-300)), 0.0);
}

// Of independent samples, half the mean squared difference of two is their variance, whatever their number.
TEST(BetweenNeighbours, IsTheVarianceOfASampleWhereThePictureIsFlat)
{
	const int side = 100, channels = 5;
	std::mt19937 random(3);
	for(int samples : { 1, 2 })
	{
		std::normal_distribution<float> mean(0.5f, 0.1f / std::sqrt(float(samples)));
		std::vector<float> means(side * side * channels);
		for(float& m : means)
			m = mean(random);
		double sum = 0.0;
		for(const Between& between : BetweenNeighbours(means, side, side, channels, samples))
		{
			sum += between.mean;
			EXPECT_GE(between.most, between.mean);
			EXPECT_TRUE(between.known);
		}
		// 30,000 normal numbers: their variance is known to sqrt(2 / 30,000) = 0.8 %, five of which are 4 %; each counts in nine pixels, which does not add any.
		EXPECT_NEAR(sum / (side * side), 0.01, 0.0004) << samples;
	}
}

// Each pixel with each of its eight neighbours, one after the other.
TEST(BetweenNeighbours, IsWhatPairsSay)
{
	const int columns = 7, rows = 5, channels = 4, samples = 2;
	std::mt19937 random(4);
	std::uniform_real_distribution<float> mean(0.0f, 1.0f);
	std::vector<float> means(columns * rows * channels);
	for(float& m : means)
		m = mean(random);
	const std::vector<Between> found = BetweenNeighbours(means, columns, rows, channels, samples);
	for(int y = 0; y < rows; y++)
		for(int x = 0; x < columns; x++)
		{
			double most = 0.0, sum = 0.0;
			int count = 0;
			for(int other = 0; other < columns * rows; other++)
			{
				const int away = std::max(std::abs(other % columns - x), std::abs(other / columns - y));
				count += away == 1;
				for(int c = 0; (away == 1) && (c < channels); c++)
				{
					const double d = double(means[(y * columns + x) * channels + c]) - means[other * channels + c], v = d * d / 2.0 * samples;
					most = std::max(most, v);
					sum += c < 3 ? v / 3.0 : 0.0;
				}
			}
			// A difference in single precision is off by 2^-24, its square by twice that, of 1 at most, and the sum by eight of these.
			EXPECT_NEAR(found[size_t(y * columns + x)].most, most, 1e-6) << x << " " << y;
			EXPECT_NEAR(found[size_t(y * columns + x)].mean, sum / count, 1e-6) << x << " " << y;
		}
}

// An edge is seen from both sides, in any channel; what lies beyond the picture is not.
TEST(BetweenNeighbours, SeesAnEdgeFromBothSides)
{
	const int side = 6, channels = 5;
	for(int channel = 0; channel < channels; channel++)
	{
		std::vector<float> means(side * side * channels, 0.25f);
		for(int i = 0; i < side * side; i++)
			if(i % side >= 3)
				means[size_t(i * channels + channel)] = 0.75f;
		const std::vector<Between> found = BetweenNeighbours(means, side, side, channels, 2);
		const auto at = [&](int x) { return found[size_t(2 * side + x)]; };
		EXPECT_EQ(at(1).most, 0.0);
		EXPECT_DOUBLE_EQ(at(2).most, 0.25) << "0.5^2 / 2 of a mean of two";
		EXPECT_DOUBLE_EQ(at(3).most, 0.25);
		EXPECT_EQ(at(4).most, 0.0);
		// Three of eight neighbours, one of the three colours; transparency is no light.
		EXPECT_NEAR(at(2).mean, channel < 3 ? 0.25 * 3 / 8 / 3 : 0.0, 1e-12);
	}
	EXPECT_EQ(BetweenNeighbours(std::vector<float>(5, 1.0f), 1, 1, 5, 1)[0].most, 0.0) << "a picture of one pixel";
}

TEST(BetweenNeighbours, JudgeWhatIsTooLittleToJudgeItself)
{
	Between between;
	EXPECT_EQ(VarianceToJudgeBy(1, 0.0, between), HUGE_VAL) << "nor do neighbours, for there are none";
	EXPECT_EQ(VarianceToJudgeBy(4, 0.1, between), 0.1);
	between.known = true;
	between.most = 0.5;
	EXPECT_EQ(VarianceToJudgeBy(1, 0.0, between), 0.5);
	EXPECT_EQ(VarianceToJudgeBy(2, 0.1, between), 0.5);
	EXPECT_EQ(VarianceToJudgeBy(2, 0.7, between), 0.7);
	EXPECT_EQ(VarianceToJudgeBy(4, 0.1, between), 0.1) << "four samples speak for themselves";
}

// One uncertain pixel among certain ones makes those within reach go on, and no others.
TEST(Neighbourhood, ReachesTwoPixels)
{
	std::vector<Uncertainty> u(11 * 11, 0);
	u[5 * 11 + 5] = ToUncertainty(1.0);
	const Neighbourhoods one(u, 11, 11);
	const auto at = [&](int x, int y) { return one.variance[size_t(y * 11 + x)]; };
	EXPECT_NEAR(at(5, 5), 0.5 * (1.0 / 9 + 1.0 / 25), 0.01);
	EXPECT_NEAR(at(4, 6), at(5, 5), 1e-15);
	EXPECT_NEAR(at(3, 5), 0.5 / 25, 0.002);
	EXPECT_EQ(at(2, 5), 0.0);
	// In a corner and at an edge fewer vote.
	u.assign(u.size(), ToUncertainty(1.0));
	for(const double v : Neighbourhoods(u, 11, 11).variance)
		EXPECT_NEAR(v, FromUncertainty(u[0]), 1e-12);
}

// Of nine pixels and of twenty-five; not what is beyond the rectangle.
TEST(Neighbourhood, TheMostUncertainAround)
{
	std::vector<Uncertainty> u(11 * 11, 3);
	u[5 * 11 + 5] = 90;
	const Neighbourhoods around(u, 11, 11);
	for(int y = 0; y < 11; y++)
		for(int x = 0; x < 11; x++)
		{
			const int away = std::max(std::abs(x - 5), std::abs(y - 5));
			EXPECT_EQ(around.near[size_t(y * 11 + x)], away <= 1 ? 90 : 3) << x << " " << y;
			EXPECT_EQ(around.far[size_t(y * 11 + x)], away <= 2 ? 90 : 3) << x << " " << y;
		}
	const Neighbourhoods alone({ 7 }, 1, 1), two({ 7, 9 }, 2, 1);
	EXPECT_EQ(alone.far[0], 7) << "a picture of one pixel";
	EXPECT_EQ(two.near[0], 9);
	EXPECT_EQ(two.far[1], 9);
}

TEST(Neighbourhood, APixelIsSampledHalfAsOftenAsItsNeighbourWantsAndNeverLessThanByItself)
{
	const auto levels = SampleLevels(0, 256, 1e-4, 0.9, Half);   // 16 .. 256, where 1/2 of 1e-4 is the bound
	ASSERT_EQ(levels.size(), 5u);
	EXPECT_EQ(LevelFor(levels, 0.0), 0u);
	EXPECT_EQ(LevelFor(levels, 0.00079), 0u) << "of 16 samples the mean has 0.49e-4";
	EXPECT_EQ(LevelFor(levels, 0.00081), 1u);
	EXPECT_EQ(LevelFor(levels, 1.0), 4u);
	EXPECT_EQ(LevelFor(levels, HUGE_VAL), 4u);
	const auto wants = [](double variance) { return ToUncertainty(variance); };
	const auto level = [&](size_t own, Uncertainty near, Uncertainty far) { return NeighbourhoodLevel(levels, own, near, far); };
	EXPECT_EQ(level(0, 0, 0), 0u);
	EXPECT_EQ(level(2, 0, 0), 2u);
	EXPECT_EQ(level(0, wants(1.0), 0), 3u) << "128 of 256";
	EXPECT_EQ(level(0, 0, wants(1.0)), 1u) << "32 of 256";
	EXPECT_EQ(level(4, wants(1.0), wants(1.0)), 4u);
	EXPECT_EQ(level(0, wants(0.001), 0), 0u) << "the neighbour stops at 32";
	// blur_samples 16, 100: the last level is no power of two.
	const auto odd = SampleLevels(16, 100, 1e-4, 0.9, Half);
	EXPECT_EQ(NeighbourhoodLevel(odd, 0, wants(1.0), 0), 2u) << "50 of 100: 64";
}

// The nine and twenty-five pixels hold the pixel itself, which may not ask itself for more. A byte holds a variance within 2^(1/8), and from
// one level to the next what stops there doubles at least.
TEST(Neighbourhood, APixelDoesNotAskItselfForMore)
{
	for(int first : { 1, 2, 3, 4, 16 })
		for(int last : { 16, 17, 100, 256 })
		{
			const auto levels = SampleLevels(first, last, 1e-4, 0.9, Half);
			for(double variance = 1e-6; variance < 1.0; variance *= 1.03)
				for(size_t own = LevelFor(levels, variance); own < levels.size(); own++)
					EXPECT_EQ(NeighbourhoodLevel(levels, own, ToUncertainty(variance), ToUncertainty(variance)), own) << first << " " << last << " " << variance;
		}
}

// v(n) = c n^-a: the squared changes are c n^-a (2^a - 1) 2^(aj).
TEST(Convergence, FindsThePowerLaw)
{
	for(double a : { 1.0, 1.3, 1.5, 1.75 })
	{
		double change[ChangesKept], exponent;
		for(int j = 0; j < ChangesKept; j++)
			change[j] = 3e-5 * (std::exp2(a) - 1.0) * std::exp2(a * j);
		EXPECT_NEAR(VarianceFromChanges(change, ChangesKept, &exponent), 3e-5, 1e-15) << a;
		EXPECT_NEAR(exponent, a, 1e-12);
	}
	EXPECT_EQ(VarianceFromChanges(nullptr, 0), 0.0);
	const double none[ChangesKept] = {};
	EXPECT_EQ(VarianceFromChanges(none, ChangesKept), 0.0) << "a picture without any change has no error";
}

// Independent samples, where s^2/n is the truth: 2,000 pixels of 64 uniform numbers.
TEST(Convergence, AgreesWithIndependentSamples)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> uniform(0.0, 1.0);
	LevelChanges sum;
	for(int pixel = 0; pixel < 2000; pixel++)
	{
		LevelChanges c;
		c.pixels = 1.0;
		std::vector<double> means;
		double total = 0.0;
		for(int n = 1; n <= 64; n++)
		{
			total += uniform(random);
			if((n & (n - 1)) == 0)
				means.push_back(total / n);
		}
		for(int j = 0; j < ChangesKept; j++)
			c.change[j] = std::pow(means[6 - j] - means[5 - j], 2);
		sum += c;
	}
	// Var = 1/12/64; 2,000 squares of a normal variable leave 1/sqrt(1000) = 3 % (1 sigma).
	EXPECT_NEAR(sum.SumOfVariances() / sum.pixels * 64 * 12, 1.0, 0.15);
}

TEST(Pilot, RequestIsReadOrIgnored)
{
	const PilotRequest r = ParsePilotRequest("64,256,2.5,/tmp/a,b.txt");
	EXPECT_TRUE(bool(r));
	EXPECT_EQ(r.blocks, 64);
	EXPECT_EQ(r.samples, 256);
	EXPECT_EQ(r.seconds, 2.5);
	EXPECT_EQ(r.file, "/tmp/a,b.txt");
	for(const char *bad : { "", "64", "64,256,", "64,256,1", "64,256,1,", "64,256,0,f", "64,100,1,f", "0,64,1,f", "-3,64,1,f", "64,0,1,f", "x,y,z" })
		EXPECT_FALSE(bool(ParsePilotRequest(bad))) << bad;
	EXPECT_FALSE(bool(ParsePilotRequest(nullptr)));
	EXPECT_FALSE(r.Scouts());
	EXPECT_TRUE(ParsePilotRequest("64,1,2.5,f").Scouts());
}

TEST(Pilot, BlocksThatAFileNamesComeInItsOrder)
{
	const std::string file = testing::TempDir() + "pilot-blocks";
	const int side = PilotBlockSize;
	PilotRequest r;
	r.blocks = 2;
	r.chosen = file;
	std::ofstream(file.c_str()) << "7 3 -1 7 12\n0";
	EXPECT_EQ(PilotBlocks(r, 4 * side, 3 * side), (std::vector<int>{ 7, 3, 0 })) << "once each, and those of the picture";
	EXPECT_EQ(PilotBlocks(r, 4 * side, 3 * side, 0, side, 4 * side - 1, 2 * side - 1), std::vector<int>{ 7 }) << "those of its part";
	std::remove(file.c_str());
	EXPECT_TRUE(PilotBlocks(r, 4 * side, 3 * side).empty());
}

TEST(Pilot, AScoutSeesWhatNeighboursDifferBy)
{
	EXPECT_EQ(ScoutedChange({ 1, 2, 3 }, 1, 1), 0) << "no neighbour";
	// Red of 3 x 2 pixels; seven pairs.
	const double red[] = { 0, 1, 1, 0, 3, 9 };
	std::vector<double> rgb;
	for(double value : red)
		rgb.insert(rgb.end(), { value, 0.5, 0.5 });
	// Along the rows 1, 0, 9 and (3 to 4, the whitest) 1; down 0, 4 and 9.
	EXPECT_DOUBLE_EQ(ScoutedChange(rgb, 3, 2), (1 + 0 + 9 + 1 + 0 + 4 + 9) / 7.0 / 3);
	EXPECT_EQ(ScoutText(32, 16, 0.25, 64, 0.125), "scout 32 16 0.25 64 0.125\n");
}

TEST(Pilot, BlocksAreSpreadOverThePicture)
{
	PilotRequest r;
	r.blocks = 64;
	r.samples = 64;
	const int side = PilotBlockSize;
	const auto blocks = PilotBlocks(r, 80 * side, 60 * side); // 80 x 60 blocks
	const auto quadrant = [](int block) { return (block / 80 >= 30) * 2 + (block % 80 >= 40); };
	EXPECT_EQ(std::set<int>(blocks.begin(), blocks.end()).size(), 64u);
	int count[4] = {};
	for(size_t i = 0; i < blocks.size(); i++)
	{
		count[quadrant(blocks[i])]++;
		// However early the pilot's time is up. The sequence's discrepancy at a power of two.
		for(int q : count)
			if(i + 1 == 8 || i + 1 == 16 || i + 1 == 64)
			{
				EXPECT_NEAR(q, double(i + 1) / 4, 3) << i;
			}
	}
	r.blocks = 100000;
	const auto all = PilotBlocks(r, 100, 30); // 7 x 2 blocks
	EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), 14u);
	EXPECT_EQ(all.size(), 14u);
}

// As many in a part of the picture as in the whole; a part in which no block begins has the one that holds its corner.
TEST(Pilot, BlocksOfAPart)
{
	PilotRequest r;
	r.blocks = 12;
	const int side = PilotBlockSize, columns = 120;
	const auto part = PilotBlocks(r, columns * side, 68 * side, 99, 99, 299, 299);
	EXPECT_EQ(std::set<int>(part.begin(), part.end()).size(), 12u);
	for(int block : part)
	{
		const int x = block % columns * side, y = block / columns * side;
		EXPECT_TRUE((x >= 99) && (x <= 299) && (y >= 99) && (y <= 299)) << x << " " << y;
	}
	EXPECT_EQ(PilotBlocks(r, columns * side, 68 * side, 5 * side + 1, 4 * side + 4, 5 * side + 1, 4 * side + 11), std::vector<int>{ 4 * columns + 5 });
	r.blocks = 1000;
	const auto all = PilotBlocks(r, columns * side, 68 * side, side - 1, side, 3 * side, 2 * side - 1);
	EXPECT_EQ(std::set<int>(all.begin(), all.end()), (std::set<int>{ columns + 1, columns + 2, columns + 3 }));
}
