// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcost's predictions against renders: camera rays and CPU time against the render's own, errors, raw and denoised, against a truth of
// other lens samples. Errors and rays are predicted once, seconds in turn with the renders. Writes tiltcost.csv
// and tiltcost.html (a fragment for the report) and fails when a prediction is out of bounds.
//
// Without options at the size and with the blocks of COSTS.md: 240 of 1920 x 1080 pixels. --small is ctest's: there seconds are shown, not
// judged, for renders of tenths of a second say more of what else the machine does than of the prediction; rays are the same on every machine.

#include "prediction_result.h"

#include "base/files.h"
#include "program/process.h"
#include "support/picture.h"
#include "support/tiltcost_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

namespace fs = std::filesystem;

namespace
{

const double Errors[] = {0.01, 0.004};
/// A machine's speed may drift by a third within minutes. So prediction and renders follow each other, short renders in several such turns. How many is known
/// beforehand, and all count.
const double LongRender = 30; // CPU s
const int MostTurns = 3;

struct Effort
{
	int width, height;
	int truth_samples;                     ///< of each of the truth's two halves
	bool judge_time;                       ///< seconds too, for which nothing else may run
	int pilot_blocks;
	std::string pilot_time;
};

/// tiltcost's own 240 blocks of 8,160; by the clock long enough for all of them.
const Effort Full = {1920, 1080, 64, true, 240, "60s"};
/// Three of the 80 blocks for each of the jackknife's ten groups, however busy the machine.
const Effort Small = {160, 120, 128, false, 30, "10min"};

struct Row : TiltcostRow
{
	bool denoise = false;                  ///< whether it is rendered so
};

struct Scene
{
	std::string name;
	bool tilted = false, ours = false;     ///< `ours`: a scene of the repository, not of the race
	/// Samples that pixels of the truth may take where the first leave them uncertain by 0.01. A picture file clips what is brighter than white:
	/// means of too few samples about white come out too dark, however many such pictures are averaged.
	int lamps = 0;
};

const Scene Scenes[] = {{"area_lights"}, {"bokeh", false, false, 4096}, {"floor", true}, {"focus"}, {"foliage"}, {"foreground"}, {"glass"}, {"plain"}, {"shelf", true}, {"texture"},
	{"first-tilt", true, true}};

/// What tiltcost says.
struct Predicted
{
	std::vector<Row> rows;
	double share = 0;                      ///< of the picture's pixels
};

struct Places
{
	std::string tiltcost, povray;
	fs::path races, scenes, out;
	Effort effort = Full;
};

double RunChecked(const std::vector<std::string>& command, const fs::path& log)
{
	const tiltcal::ProcessResult result = tiltcal::RunProcess({command, "", {"LC_ALL=C"}, "", log.string()});
	if (result.exit_code != 0)
		throw std::runtime_error(fmt::format("{} failed:\n{}", command[0], tiltcal::ReadText(log.string(), "a log")));
	return result.cpu;
}

void Replace(std::string& text, const std::string& what, const std::string& by)
{
	const size_t at = text.find(what);
	if (at == std::string::npos)
		throw std::runtime_error("the scene has no '" + what + "' to replace");
	text.replace(at, what.size(), by);
}

/// Scene file and options that render `scene` with these settings.
std::vector<std::string> SceneWords(const Places& places, const Scene& scene, const Row& row, int seed, unsigned threads)
{
	const std::string width = fmt::format("+W{}", places.effort.width), height = fmt::format("+H{}", places.effort.height), work = fmt::format("+WT{}", threads);
	if (!scene.ours)
	{
		const auto declare = [](const char* name, double value) { return fmt::format("Declare=Race_{}={:.9g}", name, value); };
		return {(places.races / (scene.name + ".pov")).string(), "+L" + places.races.string(), width, height, work, declare("Camera", 1),
			declare("Tilted", scene.tilted), declare("Min", row.min), declare("Max", row.max), declare("Variance", row.variance),
			declare("Confidence", row.confidence), declare("Seed", seed),
			declare("Denoise", row.denoise)};
	}
	const fs::path folder = places.scenes / scene.name, file = places.out / (scene.name + ".pov");
	std::string text = tiltcal::ReadText((folder / (scene.name + ".pov")).string(), "a scene");
	Replace(text, "tilt_lens {", fmt::format("tilt_lens {{ seed {} {}", seed, row.denoise ? "denoise" : ""));
	Replace(text, "blur_samples 16, 256", row.min > 0 ? fmt::format("blur_samples {}, {}", row.min, row.max) : fmt::format("blur_samples {}", row.max));
	Replace(text, "variance 0.00002", fmt::format("variance {:.9g}", row.variance));
	std::ofstream(file) << text;
	return {file.string(), "+L" + folder.string(), width, height, work};
}

/// The number behind `label` in what a program printed.
double Said(const std::string& text, const std::string& label)
{
	const size_t at = text.find(label);
	if (at == std::string::npos)
		throw std::runtime_error("there is no '" + label + "' in:\n" + text);
	return std::atof(text.c_str() + at + label.size());
}

/// A render, its camera rays and its CPU seconds.
struct Rendered
{
	Picture picture;
	double rays = 0, cpu = 0;
};

Rendered Render(const Places& places, const Scene& scene, const Row& row, int seed, unsigned threads)
{
	const fs::path picture = places.out / "picture.ppm";
	fs::remove(picture);
	std::vector<std::string> command = {places.povray};
	for (const std::string& word : SceneWords(places, scene, row, seed, threads))
		command.push_back(word);
	for (const std::string& word : {std::string("-D"), std::string("+FP16"), std::string("File_Gamma=1"), "+O" + picture.string()})
		command.push_back(word);
	Rendered result;
	result.cpu = RunChecked(command, places.out / "povray.log");
	result.rays = Said(tiltcal::ReadText((places.out / "povray.log").string(), "a log"), "Camera Rays: ");
	result.picture = ReadPpm(picture.string());
	if (result.picture.width != places.effort.width || result.picture.height != places.effort.height)
		throw std::runtime_error("POV-Ray rendered another size");
	fs::remove(picture);
	return result;
}

/// The table, which has rows of the `settings` too.
Predicted RunTiltcost(const Places& places, const Scene& scene, unsigned threads, const std::vector<Row>& settings)
{
	const fs::path csv = places.out / "prediction.csv", log = places.out / "tiltcost.log";
	std::vector<std::string> command = {places.tiltcost, "--povray", places.povray, "--csv", csv.string(), "--pilot-time", places.effort.pilot_time,
		"--pilot-blocks", fmt::format("{}", places.effort.pilot_blocks)};
	for (const Row& setting : settings)
		command.insert(command.end(), {"--setting", fmt::format("{},{},{:.9g},{:.9g}", setting.min, setting.max, setting.variance, setting.confidence)});
	Row own;
	own.max = 128;
	own.variance = 0.0001;
	for (const std::string& word : SceneWords(places, scene, own, 0, threads))
		command.push_back(word);
	RunChecked(command, log);

	Predicted predicted;
	const std::string text = tiltcal::ReadText(log.string(), "a log");
	predicted.share = std::min(1.0, Said(text, "Pilot: ") * 16 * 16 / (double(places.effort.width) * places.effort.height)); // blocks at the rim are cut
	for (const TiltcostRow& row : ReadTiltcostTable(csv))
		predicted.rows.push_back({row, false});
	return predicted;
}

/// The row whose error is nearest.
const Row& RowOfError(const std::vector<Row>& rows, double error)
{
	return *std::min_element(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return std::abs(std::log(a.error / error)) < std::abs(std::log(b.error / error)); });
}

const Row& RowOfSetting(const std::vector<Row>& rows, const Row& setting)
{
	for (const Row& row : rows)
		if (row.min == setting.min && row.max == setting.max && std::abs(row.variance / setting.variance - 1) < 1e-6)
			return row;
	throw std::runtime_error(fmt::format("tiltcost's table has no row of the setting asked for, {},{},{:g}", setting.min, setting.max, setting.variance));
}

unsigned AllThreads()
{
	return std::max(1u, std::thread::hardware_concurrency());
}

/// The mean of two pictures with other lens samples than the renders'. Their difference says what error it has of its own, whatever the
/// renderer thinks of itself.
struct Truth
{
	Picture mean, half_difference;
};

Truth RenderTruth(const Places& places, const Scene& scene)
{
	const unsigned threads = AllThreads();
	Row row;
	row.max = places.effort.truth_samples;
	if (scene.lamps > row.max)
	{
		row.min = row.max;
		row.max = scene.lamps;
		row.variance = 1e-4;
	}
	Truth truth = {Render(places, scene, row, 1, threads).picture, Render(places, scene, row, 2, threads).picture};
	for (size_t i = 0; i < truth.mean.rgb.size(); ++i)
	{
		const double first = truth.mean.rgb[i], second = truth.half_difference.rgb[i];
		truth.mean.rgb[i] = (first + second) / 2;
		truth.half_difference.rgb[i] = (first - second) / 2;
	}
	return truth;
}

/// The picture's error and how uncertain it is, one standard deviation of it, relative: its square distance from the truth less the truth's own. The latter is seen in blocks of 16 x 16 pixels.
std::pair<double, double> Judge(const Picture& picture, const Truth& truth, const std::string& scene)
{
	const int size = 16, across = (picture.width + size - 1) / size, down = (picture.height + size - 1) / size;
	std::vector<double> sums(size_t(across) * size_t(down), 0.0);
	for (size_t i = 0; i < picture.rgb.size(); ++i)
	{
		const size_t pixel = i / 3, x = pixel % size_t(picture.width), y = pixel / size_t(picture.width);
		const double far = picture.rgb[i] - truth.mean.rgb[i], own = truth.half_difference.rgb[i];
		sums[y / size * size_t(across) + x / size] += far * far - own * own;
	}
	double sum = 0, squares = 0;
	for (const double of_block : sums)
		sum += of_block;
	for (const double of_block : sums)
		squares += std::pow(of_block - sum / double(sums.size()), 2);
	if (sum <= 0)
		throw std::runtime_error(scene + ": the truth is too coarse to judge the render");
	return {std::sqrt(sum / double(picture.rgb.size())), std::sqrt(squares) / sum / 2};
}

int TurnsOf(const Row& row) { return std::clamp(int(std::ceil(LongRender / row.cpu)), 1, MostTurns); }

/// Pixels, and so errors and rays, are the same in each turn; seconds are added up.
void RenderTurn(const Places& places, const Scene& scene, const Truth& truth, unsigned threads, Result& result)
{
	const bool first = result.cpu == 0;
	const Rendered raw = Render(places, scene, {result.predicted, false}, 0, threads);
	result.cpu += raw.cpu;
	result.rays = raw.rays;
	if (first)
		std::tie(result.error, result.uncertain) = Judge(raw.picture, truth, scene.name);
	if (result.predicted.denoised_error <= 0)
		return;
	const Rendered denoised = Render(places, scene, {result.predicted, true}, 0, threads);
	result.denoised_cpu += denoised.cpu;
	if (first)
		std::tie(result.denoised, result.denoised_uncertain) = Judge(denoised.picture, truth, scene.name);
}

/// Seconds of the results are means of their turns.
std::vector<Result> CheckScene(const Places& places, const Scene& scene)
{
	const unsigned threads = places.effort.judge_time ? 1 : AllThreads();
	const Truth truth = RenderTruth(places, scene);
	const Predicted predicted = RunTiltcost(places, scene, threads, {});
	std::vector<Result> results;
	std::vector<Row> settings;
	std::vector<int> turns;
	for (const double error : Errors)
	{
		settings.push_back(RowOfError(predicted.rows, error));
		results.push_back({scene.name, settings.back(), predicted.share});
		turns.push_back(places.effort.judge_time ? TurnsOf(settings.back()) : 1);
		results.back().predicted.cpu = results.back().predicted.denoise_cpu = 0; // the turns add them up
	}
	for (int turn = 0; turn < *std::max_element(turns.begin(), turns.end()); ++turn)
	{
		const Predicted now = turn == 0 ? predicted : RunTiltcost(places, scene, threads, settings);
		for (size_t i = 0; i < results.size(); ++i)
		{
			if (turn >= turns[i])
				continue;
			const Row& said = RowOfSetting(now.rows, settings[i]);
			results[i].predicted.cpu += said.cpu;
			results[i].predicted.denoise_cpu += said.denoise_cpu;
			RenderTurn(places, scene, truth, threads, results[i]);
		}
	}
	for (size_t i = 0; i < results.size(); ++i)
		for (double* seconds : {&results[i].predicted.cpu, &results[i].predicted.denoise_cpu, &results[i].cpu, &results[i].denoised_cpu})
			*seconds /= turns[i];
	return results;
}

}

int main(int argc, char** argv)
{
	CLI::App app("Checks tiltcost's predictions against renders");
	Places places;
	std::vector<std::string> only;
	bool small = false;
	std::string pilot_time;
	app.add_option("--tiltcost", places.tiltcost)->required();
	app.add_option("--povray", places.povray)->required();
	app.add_option("--race-scenes", places.races, "tests/accuracy/scenes")->required();
	app.add_option("--scenes", places.scenes, "scenes")->required();
	app.add_option("--out", places.out)->required();
	app.add_option("--only", only, "these scenes alone");
	app.add_flag("--small", small, "160 x 120 pixels, 30 of 80 blocks in the pilot, seconds not judged");
	app.add_option("--pilot-time", pilot_time, "tiltcost's option, for a machine that is busy");
	CLI11_PARSE(app, argc, argv);
	try
	{
		if (small)
			places.effort = Small;
		if (!pilot_time.empty())
			places.effort.pilot_time = pilot_time;
		fs::create_directories(places.out);
		std::vector<Result> results;
		for (const std::string& name : only)
			if (std::none_of(std::begin(Scenes), std::end(Scenes), [&](const Scene& scene) { return scene.name == name; }))
				throw std::runtime_error("--only " + name + ": no such scene");
		for (const Scene& scene : Scenes)
		{
			if (!only.empty() && std::find(only.begin(), only.end(), scene.name) == only.end())
				continue;
			for (const Result& r : CheckScene(places, scene))
			{
				results.push_back(r);
				fmt::print("{}\n", Line(r, places.effort.judge_time));
				std::fflush(stdout);
			}
		}
		WritePredictions(places.out, results, {places.effort.width, places.effort.height, places.effort.judge_time});
		return std::all_of(results.begin(), results.end(), [&](const Result& r) { return r.Good(places.effort.judge_time); }) ? 0 : 1;
	}
	catch (const std::exception& e)
	{
		fmt::print(stderr, "tiltcost_predictions: {}\n", e.what());
		return 2;
	}
}
