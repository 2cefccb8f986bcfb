// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The counting of blocks that are worse, on pictures whose noise is known.

#include "no_harm/block_harm.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

const int Width = 160, Height = 120, Blocks = Width * Height / (HarmBlock * HarmBlock), Pairs = 16;

/// A grey picture with normal noise of `sigma`, and of `other` in the block at (40, 24).
Picture Noisy(double sigma, double other, std::mt19937& random)
{
	std::normal_distribution<double> normal;
	Picture picture{Width, Height, std::vector<double>(3 * Width * Height), {}};
	for (int y = 0; y < Height; ++y)
		for (int x = 0; x < Width; ++x)
		{
			const bool there = x / HarmBlock == 5 && y / HarmBlock == 3;
			for (int c = 0; c < 3; ++c)
				picture.rgb[std::size_t(3 * (y * Width + x) + c)] = 0.5 + (there ? other : sigma) * normal(random);
		}
	return picture;
}

BlockHarm Compared(double sigma, double other, unsigned seed)
{
	std::mt19937 random(seed);
	std::vector<Picture> raw, made;
	for (int i = 0; i < Pairs; ++i)
	{
		raw.push_back(Noisy(0.1, 0.1, random));
		made.push_back(Noisy(sigma, other, random));
	}
	return CompareBlocks(raw, made, Noisy(0, 0, random));
}

}

TEST(BlockHarm, EqualNoiseIsCalledWorseAsOftenAsChanceSays)
{
	BlockHarm sum;
	for (unsigned seed = 0; seed < 10; ++seed)
		sum.Add(Compared(0.1, 0.1, seed));
	EXPECT_EQ(sum.blocks, 10 * Blocks);
	// 3 of 3000 are expected: between 0 and what comes once in 10,000.
	EXPECT_LE(sum.any, HarmAllowed(sum.blocks));
	EXPECT_EQ(sum.tenth, 0);
}

TEST(BlockHarm, OneBlockThatIsWorseIsFound)
{
	// 192 values a block and 16 pairs: the mean square is known to 2.6 %, so 15 % more noise is found, 1.32 in squares.
	const BlockHarm harm = Compared(0.05, 0.115, 1);
	EXPECT_EQ(harm.any, 1);
	EXPECT_EQ(harm.worst_x, 40);
	EXPECT_EQ(harm.worst_y, 24);
	EXPECT_NEAR(harm.worst, 1.15, 0.03);
	EXPECT_EQ(harm.tenth, 0);
	EXPECT_EQ(Compared(0.05, 0.13, 1).tenth, 1);
	EXPECT_NEAR(harm.raw / harm.made, 4, 0.1);
}

TEST(BlockHarm, WhatIsNotShownAndWhatIsRoundedIsNoHarm)
{
	std::mt19937 random(1);
	Picture truth = Noisy(0, 0, random), made = truth, rounded = truth;
	for (double& v : truth.rgb)
		v = 1.5;
	for (std::size_t i = 0; i < made.rgb.size(); ++i)
	{
		made.rgb[i] = 1.2 + 0.1 * double(i % 7);
		rounded.rgb[i] = 0.5 * (1 + (i % 2 ? 1 : -1) / 8192.0);
	}
	EXPECT_EQ(CompareBlocks({truth, truth}, {made, made}, truth).any, 0);
	const Picture grey = Noisy(0, 0, random);
	const BlockHarm harm = CompareBlocks({grey, grey}, {rounded, rounded}, grey);
	EXPECT_EQ(harm.any + harm.once, 0);
	EXPECT_EQ(CompareBlocks({truth, truth}, {grey, grey}, truth).any, Blocks);
}

// Poisson's distribution, tables: of 0.3 more than 4 come with 1.6e-5, more than 3 with 2.7e-4.
TEST(BlockHarm, AllowedIsPoissons)
{
	EXPECT_EQ(HarmAllowed(300), 4);
	EXPECT_EQ(HarmAllowed(0 + 1), 1);
}
