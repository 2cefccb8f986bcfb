// SPDX-License-Identifier: AGPL-3.0-or-later
//
// closed_loop: cameras that nobody tuned for, light as cameras give it, and the calibrator's answers in their own sigmas.

#include "closed_loop.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

namespace
{

using namespace cameras;

struct Options
{
	std::vector<std::string> only, lights{ "snr200" };
	int seeds = 1, random = 0, first = 0;
	std::string work = "closed-loop", glass;
	double focal_length = 0, f_number = 0;
	bool short_lines = false;
};

void Print(const Camera& camera, const Light& light, const Answer& a)
{
	std::printf("%-32s %-12s ", camera.name.c_str(), light.name.c_str());
	if (!a.refusal.empty())
	{
		std::printf("refused: %s\n", a.refusal.c_str());
		return;
	}
	const auto& c = a.calibration;
	std::printf("%s, %s, tilt error %.4f, reprojection %.3f px, blur %.3f px, %d terms%s\n", tiltcal::NameOf(c.verdict.grade), tiltcal::NameOf(c.solution.model), a.tilt_error, c.geometry.rms, c.solution.rms_blur,
		c.geometry.distortion_terms, c.geometry.shared_poses ? ", shared" : "");
	for (const Deviation& d : a.deviations)
		std::printf("    %-20s %12.5f  %12.5f +- %9.5f  %+6.2f\n", d.name.c_str(), d.truth, d.found, d.sigma, d.InSigmas());
	for (const auto& remark : c.verdict.remarks)
		std::printf("    %s: %s\n", tiltcal::NameOf(remark.grade), remark.text.c_str());
}

struct Tally { int inside = 0, all = 0; double squares = 0, sum = 0; };

void Run(const Options& o, Camera camera, unsigned pose_seed, std::map<std::string, Tally>& tally)
{
	camera.glass = o.glass;
	if (o.focal_length > 0)
		camera.focal_length = o.focal_length;
	if (o.f_number > 0)
		camera.f_number = o.f_number;
	Negatives negatives;
	try
	{
		negatives = Photograph(camera, pose_seed);
	}
	catch (const std::exception& e)
	{
		std::printf("%s: %s\n", camera.name.c_str(), e.what());
		return;
	}
	for (const std::string& name : o.lights)
		for (int k = 0; k < o.seeds; ++k)
		{
			const Light light = LightOf(name);
			const Answer a = CloseTheLoop(negatives, light, unsigned(k + 1), o.work);
			Print(negatives.camera, light, a);
			std::fflush(stdout);
			for (const Deviation& d : a.deviations)
			{
				Tally& t = tally[d.name.substr(0, d.name.rfind(' ') == std::string::npos ? d.name.size() : d.name.rfind(' '))];
				t.inside += std::abs(d.InSigmas()) < 2;
				t.squares += std::min(100.0, d.InSigmas() * d.InSigmas());
				t.sum += d.InSigmas();
				++t.all;
			}
		}
}

}

int main(int argc, char** argv)
{
	Options o;
	CLI::App app{ "Simulated cameras, calibrated and held against the truth" };
	app.add_option("--only", o.only, "Cameras of the table whose names begin so");
	app.add_option("--light", o.lights, "Kinds of light");
	app.add_option("--seeds", o.seeds, "Draws of the noise");
	app.add_option("--random", o.random, "So many random cameras instead of the table");
	app.add_option("--first", o.first, "The first of them");
	app.add_option("--glass", o.glass, "FILE of a lens prescription: the photographs are traced through it");
	app.add_option("--focal-length", o.focal_length, "Of all cameras, mm, in place of their own");
	app.add_option("--f-number", o.f_number, "Of all cameras, in place of their own");
	app.add_option("--work", o.work, "Folder for the photographs");
	CLI11_PARSE(app, argc, argv);
	std::map<std::string, Tally> tally;
	if (o.random > 0)
		for (int k = 0; k < o.random; ++k)
			Run(o, RandomCamera(unsigned(o.first + k)), unsigned(o.first + k), tally);
	else
		for (const Camera& camera : AllCameras())
			if (o.only.empty() || std::any_of(o.only.begin(), o.only.end(), [&](const std::string& n) { return camera.name.rfind(n, 0) == 0; }))
				Run(o, camera, 1, tally);
	for (const auto& [name, t] : tally)
		std::printf("%-16s inside 2 sigma %4d of %4d, rms %.2f, mean %+.2f\n", name.c_str(), t.inside, t.all, std::sqrt(t.squares / t.all), t.sum / t.all);
	return 0;
}
