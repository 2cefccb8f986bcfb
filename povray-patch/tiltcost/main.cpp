// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcost: what accuracy costs in time, for the user's own scene.

#include <tiltcal/error.h>
#include "base/distinct_files.h"
#include "base/files.h"
#include "base/stopwatch.h"
#include "program/process.h"
#include "program/program.h"
#include "tiltcost/lens_page.h"
#include "tiltcost/options.h"
#include "tiltcost/progress.h"
#include "tiltcost/report.h"
#include "tiltcost/rows.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace
{

using namespace tiltcost;

/// Before the work starts, not after it.
void CheckFiles(const Options& options)
{
	if (!options.plot.empty() && tiltcal::RunProcess({{"gnuplot", "--version"}}).exit_code != 0)
		throw tiltcal::FileError(fmt::format("{}: cannot be plotted without gnuplot; install gnuplot-nox, or leave --plot out", options.plot));
	if (options.job.povray.find('/') != std::string::npos && access(options.job.povray.c_str(), X_OK) != 0)
		throw tiltcal::FileError(fmt::format("{}: no such program; build the target povray, or give the patched POV-Ray with --povray", options.job.povray));
	std::vector<tiltcal::NamedFile> read;
	for (const std::string& file : options.files)
		read.push_back({"SCENE", IsIniFile(file) ? WithoutSection(file) : file});
	tiltcal::CheckDistinct(read, {{"--plot", options.plot}, {"--csv", options.csv}, {"--rows", options.rows}, {"--page", options.page}});
	for (const std::string& file : {options.plot, options.csv, options.rows, options.page})
	{
		if (file.empty())
			continue;
		const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
		if (std::filesystem::is_directory(file) || access(folder.c_str(), W_OK | X_OK) != 0)
			throw tiltcal::FileError(fmt::format("{}: cannot be written; check the folder {}", file, folder.string()));
	}
}

/// A setting for each frame of a film that had a pilot.
std::vector<FrameRow> FrameRows(const FilmRun& film, const Setting& setting)
{
	std::vector<FrameRow> rows;
	for (size_t i = 0; i < film.frames.size(); ++i)
	{
		const Pilot pilot(film.runs[i].blocks, film.runs[i].pictures);
		const Row row = MakeRow(pilot, film.runs[i].machine, setting);
		rows.push_back({film.frames[i], setting.denoise ? WithDenoise(pilot, film.runs[i].machine, row) : row});
	}
	return rows;
}

[[noreturn]] void RefuseBound(const std::vector<Row>& best)
{
	throw tiltcal::Refused(fmt::format("blur_samples up to 8192 do not reach it; the finest settings are\n{}", AnswerText(best.back())));
}

/// The best without denoise that --time, --error or --levels allows; nothing where none was asked, or --error is beyond all.
std::optional<Row> RawAnswer(const Options& options, const std::vector<Row>& best)
{
	const Figure error = [](const Row& r) { return r.predicted.error; };
	const Figure levels = [](const Row& r) { return r.predicted.Levels(); };
	std::optional<Row> row;
	if (options.time > 0)
	{
		row = BestWithin(best, options.time);
		if (!row)
			throw tiltcal::Refused(fmt::format("nothing is as fast as {}; the coarsest settings are\n{}", DurationText(options.time), AnswerText(best.front())));
	}
	else if (options.error > 0 || options.levels > 0)
	{
		row = options.error > 0 ? CheapestBelow(best, error, options.error) : CheapestBelow(best, levels, options.levels);
		if (!row && options.levels > 0)
			RefuseBound(best);
	}
	return row;
}

/// One setting that is printed, with how sure it is.
std::string SureText(const Pilot& pilot, const Machine& machine, Row row)
{
	std::vector<double> left_out;
	if (row.setting.denoise)
		pilot.PredictDenoised(row.setting, &left_out, SpreadParts);
	row.spread = SpreadOf(pilot, machine, row.setting, left_out);
	return AnswerText(row);
}

/// The answer, with denoise where that is better or cheaper, and then what there is without; nothing where none was asked.
std::string Answer(const Options& options, const Pilot& pilot, const Machine& machine, const std::vector<Row>& all, const std::vector<Row>& best, std::optional<Row>& row)
{
	row = RawAnswer(options, best);
	if (!row && options.error <= 0)
		return {};
	std::optional<Row> denoised;
	if (options.error > 0)
		denoised = CheapestDenoised(pilot, machine, best, options.error);
	else if (options.time > 0)
		denoised = BestDenoisedWithin(pilot, machine, all, options.time);
	if (!row)
	{
		if (!denoised)
			RefuseBound(best);
		row = denoised;
		return SureText(pilot, machine, *row) + "Without denoise blur_samples up to 8192 do not reach it.\n";
	}
	if (!denoised || (options.time > 0 ? denoised->denoised_error >= row->predicted.error : denoised->wall >= row->wall))
		return SureText(pilot, machine, *row);
	const std::string text = SureText(pilot, machine, *denoised) + "Without denoise:\n" + SureText(pilot, machine, *row);
	row = denoised;
	return text;
}

/// The table's column of errors with denoise, where the pilot knows enough, the time that it takes, and how sure each row is.
void CompleteTable(const Pilot& pilot, Report& report)
{
	for (auto* rows : {&report.rows, &report.own})
		for (Row& row : *rows)
		{
			std::vector<double> left_out;
			if (row.setting.max <= pilot.Samples())
				row.denoised_error = pilot.PredictDenoised(row.setting, &left_out, SpreadParts);
			row.spread = SpreadOf(pilot, report.pilot.machine, row.setting, left_out);
		}
	report.denoise_seconds = report.pilot.machine.denoise_pixel * report.pilot.machine.pixels;
}

/// A povray that does not tell it, of an older patch, is asked nothing: POV-Ray's own.
double SceneConfidence(const PilotRun& run)
{
	return run.blocks[0].own ? run.blocks[0].own->confidence : DefaultConfidence;
}

/// --setting, with what the scene says where it named none.
Setting WithConfidence(Setting setting, double scene)
{
	if (setting.confidence == AsTheScene)
		setting.confidence = scene;
	return setting;
}

/// --rows: what the first setting that was named costs, else the scene's own.
void WriteRows(const Options& options, const PilotRun& run)
{
	const std::optional<tilt_lens::PilotSetting> own = run.blocks[0].own;
	if (options.own.empty() && !own)
		throw tiltcal::Refused("this povray does not tell what the scene says; name it with --setting MIN,MAX,VARIANCE");
	Setting setting = options.own.empty() ? Setting{own->min, own->max, own->variance, own->confidence, own->denoise} : WithConfidence(options.own[0], SceneConfidence(run));
	setting.denoise = own && own->denoise;   // no word of --setting
	tiltcal::WriteText(options.rows, RowsText(run, Pilot(run.blocks, run.pictures), setting));
}

void Run(const Options& options)
{
	CheckFiles(options);
	tiltcal::CatchInterrupts();
	if (!options.page.empty())
	{
		const tiltcal::TemporaryFolder folder("tiltcost");
		return tiltcal::WriteText(options.page, LensPage(options.job, folder));
	}
	Report report;
	report.scene = options.job.scene;
	report.stop_levels = options.stop_levels;
	FilmRun film;
	{
		const tiltcal::TemporaryFolder folder("tiltcost");
		if (options.job.frames > 0)
		{
			film = RunFilmPilots(options.job, folder);
			report.range = film.range;
			report.pilot = Joined(film);
		}
		else
			report.pilot = RunPilots(options.job, folder);
	}
	if (!options.rows.empty())
		return WriteRows(options, report.pilot);
	const Pilot pilot(report.pilot.blocks, report.pilot.pictures);
	const double confidence = SceneConfidence(report.pilot);
	report.pilot.blocks.clear();
	report.blocks = pilot.Blocks();
	report.samples = pilot.Samples();

	Progress progress;
	progress.Begin("settings");
	const tiltcal::Stopwatch time;
	const std::vector<Row> all = AllRows(pilot, report.pilot.machine, confidence, [&](double share)
	{
		tiltcal::CheckInterrupt();
		progress.Show(fmt::format("{:.0f} %{}", 100 * share, TimeLeft(share, time.Seconds())));
	});
	progress.End();
	report.best = BestRows(all);
	report.rows = TableRows(report.best, 10);
	for (const Setting& setting : options.own)
		report.own.push_back(MakeRow(pilot, report.pilot.machine, WithConfidence(setting, confidence)));
	// Slow, and not printed where --time, --error or --levels asks for one setting.
	const bool table = options.time <= 0 && options.error <= 0 && options.levels <= 0;
	if (table || !options.csv.empty())
		CompleteTable(pilot, report);
	if (!options.csv.empty())
		tiltcal::WriteText(options.csv, CsvText(report));
	if (!options.plot.empty())
		WritePlot(report, options.plot);
	std::optional<Row> answer;
	const std::string text = Answer(options, pilot, report.pilot.machine, all, report.best, answer);
	report.frames = FrameRows(film, answer ? answer->setting : report.rows[std::min(StopsPaying(report.rows, options.stop_levels), report.rows.size() - 1)].setting);
	fmt::print("{}", text.empty() ? HeaderText(report) + "\n" + TableText(report) : text);
	// The table has both already.
	if (!text.empty())
	{
		for (const Row& row : report.own)
			fmt::print("Named by --setting:\n{}", SureText(pilot, report.pilot.machine, row));
		fmt::print("{}", FewBlocksText(report));
	}
	fmt::print("{}", FramesText(report));
}

}

int main(int argc, char** argv)
{
	return tiltcal::RunProgram("tiltcost", [&]
	{
		CLI::App app("tiltcost: what accuracy costs in time for a scene with a tilt_lens camera, and which blur_samples and variance\n"
			"to write into it. Traces a sample of the picture's blocks in a few seconds and predicts the rest.", "tiltcost");
		try
		{
			Run(ParseCommandLine(app, argc, argv));
		}
		catch (const CLI::ParseError& e)
		{
			return app.exit(e) == 0 ? tiltcal::EXIT_DONE : tiltcal::EXIT_USAGE;
		}
		return tiltcal::EXIT_DONE;
	});
}
