// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What tiltcost makes of predictions: the search for settings, the plan of its pilot, its words.

#include "pilot_blocks.h"
#include "pilot_run.h"
#include "prediction.h"
#include "report.h"
#include "search.h"

#include "lens/denoise.h"
#include "lens/pilot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace tiltcost;
using testing::HasSubstr;

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
	const Machine machine{1e6, 0, 0, 1, 1, 0, 1e-6};
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

// Of a pilot of few samples: dearer settings than it knows are not what is found, and keep nothing from being found.
TEST(Search, DenoisedBelowAnErrorIsOfTheSettingsThatThePilotKnows)
{
	const Pilot pilot(ParsePilot(Noisy(0, true, 64) + Noisy(16, true, 64) + Noisy(32, true, 64)));
	const Machine machine{1e6, 0, 0, 1, 1, 0, 1e-6};
	std::vector<Row> known = BestRows(AllRows(pilot, machine));
	const auto beyond = [&](const Row& row) { return row.setting.max > pilot.Samples(); };
	// Between all that are known, one that is not.
	const Row unknown = *std::find_if(known.begin(), known.end(), beyond);
	known.erase(std::remove_if(known.begin(), known.end(), beyond), known.end());
	ASSERT_GE(known.size(), 4u);
	std::vector<Row> best;
	for (const Row& row : known)
	{
		best.push_back(row);
		best.push_back(unknown);
	}
	for (const Row& row : known)
	{
		const double error = pilot.PredictDenoised(row.setting);
		const auto found = CheapestDenoised(pilot, machine, best, error);
		ASSERT_TRUE(found);
		EXPECT_LE(found->setting.max, pilot.Samples());
		EXPECT_LE(found->denoised_error, error);
	}
	EXPECT_FALSE(CheapestDenoised(pilot, machine, best, 1e-9));
}

TEST(Search, ThreadsShareDenoisingByBands)
{
	Machine machine{1e6, 0, 0, 1, 1, 0, 1e-6};
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

TEST(PilotRun, PartsOfAFilmAreThoseThatTheOptionsSay)
{
	RenderLog log;
	log.first_frame = 1;
	log.last_frame = 48;
	log.rendered_frames = 11;
	const auto frames = [&](const std::vector<std::string>& options)
	{
		const std::optional<FrameRange> range = RenderedFrames(log, options);
		return range ? std::pair{range->first, range->last} : std::pair{0, 0};
	};
	const std::pair part{30, 40};
	EXPECT_EQ(frames({"+SF30", "+EF40"}), part);
	EXPECT_EQ(frames({"Subset_Start_Frame=30", "subset_end_frame=40"}), part);
	EXPECT_EQ(frames({"Subset_Start_Frame=30", "+EF40"}), part);
	EXPECT_EQ(frames({"+ef40"}), part) << "an ini file says where it begins";
	EXPECT_EQ(frames({"+SF3", "+SF30"}), part) << "the last one counts";
	EXPECT_EQ(frames({"+SF0.5", "+EF40"}), part);
	EXPECT_EQ(frames({"+SF38"}), (std::pair{38, 48}));
	EXPECT_EQ(frames({"+EF60"}), (std::pair{38, 48}));
	EXPECT_EQ(frames({"+SF0.5"}), (std::pair{0, 0})) << "a part, not a number";
	EXPECT_EQ(frames({}), (std::pair{0, 0}));
	log.rendered_frames = 48;
	EXPECT_EQ(frames({}), (std::pair{1, 48}));
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
