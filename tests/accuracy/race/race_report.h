// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a race found, as a page and as tables.
#pragma once
#include "race_contest.h"

#include <filesystem>
#include <string>
#include <vector>

struct RaceReport
{
	std::vector<Contest> contests;
	RaceSettings settings;
	Programs programs;
	std::string conditions; // machine, day, mode
	Reuse reused = Reuse::NOTHING;
};

// points.csv, ratios.csv (each ratio without denoise and at the best) and truths.csv.
void WriteTables(const RaceReport& report, const std::filesystem::path& out);

// report.html, self-contained; `work` receives what is made on the way. Fragments that lie in `out` are taken in:
// calibrator-cost.html, calibrator-ablation.html, tiltcost.html, cost-of-nothing.html, gallery-seconds.html.
void WritePage(const RaceReport& report, const std::filesystem::path& out, const std::filesystem::path& work);

// The SVG of a contest's curves: RMS error, or the root of relMSE.
std::string PlotOf(const Contest& contest, bool rel_mse, const std::filesystem::path& work);

// Geometric mean of ratios.
class MeanRatio
{
public:
	void Add(const Ratio& ratio);
	int Count() const { return count; }
	double Value() const; // 0 without any
	std::string InWords() const; // two digits, with "?" where one of the ratios is of a time at its floor

private:
	double log_sum = 0;
	int count = 0;
	bool at_floor = false;
};

// Of the ratios against a rival over contests and errors.
MeanRatio MeanAgainst(const RaceReport& report, Opponent rival, Side side);
double GeometricMean(const RaceReport& report, Opponent rival, Side side);

// Time without a lever of ours over time with it, at equal error: geometric means over the contests that have both.
struct Lever
{
	std::string title;
	int contests = 0;
	std::vector<double> at; // each of the settings' errors
	double mean = 0, least = 0, most = 0;
	std::string least_in, most_in; // titles of contests
};
std::vector<Lever> Levers(const RaceReport& report);

// Parts of the page: what each lever is worth alone; ratios by the size of the picture, from the tables that this race wrote into `out` and
// that races with --size left in folders of it. Empty where nothing was raced.
std::string LeversSection(const RaceReport& report);
std::string SizesSection(const RaceReport& report, const std::filesystem::path& out);

// Lines for a terminal: every contest's ratios at every error, without denoise and at the best.
std::string RatiosInWords(const RaceReport& report);

// Sentences on where ours gains nothing, or least.
std::string WhereWeLose(const RaceReport& report, Side side);

// ">" for at least, "<" for at most, "~" for both; "?" where a time is at its floor.
const char* Sign(const Ratio& ratio);
