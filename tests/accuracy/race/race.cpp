// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What accuracy costs: tilt_lens against stock focal blur, averaged pinholes and itself with a fixed N.
//
//   race --ours POVRAY --stock POVRAY [--quick | --bench | --size WxH] [--scene NAME ...] --out DIR --work DIR
#include "race_report.h"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>

namespace fs = std::filesystem;

namespace
{

struct Entry
{
	RaceScene scene;
	bool tilted;
	std::string Name() const { return scene.name + (tilted ? "-tilted" : ""); }
};

// Does this tilt_lens know the word `seed`?
bool KnowsSeed(const fs::path& program, const fs::path& work)
{
	std::ofstream(work / "seed.pov") << "#version 3.7;\nglobal_settings { assumed_gamma 1 }\ncamera { tilt_lens { seed 1 } location -z look_at 0 }\n";
	try
	{
		RunMeasured({program.string(), "-D", "+Iseed.pov", "+Oseed.ppm", "+FP", "+W1", "+H1"}, work, work / "seed.log");
		return true;
	}
	catch (const std::runtime_error&)
	{
		return false;
	}
}

// A copy of the program, made once.
fs::path Kept(const fs::path& program, const fs::path& copy)
{
	fs::path partial = copy;
	partial += ".partial";
	if (!fs::exists(copy))
	{
		fs::copy_file(program, partial, fs::copy_options::overwrite_existing);
		fs::rename(partial, copy);
	}
	return copy;
}

std::string Processor()
{
	std::ifstream file("/proc/cpuinfo");
	for (std::string line; std::getline(file, line);)
		if (line.compare(0, 10, "model name") == 0 && line.find(": ") != std::string::npos)
			return line.substr(line.find(": ") + 2);
	return "an unknown processor";
}

// Whether the truths are those of stock's pinholes, where they were asked and stock is the slower one.
bool StandsUp(const RaceReport& report)
{
	bool good = true;
	for (const Contest& contest : report.contests)
		if (contest.pinhole_frames > 0 && contest.pinhole_distance > contest.PinholeBound())
		{
			std::fprintf(stderr, "race: %s: the truth is %.5f from stock's pinholes, with errors of %.5f and %.5f\n", contest.Name().c_str(), contest.pinhole_distance,
				contest.truth_error, contest.pinhole_error);
			good = false;
		}
	for (const Side side : {Side::RAW, Side::BEST})
		if (const double ratio = GeometricMean(report, Opponent::STOCK, side); ratio > 0 && ratio < 1)   // 0: none of the contests asked is comparable
		{
			std::fprintf(stderr, "race: stock is the faster one, by the geometric mean\n");
			good = false;
		}
	return good;
}

}

int main(int argc, char** argv)
try
{
	Programs programs;
	fs::path scenes, settings_file, out, work;
	std::vector<std::string> names;
	std::string mode = "full", size;
	bool quick = false, bench = false, list = false, reuse_stock = false, resume = false;
	int jobs = 1;
	CLI::App app{"Error against CPU time: tilt_lens, stock focal blur, averaged pinholes."};
	app.add_option("--ours", programs.ours, "the patched povray")->required();
	app.add_option("--reference", programs.reference, "the patched povray that makes the truths (default: --ours); keep one while changing the other");
	app.add_option("--stock", programs.stock, "an unpatched povray")->required();
	app.add_option("--scenes", scenes, "folder of scenes")->required();
	app.add_option("--settings", settings_file, "race/settings.json")->required();
	app.add_option("--scene", names, "race these alone; NAME or NAME-tilted");
	app.add_option("--out", out, "folder of the report")->required();
	app.add_option("--work", work, "folder of everything else; keeps references")->required();
	app.add_option("--jobs", jobs, "scenes at a time")->check(CLI::Range(1, 64));
	CLI::Option *quickly = app.add_flag("--quick", quick, "smaller pictures, fewer settings");
	CLI::Option *benched = app.add_flag("--bench", bench, "what a change is worth, in minutes: larger pictures, few settings; stock and the truths, by the first --ours, are made once and kept in --work")->excludes(quickly);
	app.add_option("--size", size, "640x360 or 1920x1080: larger pictures, few settings; tilted planes only where --scene names them, at 640x360; of the largest their middle alone")
		->check(CLI::IsMember({"640x360", "1920x1080"}))->excludes(quickly)->excludes(benched);
	app.add_flag("--list", list, "list the contests");
	app.add_flag("--reuse-stock", reuse_stock, "take stock's pictures and times from an earlier race; for work on tilt_lens");
	app.add_flag("--resume", resume, "go on with a race of the same programs that was stopped: what has run is taken from --work");
	try
	{
		app.parse(argc, argv);
	}
	catch (const CLI::ParseError& error)
	{
		return app.exit(error) == 0 ? 0 : 2;
	}
	if (quick || bench)
		mode = quick ? "quick" : "bench";
	else if (!size.empty())
		mode = size;
	const Reuse reuse = resume ? Reuse::ALL : reuse_stock || bench ? Reuse::STOCK : Reuse::NOTHING;
	RaceReport report;
	report.settings = ReadSettings(settings_file, mode);
	report.reused = reuse;

	std::vector<Entry> entries;
	for (const RaceScene& scene : ReadScenes(scenes))
		for (bool tilted : {false, true})
		{
			const Entry entry{scene, tilted};
			const bool named = std::find(names.begin(), names.end(), entry.Name()) != names.end();
			if (tilted > (scene.tilted && report.settings.pinhole_frames > 0) || (names.empty() ? tilted && !size.empty() : !named))
				continue;
			entries.push_back(entry);
			if (list)
				std::printf("%-20s %s%s: %s\n", entry.Name().c_str(), scene.title.c_str(), tilted ? ", tilted" : "", scene.shows.c_str());
		}
	if (list)
		return 0;
	if (entries.empty())
		throw std::runtime_error("no such scene; --list names them");

	fs::create_directories(out);
	work = fs::absolute(work) / mode;
	fs::create_directories(work);
	if (programs.reference.empty())
		programs.reference = bench ? Kept(programs.ours, work / "reference-povray") : programs.ours;
	for (fs::path* program : {&programs.ours, &programs.stock, &programs.reference})
		*program = fs::absolute(*program);
	programs.seed = KnowsSeed(programs.ours, work) && KnowsSeed(programs.reference, work);
	report.programs = programs;

	const auto start = std::chrono::steady_clock::now();
	std::map<std::size_t, Contest> finished; // by the order of the list, not of the finish
	std::vector<std::string> failures;
	std::atomic<std::size_t> next{0}, done{0};
	std::mutex mutex;
	// After every contest, so that a race that is stopped leaves what it has.
	const auto write = [&] {
		const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
		report.contests.clear();
		for (const auto& entry : finished)
			report.contests.push_back(entry.second);
		report.conditions = fmt::format("{:%Y-%m-%d}, {}, {} mode, {} of {} contests, {} x {} pixels, {} at a time, {:.0f} minutes.",
			fmt::localtime(std::time(nullptr)), Processor(), mode, finished.size(), entries.size(), report.settings.width,
			report.settings.height, jobs, seconds.count() / 60);
		WriteTables(report, out);
		WritePage(report, out, work);
	};
	const auto worker = [&] {
		for (std::size_t i; (i = next++) < entries.size();)
		{
			const Entry& entry = entries[i];
			const auto say = [&](const std::string& line) {
				const std::lock_guard<std::mutex> lock(mutex);
				const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
				std::fprintf(stderr, "%6.0f s  %zu of %zu done  %-16s %s\n", seconds.count(), done.load(), entries.size(),
					entry.Name().c_str(), line.c_str());
			};
			try
			{
				const Renderer renderer(programs, entry.scene, work, entry.Name(), report.settings);
				Contest contest = RunContest(renderer, entry.scene, entry.tilted, report.settings, reuse, say);
				const std::lock_guard<std::mutex> lock(mutex);
				finished[i] = std::move(contest);
				write();
			}
			catch (const std::exception& error)
			{
				const std::lock_guard<std::mutex> lock(mutex);
				failures.push_back(entry.Name() + ": " + error.what());
			}
			++done;
			say("done");
		}
	};
	std::vector<std::thread> threads;
	for (int i = 0; i < jobs; ++i)
		threads.emplace_back(worker);
	for (std::thread& thread : threads)
		thread.join();
	for (const std::string& failure : failures)
		std::fprintf(stderr, "race: %s\n", failure.c_str());
	if (!failures.empty())
		return 1;

	std::fputs(RatiosInWords(report).c_str(), stdout);
	for (const Side side : {Side::RAW, Side::BEST})
		std::printf("time over ours %s at equal RMS error, geometric means: stock %s, averaged pinholes %s, fixed N %s\n%s\n",
			side == Side::RAW ? "without denoise" : "at its best, denoised where that is quicker", MeanAgainst(report, Opponent::STOCK, side).InWords().c_str(),
			MeanAgainst(report, Opponent::PINHOLES, side).InWords().c_str(), MeanAgainst(report, Opponent::FIXED, side).InWords().c_str(), WhereWeLose(report, side).c_str());
	std::printf("%s\n", (out / "report.html").string().c_str());
	return StandsUp(report) ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "race: %s\n", error.what());
	return 2;
}
