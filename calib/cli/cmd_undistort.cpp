// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/distinct_files.h"
#include "base/file_set.h"
#include "base/files.h"
#include "base/plain_text.h"
#include "exchange/undistort.h"
#include "picture/image_io.h"
#include "program/progress.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cctype>
#include <filesystem>
#include <memory>
#include <set>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, state, overscan = "0", transfer = "srgb", out, format = "png";
	std::vector<std::string> pictures;
	bool redistort = false;
};

bool IsPicture(const std::string& file)
{
	std::string suffix = std::filesystem::path(file).extension().string();
	for (char& c : suffix)
		c = char(std::tolower(static_cast<unsigned char>(c)));
	for (const char* known : { ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr" })
		if (suffix == known)
			return true;
	return false;
}

/// Files, and all pictures of folders.
std::vector<std::string> Pictures(const Options& o)
{
	std::vector<std::string> files;
	for (const std::string& name : o.pictures)
	{
		std::error_code unreachable;   // ExpandGlobs says so
		const bool folder = std::filesystem::is_directory(name, unreachable);
		for (const std::string& file : ExpandGlobs({ folder ? Join(AsPattern(name), "*") : name }, "PICTURE"))
			if (!folder || (std::filesystem::is_regular_file(file, unreachable) && IsPicture(file)))
				files.push_back(file);
	}
	if (files.empty())
		throw FileError(fmt::format("{}: holds no pictures (.png, .jpg, .tif, .exr)", o.pictures[0]));
	return files;
}

/// Of every picture, in o.out; refuses two of one name.
std::vector<std::string> Outputs(const Options& o, const std::vector<std::string>& files)
{
	std::vector<std::string> out;
	std::set<std::string> taken;
	for (const std::string& file : files)
	{
		out.push_back(Join(o.out, fmt::format("{}.{}", Stem(file), o.format)));
		if (!taken.insert(out.back()).second)
			throw UsageError(fmt::format("{}: two pictures would become {}; give them separately", file, out.back()));
		CheckDistinct({ { "PICTURE", file } }, { { "--out", out.back() } });
	}
	return out;
}

void Run(const Options& o)
{
	if (o.format != "png" && o.format != "exr")
		throw UsageError(fmt::format("--format {}: there is png (16 bits) and exr (32 bit floats, linear light)", o.format));
	const Transfer transfer = ParseTransfer(o.transfer);
	const StateCamera camera = ReadStateCamera(o.calibration, o.state);
	const Margins margins = ParseOverscan(o.overscan, camera);
	const std::vector<std::string> files = Pictures(o), outputs = Outputs(o, files);
	PrepareFolder(o.out);
	const Resampling resampling(camera, margins, o.redistort ? Direction::REDISTORT : Direction::UNDISTORT);
	auto progress = std::make_unique<Progress>(o.redistort ? "redistorting" : "undistorting", files.size());
	for (size_t i = 0; i < files.size(); ++i)
	{
		FileSet set;
		PhotographFacts facts;
		const cv::Mat linear = ReadLinear(files[i], transfer, &facts);
		WriteLinear(resampling.Of(linear, files[i]), transfer, outputs[i], set);
		set.Commit();
		if (const double lost = BrighterThanWhite(linear); lost > 0 && o.format == "png")
			spdlog::warn("{}: {:.2g} % of it is brighter than white, which PNG cannot hold: white in {}; --format exr keeps it", files[i], 100 * lost, outputs[i]);
		if (!facts.left_out.empty())
			spdlog::warn("{}: not in {}: {} (light alone is read; a compositor's STMap moves every channel: tiltcal export --stmap)", files[i], outputs[i], OneLine(facts.left_out));
		spdlog::info("{} of {}: {}", i + 1, files.size(), outputs[i]);
		progress->Done(i + 1);
	}
	progress.reset();
	if (!o.redistort)
		fmt::print("state {}: undistorted {} x {} pixels, {:.1f} % of the photograph (--overscan auto keeps all)\n", camera.state, camera.width + 2 * margins.x,
			camera.height + 2 * margins.y, 100 * SharePictured(camera, margins));
}

}

void AddUndistort(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("undistort", "Photographs without the lens's distortion, or pictures with it.");
	c->add_option("PICTURE", o->pictures, "FILES or a FOLDER: PNG, JPEG, TIFF, OpenEXR")->required();
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->add_option("--out", o->out, "FOLDER for the results, under the pictures' names")->required();
	c->add_option("--overscan", o->overscan, "Percent by which the undistorted picture is larger on each side, or auto: all of the photograph")->capture_default_str();
	c->add_flag("--redistort", o->redistort, "The other way: a picture as large as the undistorted one (same --overscan) gets the distortion");
	c->add_option("--format", o->format, "png: 16 bits; exr: 32 bit floats in linear light")->capture_default_str();
	c->add_option("--transfer", o->transfer, "Transfer curve of 8 and 16 bit pictures, in and out: srgb, linear or a gamma")->capture_default_str();
	c->footer("Example:\n  tiltcal undistort photos/plus5-*.jpg --calibration calibration/calibration.json --state plus5 --out flat\n\n"
		"Resampled in linear light, bicubic. In the undistorted picture straight lines are straight, also of a tilted lens, whose\n"
		"distortion is about its own axis; image distance and principal point are the calibration's. EXIF, alpha and OpenEXR's further channels are not kept.\n"
		"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
