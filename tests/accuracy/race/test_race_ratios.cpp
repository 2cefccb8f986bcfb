// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which of our settings run on which side of a race, on times and errors that are made up: all fall like 1/sqrt(time).

#include "race_report.h"

#include "program/temporary_folder.h"

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

// A run that is as short as the start-up's drift, or shorter than the start-up was, is no thousand times faster than another.
TEST(RaceTimes, NothingIsFasterThanTheStartUpIsKnown)
{
	EXPECT_DOUBLE_EQ(NetTime(2.0, 0.06), 1.94);
	EXPECT_DOUBLE_EQ(NetTime(0.061, 0.06), 0.02);
	EXPECT_DOUBLE_EQ(NetTime(0.05, 0.06), 0.02);
}

// What is read from such a time says so, in a ratio's sign; of repeats it is the least that counts.
TEST(RaceTimes, ARatioOfATimeThatIsNotKnownIsMarked)
{
	RacePoint point;
	point.Add(0.07, 0.06);
	EXPECT_TRUE(point.at_floor);
	point.Add(0.09, 0.06);
	EXPECT_TRUE(point.at_floor);
	point.times.clear();
	point.Add(2.0, 0.06, 0.25);
	EXPECT_FALSE(point.at_floor);
	EXPECT_DOUBLE_EQ(point.Time(), 1.94 / 4);

	Contest contest = Made(2, 4, 6);
	contest.points[Opponent::STOCK][0].at_floor = true; // the coarsest
	EXPECT_STREQ(Sign(RatioAt(contest, Opponent::STOCK, 0.015, Side::BEST)), "?");
	EXPECT_STREQ(Sign(RatioAt(contest, Opponent::STOCK, 0.03, Side::RAW)), "?");
	EXPECT_STREQ(Sign(RatioAt(contest, Opponent::STOCK, 0.004, Side::BEST)), "");
	EXPECT_STREQ(Sign(RatioAt(contest, Opponent::FIXED, 0.015, Side::BEST)), "");

	RaceReport report;
	report.contests = {Made(2, 4, 6), contest};
	report.settings.errors = {0.004};
	EXPECT_EQ(MeanAgainst(report, Opponent::STOCK, Side::BEST).InWords(), "6.00");
	report.settings.errors = {0.015};
	EXPECT_EQ(MeanAgainst(report, Opponent::STOCK, Side::BEST).InWords(), "?6.00");
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

// Times to errors that are less than twice the truth's own say nothing: they are in no mean and no table.
TEST(RaceRatios, WhatTheTruthCannotTellIsLeftOut)
{
	RaceReport report;
	report.settings.errors = {0.01, 0.005};
	report.contests = {Made(2, 4, 6), Made(3, 12, 24)};
	report.contests[1].truth_error = 0.004;
	EXPECT_TRUE(report.contests[1].Tells(0.01));
	EXPECT_FALSE(report.contests[1].Tells(0.005));
	// 6 at both errors, 4 at the first.
	EXPECT_NEAR(GeometricMean(report, Opponent::STOCK, Side::BEST), std::cbrt(6.0 * 6.0 * 4.0), 1e-9);
	EXPECT_NE(RatiosInWords(report).find("- /     -"), std::string::npos) << RatiosInWords(report);
	report.contests[1].truth_error = 0.02;
	EXPECT_NEAR(GeometricMean(report, Opponent::STOCK, Side::BEST), 6, 1e-9);
}

TEST(RaceRatios, ALeverIsWorthWhatItSavesAlone)
{
	RaceReport report;
	report.settings.errors = {0.01, 0.005};
	Contest shed = Made(2, 4, 6), lamp = Made(3, 3, 6);
	shed.scene.title = "Shed";
	lamp.scene.title = "Lamp";
	lamp.points[Opponent::GRID] = Points(30);
	for (Contest* contest : {&shed, &lamp})
		for (auto& [opponent, points] : contest->points)
			for (RacePoint& point : points)
			{
				point.setting.opponent = opponent;
				point.setting.variance = opponent == Opponent::RAW ? 1e-3 : 0;
				point.setting.denoise = opponent == Opponent::OURS;
				point.setting.grid = opponent == Opponent::GRID;
			}
	report.contests = {shed, lamp};
	const std::vector<Lever> levers = Levers(report);
	ASSERT_EQ(levers.size(), 5u);
	EXPECT_NEAR(levers[0].mean, 2, 1e-9);                  // 12 / 6
	EXPECT_NEAR(levers[1].mean, 5, 1e-9);                  // 30 / 6
	EXPECT_EQ(levers[1].contests, 1);
	EXPECT_NEAR(levers[2].mean, std::sqrt(1.5 * 2), 1e-9); // 6 / 4, 6 / 3
	EXPECT_EQ(levers[2].least_in, "Shed");
	EXPECT_NEAR(levers[3].mean, std::sqrt(3.0 * 2), 1e-9);  // 6 / 2, 6 / 3
	EXPECT_NEAR(levers[3].at[1], std::sqrt(3.0 * 2), 1e-9);
	EXPECT_EQ(levers[3].most_in, "Shed");
	EXPECT_NEAR(levers[4].mean, levers[3].mean, 1e-9);      // both at their quickest
}

TEST(RaceRatios, SizesStandBesideThisRaces)
{
	const tiltcal::TemporaryFolder folder{"tiltcal-race"};
	const std::filesystem::path size = folder.File("640x360"), out = size.parent_path();
	RaceReport report;
	report.settings.errors = {0.01};
	report.settings.width = 160;
	report.settings.height = 120;
	report.contests = {Made(2, 4, 6)};
	report.contests[0].scene.name = "shed";
	EXPECT_EQ(SizesSection(report, out), "");
	std::filesystem::create_directory(size);
	WriteTables(report, out);
	RaceReport large = report;
	large.contests = {Made(1, 3, 6)};
	large.contests[0].scene.name = "shed";
	WriteTables(large, size);
	const std::string text = SizesSection(report, out);
	EXPECT_NE(text.find("<td>shed</td><td>3.00 / 6.00</td><td>4.00 / 12.00</td>"), std::string::npos) << text;

	// The largest size has one of two scenes: the other stays, and each mean is of the scenes that its size has.
	large.contests.push_back(Made(2, 4, 6));
	large.contests[1].scene.name = "barn";
	WriteTables(large, size);
	std::filesystem::create_directory(out / "1920x1080");
	WriteTables(report, out / "1920x1080");
	const std::string both = SizesSection(report, out);
	EXPECT_NE(both.find("<td>barn</td><td>-</td><td>3.00 / 6.00</td><td>-</td>"), std::string::npos) << both;
	EXPECT_NE(both.find("<td>shed</td><td>3.00 / 6.00</td><td>4.00 / 12.00</td><td>3.00 / 6.00</td>"), std::string::npos) << both;
	EXPECT_NE(both.find("<td>geometric mean</td><td>3.00 / 6.00</td><td>3.46 / 8.49</td><td>3.00 / 6.00</td>"), std::string::npos) << both;
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

// Of the smaller size whole pictures are judged, and stock's grids on the lamps, which the larger one's middle has not.
TEST(RaceSettings, SizesAreThoseOfTheirNames)
{
	const RaceSettings half = ReadSettings(RACE_SETTINGS, "640x360"), full = ReadSettings(RACE_SETTINGS, "1920x1080");
	EXPECT_EQ(half.width, 640);
	EXPECT_EQ(half.judged_width, 640);
	EXPECT_EQ(half.judged_height, 360);
	EXPECT_EQ(full.height, 1080);
	EXPECT_LT(full.judged_width, full.width);
	EXPECT_EQ(full.pinhole_frames, 0);
	EXPECT_GT(half.pinhole_frames, 0);
	EXPECT_TRUE(full.grid.empty());
	EXPECT_FALSE(half.grid.empty());
	EXPECT_FALSE(ReadSettings(RACE_SETTINGS, "full").grid.empty());
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
