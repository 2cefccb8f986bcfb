// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the calibrator's accuracy costs: error of the found tilt against CPU seconds, by
// number of photographs, edges per photograph and model, on photographs and on an ideal lens.
//
//   calibrator_cost --photos DIR --out DIR [--draws 6] [--quick]
//
// The truth of the photographs is the mechanical tilt, 5 and -5 degrees towards 0
// (scenes/boxes/photos/README.md). Their lens's field curvature biases every model but curved;
// scatter, over draws of photographs or edges, is what effort buys.
// Exit codes of tiltcal; 1 also when an exact model is biased on exact data.

#include <tiltcal/calibrate.h>
#include "calibrator_report.h"
#include "calibrate/next_photographs.h"
#include "model/names.h"
#include <tiltcal/error.h>
#include "base/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>

#include <array>
#include <map>

namespace
{

using namespace calibrator_cost;

const double TRUE_TILT[] = { 0, 5, -5 };
const std::array<const char*, 4> MODELS{ "paper", "rigid", "plane", "curved" };

/// One effort on one source, all models on the same draws.
std::vector<Row> Measure(Source& source, const std::string& data, const std::string& vary, const Effort& effort, int wanted)
{
	const int draws = source.Draws(effort, wanted);
	std::vector<Row> rows;
	std::map<std::string, std::vector<std::vector<TiltError>>> errors;
	for (const char* const model : MODELS)
	{
		Row row;
		row.data = data;
		row.vary = vary;
		row.model = model;
		row.effort = effort;
		row.draws = draws;
		rows.push_back(row);
	}
	for (int k = 0; k < draws; ++k)
	{
		Preparation preparation;
		const tiltcal::Task task = source.Draw(effort, k, draws, preparation);
		for (Row& row : rows)
		{
			const double start = CpuSeconds();
			try
			{
				const tiltcal::Calibration c = tiltcal::Calibrate(task, { tiltcal::ModelNamed(row.model), tiltcal::Poses::AUTO, tiltcal::Refinement::NONE });
				std::vector<TiltError> found;
				for (size_t s = 1; s < c.solution.states.size(); ++s)
					found.push_back(ErrorOf(c.solution.states[s].lens_tilt.value, c.solution.states[s].tilt_direction.value, TRUE_TILT[s]));
				errors[row.model].push_back(found);
			}
			catch (const tiltcal::Error& e)
			{
				if (e.Code() != tiltcal::EXIT_REFUSED)
					throw;
				fmt::print(stderr, "  {} refused: {}\n", row.model, e.what());
			}
			row.solving += (CpuSeconds() - start) / draws;
			row.preparation.detection += preparation.detection / draws;
			row.preparation.measuring += preparation.measuring / draws;
		}
	}
	for (Row& row : rows)
	{
		Summarise(errors[row.model], source.ShareUsed(effort), source.DrawsExisting(effort), row);
		fmt::print(stderr, "  {:<6} {} of {} draws: error {:.4f}, bias {:.4f}, scatter {:.4f} degrees; solved in {:.2f} s\n", row.model, row.answers, row.draws,
			row.rms, row.bias, row.scatter, row.solving);
	}
	return rows;
}

void Append(std::vector<Row>& rows, std::vector<Row> more) { rows.insert(rows.end(), more.begin(), more.end()); }

/// One photograph more or fewer, then one edge more or fewer; `quick`: all photographs, of exact data all but one too, and one number of edges.
std::vector<Row> MeasureAll(Source& source, const std::string& data, int draws, bool quick)
{
	std::vector<Row> rows;
	const int most = source.Photos();
	// Only exact data can be judged: of photographs, ctest makes sure that the page has all its rows.
	const int least = !quick ? 1 : source.ShareUsed({ most, 0 }) > 0 ? most : most - 1;
	for (int photos = least; photos <= most; ++photos)
	{
		fmt::print(stderr, "{}: {} photographs per state, all edges\n", data, photos);
		Append(rows, Measure(source, data, "photos", { photos, 0 }, draws));
	}
	// Of all photographs there is but one choice; leaving out one at a time shows its scatter (jackknife).
	const size_t n = rows.size();
	for (size_t k = n - MODELS.size(); k < n && least < most; ++k)
		if (rows[k].scatter < 0 && rows[k - MODELS.size()].scatter >= 0)
			rows[k].scatter = rows[k - MODELS.size()].scatter * std::sqrt((most - 1.0) / most);
	for (const int edges : quick ? std::vector<int>{ 40 } : std::vector<int>{ 12, 20, 40, 80 })
	{
		fmt::print(stderr, "{}: {} photographs per state, {} edges each\n", data, most, edges);
		Append(rows, Measure(source, data, "edges", { most, edges }, draws));
	}
	for (size_t k = n - MODELS.size(); k < n; ++k)
	{
		Row all = rows[k];
		all.vary = "edges";
		// Of all edges of given photographs there is but one choice.
		if (source.ShareUsed({ most, 0 }) > 0)
			all.scatter = -1;
		rows.push_back(all);
	}
	return rows;
}

/// The exact models must be right where their assumptions hold: within the noise of
/// the mean and the 0.01 degrees of what is of second order in the aperture. They must answer, but for `rigid` of fewer photographs
/// than tiltcal asks for: it takes aperture and focus from the untilted ones alone, and may refuse.
bool ExactModelsAreUnbiased(const std::vector<Row>& rows)
{
	bool good = true;
	for (const Row& row : rows)
	{
		if (row.model == "paper")
			continue;
		const bool may_refuse = row.model == "rigid" && row.effort.photos < int(tiltcal::LEAST_PHOTOGRAPHS);
		if (row.answers < std::min(row.draws, 2) && !may_refuse)
		{
			fmt::print(stderr, "calibrator_cost: model {} answers {} of {} times on exact data ({} photographs, {} edges)\n", row.model, row.answers, row.draws,
				row.effort.photos, row.effort.edges);
			good = false;
		}
		else if (row.answers > 1 && row.bias > 0.01 + 4 * row.scatter / std::sqrt(double(row.answers)))
		{
			fmt::print(stderr, "calibrator_cost: model {} is biased by {:.4f} degrees on exact data ({} photographs, {} edges)\n", row.model, row.bias,
				row.effort.photos, row.effort.edges);
			good = false;
		}
	}
	return good;
}

}

int main(int argc, char** argv)
{
	CLI::App app("Error of tiltcal's tilt against CPU seconds.");
	std::string photos, out;
	int draws = 6;
	bool quick = false;
	app.add_option("--photos", photos, "Folder of untilted-*.png (or .jpg), plus5-*, minus5-*")->required();
	app.add_option("--out", out, "Folder for calibrator-cost.csv, .html and .svg")->required();
	app.add_option("--draws", draws, "Choices of photographs per point; of edges at most 3, of noise at most 4")->capture_default_str()->check(CLI::Range(1, 100));
	app.add_flag("--quick", quick, "All photographs, of the thin lens all but one, and 40 edges: what ctest runs");
	try
	{
		app.parse(argc, argv);
		spdlog::set_level(spdlog::level::off);
		cv::setNumThreads(1);
		tiltcal::PrepareFolder(out);
		fmt::print(stderr, "detecting the boards in {}\n", photos);
		std::vector<Row> rows = MeasureAll(*Photographs(photos), "photographs", draws, quick);
		const std::vector<Row> exact = MeasureAll(*ThinLens(), "thin lens", draws, quick);
		Append(rows, exact);
		const auto is_empty = [](const Row& row) { return row.answers == 0; };
		if (rows.size() == exact.size() || std::all_of(rows.begin(), rows.end(), is_empty))
			throw tiltcal::Refused("no photograph gave an answer");
		WriteReport(rows, out);
		fmt::print(stderr, "{} CPU seconds in all; written to {}\n", int(CpuSeconds()), out);
		return ExactModelsAreUnbiased(exact) ? 0 : tiltcal::EXIT_REFUSED;
	}
	catch (const CLI::ParseError& e)
	{
		return app.exit(e) == 0 ? 0 : tiltcal::EXIT_USAGE;
	}
	catch (const tiltcal::Error& e)
	{
		fmt::print(stderr, "calibrator_cost: error: {}\n", e.what());
		return e.Code();
	}
}
