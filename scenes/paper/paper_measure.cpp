// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_measure.h"

#include "paper_ablation.h"
#include "paper_brightness.h"
#include "paper_photograph.h"
#include "paper_pictures.h"
#include "paper_tables.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "picture/image_io.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <future>
#include <regex>
#include <sstream>

namespace paper
{

namespace
{

/// The log of a render, its progress lines and all.
std::string Log(const std::string& file) { return tiltcal::ReadText(file, "a log of POV-Ray"); }

double NumberIn(const std::string& log, const std::regex& pattern, const std::string& file)
{
	std::smatch found;
	if (!std::regex_search(log, found, pattern))
		throw tiltcal::FileError(file + ": POV-Ray's log does not say what is looked for in it");
	return std::stod(found[1]);
}

double CpuSeconds(const std::string& file)
{
	static const std::regex pattern("Trace Time:[^\\n]*\\n *using [0-9]+ thread.{0,3} with ([0-9.]+) CPU-seconds total");
	return NumberIn(Log(file), pattern, file);
}

Json Curve(const Run& run)
{
	Json curve = Json::array();
	for (const int samples : run.curve)
	{
		const std::string name = fmt::format("{}/curve/{}-", run.out, samples);
		const cv::Mat a = Brightness(ReadLuminance(name + "0.exr")), b = Brightness(ReadLuminance(name + "1.exr"));
		const Error error = DifferenceInRows(a, b, CURVE_ROWS[0], CURVE_ROWS[1]);
		curve.push_back({ { "samples", samples }, { "mean_abs", error.mean_abs / std::sqrt(2.0) }, { "rms", error.rms / std::sqrt(2.0) },
			{ "cpu_seconds", (CpuSeconds(name + "0.exr.txt") + CpuSeconds(name + "1.exr.txt")) / 2 } });
	}
	return curve;
}

Json OneState(const Run& run, const std::string& state)
{
	StatePictures pictures;
	pictures.photograph = ReadLuminance(run.photos + "/scene/" + state + ".jpg");
	pictures.render = ReadLuminance(run.out + "/demo/render-" + state + ".exr");
	pictures.render_seed1 = ReadLuminance(run.out + "/seed1/" + state + ".exr");
	pictures.render_as_photo = ReadLuminance(run.out + "/noise/" + state + "." + run.suffix);
	pictures.closed = ReadLuminance(run.out + "/closed/" + state + ".exr");
	MatchedPictures matched;
	const Json json = Ablation(pictures, matched);
	tiltcal::WritePng(run.out + "/difference-" + state + ".png", DifferencePicture(matched.photograph, matched.render));
	tiltcal::WritePng(run.out + "/noise-" + state + ".png", DifferencePicture(matched.render_as_photo, matched.mean));
	return json;
}

/// The states one beside the other: nothing is shared but the result.
Json States(const Run& run)
{
	std::vector<std::future<Json>> running;
	for (const char* const state : STATES)
		running.push_back(std::async(std::launch::async, [&run, state] { return OneState(run, state); }));
	Json states;
	for (size_t s = 0; s < running.size(); ++s)
		states[STATES[s]] = running[s].get();
	return states;
}

/// Lines "SECONDS TEXT".
Json Steps(const Run& run)
{
	Json steps = Json::array();
	std::istringstream in(tiltcal::ReadText(run.out + "/steps.txt", "steps.txt"));
	double seconds = 0;
	std::string text;
	while (in >> seconds && std::getline(in >> std::ws, text))
		steps.push_back({ { "seconds", seconds }, { "text", text } });
	return steps;
}

std::string Processor()
{
	std::ifstream in("/proc/cpuinfo");
	for (std::string line; std::getline(in, line);)
		if (line.rfind("model name", 0) == 0)
			return line.substr(line.find(':') + 2);
	return "";
}

Json Conditions(const Run& run)
{
	const std::string file = run.out + "/seed1/untilted.exr.txt", log = Log(file);
	std::smatch version;
	std::regex_search(log, version, std::regex("Ray Tracer Version ([^ ]+)"));
	const std::string photos = std::filesystem::weakly_canonical(run.photos).string();
	const Sensor sensor = ReadSensor(run.camera);
	return { { "photos", photos }, { "full_well_electrons", sensor.full_well_electrons },
		{ "read_noise_electrons", sensor.read_noise_electrons }, { "format", run.suffix }, { "samples", run.samples }, { "board_samples", run.board_samples },
		{ "effect_samples", run.effect_samples }, { "tiltcal", TILTCAL_VERSION }, { "povray", version[1].str() },
		{ "threads", NumberIn(log, std::regex("Trace Time:[^\\n]*\\n *using ([0-9]+) thread"), file) }, { "processor", Processor() },
		{ "date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))) } };
}

}

void Measure(const Run& run)
{
	Json results;
	results["conditions"] = Conditions(run);
	size_t boards = 0;
	const Json calibration = ReadJson(run.out + "/demo/calibration/calibration.json");
	for (const Json& state : calibration.at("states"))
		boards += state.at("photos").size();
	results["conditions"]["board_photographs"] = boards;
	results["tilt"] = TiltTable(run);
	results["lens"] = LensTable(run);
	results["brightness"] = BrightnessTable(run);
	results["effects"] = EffectTable(run);
	results["pupils"] = PupilTable(run);
	results["closed_loop"] = ClosedLoopTable(run);
	results["curve"] = Curve(run);
	results["states"] = States(run);
	results["steps"] = Steps(run);
	tiltcal::WriteText(run.out + "/results.json", results.dump(1, '\t') + "\n");
}

}
