// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrator_statistics.h"
#include "paper_approximations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace
{

using namespace calibrator_cost;

TEST(CalibratorCost, ErrorIsAVector)
{
	const TiltError same = ErrorOf(-5, 180, 5);   // the same lens said in other words
	EXPECT_NEAR(std::hypot(same[0], same[1]), 0, 1e-12);
	const TiltError aside = ErrorOf(5, 90, 5);
	EXPECT_NEAR(aside[0], 5, 1e-12);
	EXPECT_NEAR(aside[1], -5, 1e-12);
}

TEST(CalibratorCost, ChoicesAreAllDifferent)
{
	EXPECT_EQ(Choices(6, 3), 20);
	EXPECT_EQ(Choices(6, 6), 1);
	std::set<std::vector<int>> seen;
	for (int k = 0; k < 20; ++k)
	{
		const std::vector<int> one = Choice(6, 3, k, 20);
		EXPECT_EQ(one.size(), 3u);
		seen.insert(one);
	}
	EXPECT_EQ(seen.size(), 20u);
}

TEST(CalibratorCost, ScatterOfOverlappingDrawsIsThatOfNewOnes)
{
	// Estimates that are means of some of six numbers: their scatter must come out as that of the mean of as
	// many new numbers, whichever way the draws overlap.
	std::mt19937 random(1);
	std::normal_distribution<double> normal(0.2, 1);
	for (const int chosen : { 1, 3, 5 })
	{
		double variance = 0;
		const int trials = 2000;
		for (int t = 0; t < trials; ++t)
		{
			double values[6];
			for (double& v : values)
				v = normal(random);
			std::vector<std::vector<TiltError>> errors;
			const int draws = 6;
			for (int k = 0; k < draws; ++k)
			{
				double sum = 0;
				for (const int i : Choice(6, chosen, k, draws))
					sum += values[i];
				errors.push_back({ { sum / chosen, 0 } });
			}
			Row row;
			Summarise(errors, chosen / 6.0, Choices(6, chosen), row);
			variance += row.scatter * row.scatter / trials;
		}
		// 2000 trials of five degrees of freedom know a variance to 1.4 %, fewer when draws are alike; for 3 of 6 the six
		// choices of twenty are spread, not drawn at random.
		EXPECT_NEAR(variance * chosen, 1, chosen == 3 ? 0.15 : 0.06) << chosen;
	}
}

TEST(CalibratorCost, BiasAndRms)
{
	Row row;
	Summarise({ { { 0.1, 0 }, { 0, 0.3 } }, { { 0.1, 0 }, { 0, 0.3 } } }, 0, 0, row);
	EXPECT_NEAR(row.rms, std::sqrt((0.01 + 0.09) / 2), 1e-12);
	EXPECT_NEAR(row.bias, row.rms, 1e-12);
	EXPECT_NEAR(row.scatter, 0, 1e-12);
	EXPECT_EQ(row.answers, 2);
	Row none;
	Summarise({}, 0, 0, none);
	EXPECT_EQ(none.answers, 0);
	EXPECT_LT(none.scatter, 0);
}

TEST(PaperApproximations, BothMendedGiveTheTilt)
{
	for (int pose = 0; pose < 6; ++pose)
	{
		// The paper's (2) is a circle; the tilted rim is an ellipse, shorter by 1 - cos 5 degrees = 0.4 %: 0.02 to 0.04 degrees.
		EXPECT_NEAR(calibrator_cost::TiltByPaper(pose, 5, { true, true }), 5, 0.05) << pose;
		EXPECT_GT(std::abs(calibrator_cost::TiltByPaper(pose, 5, { false, false }) - 5), 0.3) << pose;
	}
}

}
