// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether denoise makes any block of a picture worse: pictures of several seeds, raw and denoised, against one of many samples.
//
//   no_harm scene SCENE --povray POVRAY --work DIR [--option OPTION]...     one scene
//   no_harm together SCENE... --povray POVRAY --work DIR                   what these, which ran into DIR/SCENE, say in all
//
// SCENE: a .pov file that includes race_camera.inc, or one with a tilt_lens of its own, whose words `denoise`, `seed`, blur_samples and
// variance are replaced. Fails when more blocks are worse, significantly in the mean of all seeds, than chance allows (block_harm.h): by more than
// a tenth, or at all.

#include "base/files.h"
#include "no_harm/block_harm.h"
#include "support/run_povray.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

// A block's squared error, of 192 values, varies by some 20 % from seed to seed: twelve pairs tell one that is by a third more, 15 % in RMS error.
const int Seeds = 12, Width = 128, Height = 80;
// Its own error is a sixth to a fifteenth of what is judged, and of no matter where both pictures have it: only what denoise
// has changed in the mean is held against it.
const int TruthSamples = 512;

struct Setting
{
	int min, max;
	double variance;

	std::string Text() const { return min > 0 ? fmt::format("{}, {} variance {:g}", min, max, variance) : fmt::format("{}", max); }
};

// Few samples, whose kernels are averaged; more, for which one is chosen (lens/denoise.h); both in a picture; and pixels of one sample, which have no halves, beside others.
const Setting Settings[] = {{0, 4, 0}, {0, 8, 0}, {0, 32, 0}, {4, 64, 0.001}, {1, 16, 0.01}};

/// The scene as one that takes Race_Seed, Race_Denoise, Race_Min, Race_Max and Race_Variance from the command line.
std::string Prepared(const std::string& text)
{
	if (text.find("race_camera.inc") != std::string::npos)
		return text;
	std::string scene = std::regex_replace(text, std::regex("\\bdenoise\\b|\\bseed\\s+\\w+"), "");
	scene = std::regex_replace(scene, std::regex("\\b(variance|confidence)\\s+[0-9.e-]+"), "");
	const std::regex lens("\\btilt_lens\\s*\\{"), samples("\\bblur_samples[^\\n]*");
	if (!std::regex_search(scene, lens) || !std::regex_search(scene, samples))
		throw std::runtime_error("the scene has no tilt_lens { or no blur_samples to replace");
	scene = std::regex_replace(scene, lens, "tilt_lens { seed Race_Seed #if (Race_Denoise) denoise #end ");
	return std::regex_replace(scene, samples, "#if (Race_Min > 0) blur_samples Race_Min, Race_Max #else blur_samples Race_Max #end variance Race_Variance");
}

class Renders
{
public:
	Renders(const std::string& povray_, const fs::path& scene_file, const fs::path& work_, const std::vector<std::string>& options_) :
		povray(povray_), work(work_), options(options_)
	{
		fs::create_directories(work);
		std::ofstream(work / "scene.pov") << Prepared(tiltcal::ReadText(scene_file.string(), "a scene"));
		options.push_back("+L" + scene_file.parent_path().string());
	}

	Picture Render(const Setting& setting, int seed, bool denoise) const
	{
		std::vector<std::string> words = options;
		for (const std::string& word : {fmt::format("Min={}", setting.min), fmt::format("Max={}", setting.max), fmt::format("Variance={:g}", setting.variance),
				fmt::format("Seed={}", seed), fmt::format("Denoise={}", denoise ? 1 : 0), std::string("Camera=1")})
			words.push_back("Declare=Race_" + word);
		RunPovray(povray, work, "scene.pov", "picture.exr", Width, Height, words);
		Picture picture = ReadExr((work / "picture.exr").string());
		if (!AllFinite(picture))
			throw std::runtime_error("a picture is not finite");
		// Over white, so that what is transparent counts, too.
		for (size_t i = 0; i < picture.rgb.size(); ++i)
			picture.rgb[i] += 1 - picture.alpha[i / 3];
		return picture;
	}

private:
	std::string povray;
	fs::path work;
	std::vector<std::string> options;
};

/// Says what was found; whether it is no more than chance allows.
bool Judge(const std::string& title, const BlockHarm& harm)
{
	const int allowed = HarmAllowed(harm.blocks);
	const bool good = harm.tenth <= allowed && harm.any <= allowed;
	fmt::print("{}: error {:.2f} of raw; in one picture {:.2f} % of blocks are a tenth worse; in the mean of {} seeds, of {} blocks {} by more than a tenth and {} at all"
		" (chance allows {} each){}{}\n", title, std::sqrt(harm.made / harm.raw), 100.0 * harm.once / harm.judged, Seeds, harm.blocks, harm.tenth, harm.any, allowed,
		harm.any > 0 ? fmt::format(", most {:.2f} at {}, {}", harm.worst, harm.worst_x, harm.worst_y) : "", good ? "" : ": WORSE");
	std::fflush(stdout);
	return good;
}

/// One line a setting: what `together` adds up.
std::string Line(const BlockHarm& h)
{
	return fmt::format("{} {} {} {} {} {:.9g} {:.9g} {:.9g} {} {}\n", h.blocks, h.judged, h.once, h.tenth, h.any, h.raw, h.made, h.worst, h.worst_x, h.worst_y);
}

bool RunScene(const std::string& povray, const fs::path& scene, const fs::path& work, const std::vector<std::string>& options)
{
	const Renders renders(povray, scene, work, options);
	fs::remove(work / "harm.txt");
	const Picture truth = renders.Render({0, TruthSamples, 0}, 1000, false);
	std::string lines;
	bool good = true;
	for (const Setting& setting : Settings)
	{
		std::vector<Picture> raw, denoised;
		for (int seed = 1; seed <= Seeds; ++seed)
		{
			raw.push_back(renders.Render(setting, seed, false));
			denoised.push_back(renders.Render(setting, seed, true));
		}
		if (raw[0].rgb == denoised[0].rgb)
			throw std::runtime_error(fmt::format("blur_samples {}: denoise changes no pixel; does the scene take Race_Denoise?", setting.Text()));
		const BlockHarm harm = CompareBlocks(raw, denoised, truth);
		good &= Judge(fmt::format("{}, blur_samples {}", work.filename().string(), setting.Text()), harm);
		lines += Line(harm);
	}
	std::ofstream(work / "harm.txt") << lines;
	return good;
}

/// Of the scenes named alone: a folder may hold others', of an older list or a longer run. Results that are older than the program are another program's.
bool RunTogether(const std::vector<std::string>& scenes, const fs::path& work, const fs::path& povray)
{
	BlockHarm sums[std::size(Settings)], all;
	for (const std::string& scene : scenes)
	{
		const fs::path file = work / scene / "harm.txt";
		std::ifstream in(file);
		if (!in || fs::last_write_time(file) < fs::last_write_time(povray))
			throw std::runtime_error(fmt::format("scene {} has not run into {}{}", scene, work.string(), in ? " since POV-Ray was built" : ""));
		for (BlockHarm& sum : sums)
		{
			BlockHarm h;
			in >> h.blocks >> h.judged >> h.once >> h.tenth >> h.any >> h.raw >> h.made >> h.worst >> h.worst_x >> h.worst_y;
			if (!in)
				throw std::runtime_error(file.string() + ": cut");
			sum.Add(h);
			all.Add(h);
		}
	}
	fmt::print("{} scenes\n", scenes.size());
	bool good = true;
	for (std::size_t i = 0; i < std::size(Settings); ++i)
		good &= Judge("blur_samples " + Settings[i].Text(), sums[i]);
	return Judge("all", all) && good;
}

}

int main(int argc, char** argv)
try
{
	std::string povray;
	fs::path scene, work;
	std::vector<std::string> options, scenes;
	CLI::App app{"Whether denoise makes any block of a picture worse"};
	CLI::App* one = app.add_subcommand("scene");
	CLI::App* all = app.add_subcommand("together");
	app.require_subcommand(1);
	one->add_option("SCENE", scene)->required();
	one->add_option("--option", options, "for POV-Ray")->allow_extra_args(false);
	all->add_option("SCENES", scenes)->required();
	for (CLI::App* command : {one, all})
	{
		command->add_option("--povray", povray)->required();
		command->add_option("--work", work)->required();
	}
	CLI11_PARSE(app, argc, argv);
	work = fs::absolute(work);
	return (*one ? RunScene(povray, fs::absolute(scene), work, options) : RunTogether(scenes, work, povray)) ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "no_harm: %s\n", error.what());
	return 2;
}
