// SPDX-License-Identifier: AGPL-3.0-or-later

#include "run_block.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/picture.h"

const int PictureWidth = 4, PictureHeight = 3;

const char* Name(Outcome outcome)
{
	static const char* const names[Outcomes] = {
		"rendered", "refused by tilt_lens", "refused by the parser", "not finite, but not a tilt_lens camera", "crash", "sanitizer", "hang", "not-finite", "no-picture", "no-line",
		"nan-in-report", "not-started" };
	return names[int(outcome)];
}

bool IsFailure(Outcome outcome)
{
	return int(outcome) >= int(Outcome::Crash);
}

tiltcal::Process Start(const Block& block, const std::string& povray, const std::filesystem::path& folder, double timeout)
{
	std::filesystem::remove_all(folder);
	std::filesystem::create_directories(folder);
	std::ofstream(folder / "s.pov", std::ios::binary) << block.scene;

	// The short name keeps "File 's.pov' line N:" on one line of POV-Ray's 80 columns.
	tiltcal::ProcessSetup setup;
	setup.command = { povray, "-D", "+FE", "+Is.pov", "+Os.exr",
		"+W" + std::to_string(PictureWidth), "+H" + std::to_string(PictureHeight) };
	setup.command.insert(setup.command.end(), block.options.begin(), block.options.end());
	setup.folder = folder.string();
	setup.log = (folder / "log").string();
	setup.timeout = timeout;
	return tiltcal::Process(setup);
}

static bool Contains(const std::string& text, const char* part)
{
	return text.find(part) != std::string::npos;
}

// "\nTilt lens\n" and what the statistics say of it, up to the next rule; empty where the camera is of another type.
static std::string LensReport(const std::string& log)
{
	const auto at = log.find("\nTilt lens\n");
	return at == std::string::npos ? "" : log.substr(at, log.find("\n----", at) - at);
}

// The sphere, plane and sky of every scene are darker than 1; 2 leaves room for noise. Natural vignetting is relative to the lens's axis:
// lens sensor^3 / (n.e)^3 with the cosines lens, sensor <= 1 and n.e the cosine of the lens's tilt (natural_vignetting.h).
static double BrightestPixel(const std::string& report)
{
	const auto at = report.find("Lens Tilt:");
	if (at == std::string::npos || !Contains(report, "natural"))
		return 2.0;
	const double degree = std::acos(-1.0) / 180.0;
	return 2.0 / std::pow(std::abs(std::cos(std::atof(report.c_str() + at + std::strlen("Lens Tilt:")) * degree)), 3.0);
}

static bool AllFinite(const std::filesystem::path& file, double brightest)
{
	// Half floats, which pictures are made of, end here: what is brighter is infinite in the file as in stock's.
	const double half_ends = 65504.0;
	const Picture picture = ReadExr(file.string());
	return picture.width == PictureWidth && picture.height == PictureHeight &&
		std::all_of(picture.rgb.begin(), picture.rgb.end(), [&](double value) { return std::abs(value) < brightest || (std::isinf(value) && brightest > half_ends); }) &&
		std::all_of(picture.alpha.begin(), picture.alpha.end(), [](double value) { return value >= 0.0 && value < 1.001; });   // half floats round 1
}

static bool NamesALine(const std::string& log, const std::string& scene)
{
	// Upstream stops at singular matrices with "Uncategorized error", and says where and why as a possible error.
	static const char* const errors[] = { "Parse Error:", "Possible Parse Error: Singular matrix" };
	const long lines = long(std::count(scene.begin(), scene.end(), '\n'));
	const std::string file = "File 's.pov' line ";

	for (std::size_t at = log.find(file); at != std::string::npos; at = log.find(file, at + 1))
	{
		char* end = nullptr;
		const long line = std::strtol(log.c_str() + at + file.size(), &end, 10);
		for (const char* error : errors)
			if (std::string(": ") + error == std::string(end, strnlen(end, std::strlen(error) + 2)))
				return line >= 1 && line <= lines + 1;
	}
	return false;
}

Outcome Judge(const Block& block, const tiltcal::ProcessResult& result, const std::filesystem::path& folder)
{
	std::ifstream file(folder / "log", std::ios::binary);
	std::ostringstream text;
	text << file.rdbuf();
	const std::string log = text.str();

	if (result.late)
		return Outcome::Hang;
	if (Contains(log, "AddressSanitizer") || Contains(log, "runtime error:"))
		return Outcome::Sanitizer;
	if (Contains(log, "Timed out waiting for worker thread startup"))
		return Outcome::NotStarted;
	if (result.exit_code > 1)
		return Outcome::Crash;
	if (result.exit_code == 1 || Contains(log, ": Parse Error:"))    // "Possible Parse Error:" is a warning
	{
		if (!NamesALine(log, block.scene))
			return Outcome::NoLine;
		return Contains(log, "Parse Error: tilt_lens: ") ? Outcome::RefusedByTiltLens : Outcome::RefusedByParser;
	}
	const std::string report = LensReport(log);
	try
	{
		if (!AllFinite(folder / "s.exr", BrightestPixel(report)))
			return report.empty() ? Outcome::NotFiniteUpstream : Outcome::NotFinite;
	}
	catch (const std::exception&)
	{
		return Outcome::NoPicture;
	}
	if (Contains(report, "nan"))
		return Outcome::NotANumberInReport;
	return Outcome::Rendered;
}
