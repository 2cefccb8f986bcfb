// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcost's predictions against renders: camera rays and CPU time against the render's own, errors, raw and denoised, against a truth of
// other lens samples. Predictions are made once, before anything is rendered. Writes tiltcost.csv and tiltcost.html (a fragment for the
// report) and fails when a prediction is out of bounds.
//
// Without options at the size and with the blocks of COSTS.md: 240 of 1920 x 1080 pixels. --small is ctest's: there seconds are shown, not
// judged, for renders of tenths of a second say more of what else the machine does than of the prediction; rays are the same on every machine.

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

namespace fs = std::filesystem;

namespace
{

/// What is promised (COSTS.md), where the pilot's blocks are a fair sample of the picture.
const double TimeBound = 0.25, ErrorBound = 0.30;
/// Where they are not, tiltcost says so by its standard deviation, a jackknife over ten groups of blocks: Student's t with 9 degrees of
/// freedom is beyond this once in a thousand. Of twenty-two scenes and figures, whose two settings share a pilot, one day in fifty.
const double Student = 4.78;
/// A prediction that is wrong by a factor of two, up or down, is none, whatever it says of itself: no bound is wider, and a standard deviation whose bound would be is a failure itself.
/// Else whoever says to know less and less of his own predictions could never be wrong.
const double MostBound = 1.0, MostSigma = MostBound / Student;
const double Errors[] = {0.01, 0.004};

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

/// `off` is predicted / true - 1. A bound beyond the promise is a factor, the same one down as up: what is 100 % too much one way is half the other.
bool Within(double off, double limit, double promise) { return off <= limit && off >= std::min(-promise, 1 / (1 + limit) - 1); }

struct Result
{
	std::string scene;
	Row predicted;
	double share = 0;
	double error = 0, uncertain = 0, rays = 0, cpu = 0;   ///< as rendered; `uncertain`: one standard deviation of `error`, relative
	double denoised = 0, denoised_uncertain = 0;          ///< errors of the same with denoise, where they are predicted
	double denoised_cpu = 0;

	double ErrorOff() const { return predicted.error / error - 1; }
	double RaysOff() const { return predicted.rays / rays - 1; }
	double TimeOff() const { return predicted.cpu / cpu - 1; }
	double DenoisedOff() const { return denoised > 0 ? predicted.denoised_error / denoised - 1 : 0; }
	/// Of both together: what denoising takes is a few seconds of many.
	double DenoisedTimeOff() const { return denoised > 0 ? (predicted.cpu + predicted.denoise_cpu) / denoised_cpu - 1 : 0; }
	double ErrorLimit() const { return std::min(MostBound, std::max(ErrorBound, Student * std::hypot(predicted.error_sigma, uncertain))); }
	double DenoisedLimit() const { return std::min(MostBound, std::max(ErrorBound, Student * std::hypot(predicted.denoised_sigma, denoised_uncertain))); }
	double TimeLimit() const { return std::min(MostBound, std::max(TimeBound, Student * predicted.time_sigma)); }
	/// Of errors always; of times where they are judged, for elsewhere they are the machine's.
	bool SigmasPromise(bool judge_time) const
	{
		return predicted.error_sigma <= MostSigma && (denoised <= 0 || predicted.denoised_sigma <= MostSigma) && (!judge_time || predicted.time_sigma <= MostSigma);
	}
	/// Time is rays times what one takes: the bound of the product holds for the factor that is the machine's no affair.
	bool Good(bool judge_time) const
	{
		return SigmasPromise(judge_time) && Within(ErrorOff(), ErrorLimit(), ErrorBound) && Within(DenoisedOff(), DenoisedLimit(), ErrorBound) && Within(RaysOff(), TimeLimit(), TimeBound)
			&& (!judge_time || (Within(TimeOff(), TimeLimit(), TimeBound) && Within(DenoisedTimeOff(), TimeLimit(), TimeBound)));
	}
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

/// The table.
Predicted RunTiltcost(const Places& places, const Scene& scene, unsigned threads)
{
	const fs::path csv = places.out / "prediction.csv", log = places.out / "tiltcost.log";
	std::vector<std::string> command = {places.tiltcost, "--povray", places.povray, "--csv", csv.string(), "--pilot-time", places.effort.pilot_time,
		"--pilot-blocks", fmt::format("{}", places.effort.pilot_blocks)};
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

struct Judged
{
	double error = 0, uncertain = 0;
};

/// The picture's error: its square distance from the truth less the truth's own. How uncertain that is, is seen in blocks of 16 x 16 pixels.
Judged Judge(const Picture& picture, const Truth& truth, const std::string& scene)
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

std::vector<Result> CheckScene(const Places& places, const Scene& scene)
{
	const unsigned threads = places.effort.judge_time ? 1 : AllThreads();
	const Predicted predicted = RunTiltcost(places, scene, threads);
	const Truth truth = RenderTruth(places, scene);
	std::vector<Result> results;
	for (const double error : Errors)
	{
		const Row row = *std::min_element(predicted.rows.begin(), predicted.rows.end(),
			[&](const Row& a, const Row& b) { return std::abs(std::log(a.error / error)) < std::abs(std::log(b.error / error)); });
		Result result = {scene.name, row, predicted.share};
		const Rendered rendered = Render(places, scene, row, 0, threads);
		const Judged raw = Judge(rendered.picture, truth, scene.name);
		result.error = raw.error;
		result.uncertain = raw.uncertain;
		result.rays = rendered.rays;
		result.cpu = rendered.cpu;
		if (row.denoised_error > 0)
		{
			Row with = row;
			with.denoise = true;
			const Rendered made = Render(places, scene, with, 0, threads);
			const Judged denoised = Judge(made.picture, truth, scene.name);
			result.denoised_cpu = made.cpu;
			result.denoised = denoised.error;
			result.denoised_uncertain = denoised.uncertain;
		}
		results.push_back(result);
	}
	return results;
}

std::string DenoisedCells(const Result& r)
{
	if (r.denoised <= 0)
		return "<td>-</td><td></td><td></td><td></td>";
	return fmt::format("<td>{:.4f}</td><td>{:.4f}</td><td>{:+.0f} %</td><td>{:.0f} %</td>", r.predicted.denoised_error, r.denoised, 100 * r.DenoisedOff(), 100 * r.DenoisedLimit());
}

void Write(const Places& places, const std::vector<Result>& results)
{
	std::string csv = "scene,min,max,variance,predicted_error,predicted_error_sigma,error,error_sigma,predicted_rays,rays,predicted_cpu_s,predicted_cpu_sigma,cpu_s,pilot_share,predicted_denoised_error,predicted_denoised_error_sigma,denoised_error,denoised_error_sigma,predicted_denoised_cpu_s,denoised_cpu_s\n";
	std::string html = fmt::format("<h2>tiltcost: predicted and rendered</h2>\n<p>{} × {} pixels, predicted once before anything is rendered, from the part of the picture that stands beside it. Errors against "
		"truths with other lens samples, whose own error is taken off. Bounds: {:.0f} % in rays{}, {:.0f} % in error, or {:.2f} standard deviations (Student's t, once in 1000) where those are wider, never more than {:.0f} %, and no standard "
		"deviation that is told may be beyond {:.0f} %."
		"</p>\n<table><tr><th>scene</th><th>pilot</th><th>blur_samples, variance</th><th>error predicted</th><th>rendered</th><th>off by</th><th>bound</th>"
		"<th>denoised, predicted</th><th>rendered</th><th>off by</th><th>bound</th><th>rays predicted</th><th>rendered</th><th>off by</th><th>CPU s predicted</th><th>rendered</th><th>off by</th><th>denoised, off by</th><th>bound</th></tr>\n", places.effort.width, places.effort.height, 100 * TimeBound,
		places.effort.judge_time ? " and in time" : " (seconds are shown, not judged)", 100 * ErrorBound, Student, 100 * MostBound, 100 * MostSigma);
	for (const Result& r : results)
	{
		const Row& p = r.predicted;
		csv += fmt::format("{},{},{},{:g},{:.5g},{:.3g},{:.5g},{:.3g},{:.0f},{:.0f},{:.4g},{:.3g},{:.4g},{:.4g},{:.5g},{:.3g},{:.5g},{:.3g},{:.4g},{:.4g}\n", r.scene, p.min, p.max, p.variance, p.error, p.error_sigma, r.error, r.uncertain,
			p.rays, r.rays, p.cpu, p.time_sigma, r.cpu, r.share, r.denoised > 0 ? p.denoised_error : 0, p.denoised_sigma, r.denoised, r.denoised_uncertain, p.cpu + p.denoise_cpu, r.denoised_cpu);
		html += fmt::format("<tr{}><td>{}</td><td>{:.1f} %</td><td>{}, {}, {:g}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:+.0f} %</td><td>{:.0f} %</td>{}<td>{:.0f}</td><td>{:.0f}</td><td>{:+.0f} %</td>"
			"<td>{:.2f}</td><td>{:.2f}</td><td>{:+.0f} %</td><td>{:+.0f} %</td><td>{:.0f} %</td></tr>\n", r.Good(places.effort.judge_time) ? "" : " class=\"lost\"", r.scene, 100 * r.share, p.min, p.max, p.variance, p.error, r.error, 100 * r.ErrorOff(), 100 * r.ErrorLimit(),
			DenoisedCells(r), p.rays, r.rays, 100 * r.RaysOff(), p.cpu, r.cpu, 100 * r.TimeOff(), 100 * r.DenoisedTimeOff(), 100 * r.TimeLimit());
	}
	html += "</table>\n";
	std::ofstream(places.out / "tiltcost.csv") << csv;
	std::ofstream(places.out / "tiltcost.html") << html;
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
				const Row& p = r.predicted;
				fmt::print("{} {:<11} {:4.1f} %  {:>2}, {:>4}, {:<7g} error {:.5f} is {:.5f} ({:+3.0f} % of {:.0f} %; known to {:.1f} %)  denoised {:.5f} is {:.5f} ({:+3.0f} % of {:.0f} %)  rays {:.0f} is {:.0f} ({:+3.0f} %)  CPU {:6.2f} s is {:6.2f} s ({:+3.0f}, denoised {:+3.0f} % of {:.0f} %)\n",
					r.Good(places.effort.judge_time) ? ' ' : '!', r.scene, 100 * r.share, p.min, p.max, p.variance, p.error, r.error, 100 * r.ErrorOff(), 100 * r.ErrorLimit(), 100 * r.uncertain,
					r.denoised > 0 ? p.denoised_error : 0, r.denoised, 100 * r.DenoisedOff(), 100 * r.DenoisedLimit(), p.rays, r.rays, 100 * r.RaysOff(), p.cpu, r.cpu, 100 * r.TimeOff(), 100 * r.DenoisedTimeOff(), 100 * r.TimeLimit());
				std::fflush(stdout);
			}
		}
		Write(places, results);
		return std::all_of(results.begin(), results.end(), [&](const Result& r) { return r.Good(places.effort.judge_time); }) ? 0 : 1;
	}
	catch (const std::exception& e)
	{
		fmt::print(stderr, "tiltcost_predictions: {}\n", e.what());
		return 2;
	}
}
