// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which blocks a pilot traces, and what each stands for.

#include "block_choice.h"

#include <tiltcal/error.h>
#include "lens/pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

using namespace tiltcost;

namespace
{

const int Side = tilt_lens::PilotBlockSize, Columns = 60, Rows = 34;

ScoutedBlock At(int column, int row, double change)
{
	return {column * Side, row * Side, 1e-4, 64, change};
}

/// Flat but for a stripe of edges and a few specks, in no order.
std::vector<ScoutedBlock> Picture()
{
	std::vector<ScoutedBlock> blocks;
	std::mt19937 random(7);
	for (int row = 0; row < Rows; ++row)
		for (int column = 0; column < Columns; ++column)
			blocks.push_back(At(column, row, row / 3 == 4 ? 0.02 : random() % 40 == 0 ? 0.1 : 1e-5));
	std::shuffle(blocks.begin(), blocks.end(), random);
	return blocks;
}

}

TEST(BlockChoice, ReadsWhatTheRendererWrites)
{
	const std::string line = tilt_lens::ScoutText(32, 16, 0.25, 64, 0.125);
	const std::vector<ScoutedBlock> blocks = ParseScouted(line + tilt_lens::ScoutText(0, 0, 0.5, 32, 1) + line.substr(0, line.size() - 3));
	ASSERT_EQ(blocks.size(), 2u) << "without the line that was cut off";
	EXPECT_EQ(blocks[0].left, 32);
	EXPECT_EQ(blocks[0].top, 16);
	EXPECT_EQ(blocks[0].change, 0.125);
	EXPECT_DOUBLE_EQ(SecondsPerSample(blocks), 0.75 / 96);
	EXPECT_THROW(ParseScouted("block 0 0 16 16\n"), tiltcal::Error);
	EXPECT_TRUE(ParseScouted("").empty());
}

TEST(BlockChoice, ChancesAddUpAndAreKept)
{
	const BlockChoice choice(Picture());
	for (const size_t count : {1, 7, 120, 500, 2000})
	{
		double sum = 0, least = 1;
		int sure = 0;
		const std::vector<int> chosen = choice.Choose(count, Columns);
		const std::set<int> once(chosen.begin(), chosen.end());
		EXPECT_EQ(chosen.size(), count);
		EXPECT_EQ(once.size(), count) << "none twice";
		for (int block = 0; block < Columns * Rows; ++block)
		{
			const double chance = choice.ChanceOf(block % Columns * Side, block / Columns * Side, count).value();
			sum += chance;
			least = std::min(least, chance);
			if (chance > 1 - 1e-12)
			{
				++sure;
				EXPECT_TRUE(once.count(block)) << "sure, and left out";
			}
		}
		EXPECT_NEAR(sum, double(count), 1e-6);
		EXPECT_GE(least, 0.5 * double(count) / (Columns * Rows) * (1 - 1e-9)) << "what seems flat has half of an equal share";
		EXPECT_EQ(sure > 0, count >= 500);
	}
	EXPECT_EQ(choice.Choose(100000, Columns).size(), size_t(Columns * Rows));
	EXPECT_EQ(choice.ChanceOf(0, 0, 100000), 1.0);
	EXPECT_FALSE(choice.ChanceOf(0, Rows * Side, 120)) << "was not looked at";
}

// However early the pilot's time is up: systematic steps, so the share of the stripe is kept to a block or two.
TEST(BlockChoice, WhatComesFirstIsSpread)
{
	const BlockChoice choice(Picture());
	const std::vector<int> chosen = choice.Choose(128, Columns);
	double expected[4] = {};
	const auto quarter = [](int block) { return (block / Columns >= Rows / 2) * 2 + (block % Columns >= Columns / 2); };
	for (int block = 0; block < Columns * Rows; ++block)
		expected[quarter(block)] += choice.ChanceOf(block % Columns * Side, block / Columns * Side, 128).value() / 128;
	for (const size_t first : {16, 32, 64, 128})
	{
		int count[4] = {};
		for (size_t i = 0; i < first; ++i)
			++count[quarter(chosen[i])];
		// Morton's curve enters a quarter of this picture, which is no power of two, at most a few times: as many roundings.
		for (int q = 0; q < 4; ++q)
			EXPECT_NEAR(count[q], expected[q] * double(first), 4) << first;
	}
}

TEST(BlockChoice, NeighboursTellWhatABlocksOwnSamplesMissed)
{
	std::vector<ScoutedBlock> blocks;
	for (int i = 0; i < 9; ++i)
		blocks.push_back(At(i % 3, i / 3, i == 4 ? 0 : 0.04));
	const BlockChoice missed(blocks);
	EXPECT_NEAR(missed.WorthOf(Side, Side), std::pow(0.25 * 0.04, 0.75), 1e-12);
	EXPECT_NEAR(missed.WorthOf(0, 0), std::pow(0.75 * 0.04 + 0.25 * 0.04 * 2 / 3, 0.75), 1e-12);
	const BlockChoice alone({At(5, 5, 0.04)});
	EXPECT_NEAR(alone.WorthOf(5 * Side, 5 * Side), std::pow(0.04, 0.75), 1e-12);
	EXPECT_EQ(alone.WorthOf(0, 0), 0);
	// A picture without any change is chosen from evenly.
	for (ScoutedBlock& block : blocks)
		block.change = 0;
	EXPECT_NEAR(BlockChoice(blocks).ChanceOf(0, 0, 3).value(), 1.0 / 3, 1e-12);
}

TEST(BlockChoice, WeightsAddUpToWhatIsKnown)
{
	const BlockChoice choice(Picture());
	const size_t count = 120;
	std::vector<SampledBlock> sampled;
	for (const int block : choice.Choose(count, Columns))
	{
		const int left = block % Columns * Side, top = block / Columns * Side;
		sampled.push_back({choice.ChanceOf(left, top, count).value(), choice.WorthOf(left, top)});
	}
	const std::vector<double> weights = CalibratedWeights(sampled, double(choice.Blocks()), choice.Worth());
	double blocks = 0, worth = 0;
	for (size_t i = 0; i < sampled.size(); ++i)
	{
		EXPECT_GT(weights[i], 0);
		blocks += weights[i];
		worth += weights[i] * sampled[i].worth;
	}
	EXPECT_NEAR(blocks, Columns * Rows, 1e-6);
	EXPECT_NEAR(worth, choice.Worth(), 1e-9 * choice.Worth()) << "what is linear in the worth is exact";
	// All of one worth; and what no weights above 0 can make.
	EXPECT_EQ(CalibratedWeights({{0.5, 2}, {0.25, 2}}, 12, 99), (std::vector<double>{4, 8}));
	EXPECT_EQ(CalibratedWeights({{0.5, 1}, {0.5, 2}}, 10, 1000), (std::vector<double>{5, 5}));
}
