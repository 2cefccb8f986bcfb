// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The program behind paper.cmake: photographs of renders, the ablation, the page.

#include "paper_measure.h"
#include "paper_page.h"
#include "paper_photograph.h"

#include <tiltcal/error.h>
#include "picture/image_io.h"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace
{

void AddPhotograph(CLI::App& app)
{
	struct Options
	{
		std::vector<std::string> renders;
		std::string like, camera, out;
		double gain = 1;
		unsigned seed = 0;
	};
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("photograph", "What sensor and file format would have made of a render.");
	c->add_option("RENDER", o->renders, "Linear OpenEXR; of several, seeds of one picture, the mean is taken")->required();
	c->add_option("--like", o->like, "A photograph whose format, compression and colours (or none) the result shall have")->required();
	c->add_option("--camera", o->camera, "camera.json with full_well_electrons and read_noise_electrons")->required();
	c->add_option("--gain", o->gain, "Exposure: light of 1 in the photograph over 1 in the render")->required()->check(CLI::PositiveNumber);
	c->add_option("--seed", o->seed, "Of the noise")->capture_default_str();
	c->add_option("--out", o->out, "FILE")->required();
	c->callback([o]
	{
		cv::Mat light;
		for (const std::string& render : o->renders)
		{
			const cv::Mat one = tiltcal::ReadLinear(render, tiltcal::Transfer{}) / double(o->renders.size());
			light = light.empty() ? one : cv::Mat(light + one);
		}
		if (paper::IsGrey(o->like))
			light = tiltcal::Luminance(light);
		paper::WriteLike(o->out, paper::Expose(light, o->gain, paper::ReadSensor(o->camera), o->seed), o->like);
	});
}

void AddMeasure(CLI::App& app)
{
	auto run = std::make_shared<paper::Run>();
	CLI::App* c = app.add_subcommand("measure", "results.json and the difference pictures, of what paper.cmake has left in a folder.");
	c->add_option("--out", run->out, "The folder")->required();
	c->add_option("--photos", run->photos, "Folder with target/ and scene/")->required();
	c->add_option("--camera", run->camera, "camera.json")->required();
	c->add_option("--suffix", run->suffix, "Of the photographs made of renders")->capture_default_str();
	c->add_option("--samples", run->samples, "Of the renders of the boxes")->required();
	c->add_option("--board-samples", run->board_samples, "Of the closed loop's boards")->required();
	c->add_option("--effect-samples", run->effect_samples, "Of the renders with fewer effects")->required();
	c->add_option("--curve", run->curve, "Samples of the curve, separated by commas")->required()->delimiter(',');
	c->callback([run] { paper::Measure(*run); });
}

void AddPage(CLI::App& app)
{
	auto out = std::make_shared<std::string>();
	CLI::App* c = app.add_subcommand("page", "report.html of results.json and the pictures beside it.");
	c->add_option("--out", *out, "The folder")->required();
	c->callback([out] { paper::WritePage(*out); });
}

}

int main(int argc, char** argv)
{
	spdlog::set_default_logger(spdlog::stderr_color_mt("paper_report"));
	CLI::App app{ "The paper's experiment, its parts and its page; paper.cmake runs it." };
	app.require_subcommand(1);
	try
	{
		AddPhotograph(app);
		AddMeasure(app);
		AddPage(app);
		app.parse(argc, argv);
		return 0;
	}
	catch (const CLI::ParseError& e)
	{
		return app.exit(e) == 0 ? 0 : tiltcal::EXIT_USAGE;
	}
	catch (const tiltcal::Error& e)
	{
		std::fprintf(stderr, "paper_report: %s\n", e.what());
		return e.Code();
	}
	catch (const std::exception& e)
	{
		std::fprintf(stderr, "paper_report: %s\n", e.what());
		return 1;
	}
}
