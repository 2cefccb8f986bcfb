// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which of our settings run on which side of a race, on times and errors that are made up: all fall like 1/sqrt(time).

#include "race_report.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

// An opponent that needs `seconds` for an error of 0.01.
std::vector<RacePoint> Points(double seconds)
{
	std::vector<RacePoint> points;
	for (const double error : {0.02, 0.01, 0.005, 0.002})
	{
		RacePoint point;
		point.times = {seconds * std::pow(0.01 / error, 2)};
		point.rms_truth = point.rms_shifted = point.rms_limit = error;
		point.rel_mse = error * error;
		points.push_back(point);
	}
	return points;
}

Contest Made(double denoised, double raw, double fixed)
{
	Contest contest;
	contest.points[Opponent::STOCK] = Points(12);
	contest.points[Opponent::OURS] = Points(denoised);
	contest.points[Opponent::RAW] = Points(raw);
	contest.points[Opponent::FIXED] = Points(fixed);
	return contest;
}

double At(const Contest& contest, Opponent opponent, Side side)
{
	return RatioAt(contest, opponent, 0.005, side).value;
}

}

TEST(RaceRatios, RawIsNotDenoised)
{
	const Contest contest = Made(2, 4, 6);
	EXPECT_NEAR(At(contest, Opponent::STOCK, Side::BEST), 6, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::STOCK, Side::RAW), 3, 1e-9);
	EXPECT_NEAR(RelMseRatioAt(contest, Opponent::STOCK, 25e-6, Side::RAW).value, 3, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::FIXED, Side::BEST), 3, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::FIXED, Side::RAW), 1.5, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::RAW, Side::BEST), 2, 1e-9);
}

TEST(RaceRatios, BestIsTheQuickestOfAll)
{
	// Denoising that is slower than adaptive samples, and these than a fixed number.
	const Contest contest = Made(8, 4, 3);
	EXPECT_NEAR(At(contest, Opponent::STOCK, Side::BEST), 4, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::STOCK, Side::RAW), 4, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::FIXED, Side::RAW), 0.75, 1e-9);
	EXPECT_NEAR(At(contest, Opponent::RAW, Side::BEST), 0.375, 1e-9);
}

TEST(RaceRatios, MeansAreOfASide)
{
	RaceReport report;
	report.settings.errors = {0.01, 0.005};
	report.contests = {Made(2, 4, 6), Made(3, 12, 24)};
	EXPECT_NEAR(GeometricMean(report, Opponent::STOCK, Side::BEST), std::sqrt(6.0 * 4.0), 1e-9);
	EXPECT_NEAR(GeometricMean(report, Opponent::STOCK, Side::RAW), std::sqrt(3.0 * 1.0), 1e-9);
	EXPECT_NE(WhereWeLose(report, Side::RAW), WhereWeLose(report, Side::BEST));
}

TEST(RaceRatios, LinesForATerminalHaveBothSidesOfEveryContest)
{
	RaceReport report;
	report.settings.errors = {0.01, 0.005};
	report.contests = {Made(2, 4, 6)};
	report.contests[0].scene.name = "shed";
	EXPECT_EQ(RatiosInWords(report),
		"raw / best, at                      0.01             0.005\n"
		"shed                        3.00 /  6.00      3.00 /  6.00\n");
}

// --bench: stock once, no pinholes, and truths whose own error is below what is asked for at the finest.
TEST(RaceSettings, BenchHasNoPinholesAndCountsTheSmallestNumbersOfSamples)
{
	const RaceSettings bench = ReadSettings(RACE_SETTINGS, "bench"), full = ReadSettings(RACE_SETTINGS, "full");
	EXPECT_EQ(bench.pinhole_frames, 0);
	EXPECT_EQ(bench.check_frames, 0);
	EXPECT_GT(bench.width * bench.height, full.width * full.height);
	EXPECT_EQ(bench.errors, full.errors);
	EXPECT_LT(5 * bench.reference_error, bench.errors.back() + 1e-12);
	for (const auto* list : {&bench.stock, &bench.ours, &bench.raw, &bench.fixed})
		EXPECT_FALSE(list->empty());
}

// Two blocks of 8 x 8: 1.2 times the other picture's error in one, 1.05 times in the other.
TEST(Race, BlocksThatAreMoreThanATenthWorseAreCounted)
{
	const Picture truth{16, 8, std::vector<double>(16 * 8 * 3, 0.5), {}};
	Picture other = truth, picture = truth;
	for (std::size_t i = 0; i < truth.rgb.size(); ++i)
	{
		other.rgb[i] += 0.01;
		picture.rgb[i] += i / 3 % 16 < 8 ? 0.012 : 0.0105;
	}
	EXPECT_EQ(ShareOfWorseBlocks(picture, other, truth), 0.5);
	EXPECT_EQ(ShareOfWorseBlocks(truth, truth, truth), 0);
}
