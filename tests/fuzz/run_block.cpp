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

// The sphere, plane and sky of every scene are darker than 1.
static bool AllFinite(const std::filesystem::path& file)
{
	const Picture picture = ReadExr(file.string());
	return picture.width == PictureWidth && picture.height == PictureHeight &&
		std::all_of(picture.rgb.begin(), picture.rgb.end(), [](double value) { return std::abs(value) < 2.0; }) &&
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
	try
	{
		if (!AllFinite(folder / "s.exr"))
			return Contains(log, "\nTilt lens\n") ? Outcome::NotFinite : Outcome::NotFiniteUpstream;
	}
	catch (const std::exception&)
	{
		return Outcome::NoPicture;
	}
	const auto report = log.find("\nTilt lens\n");
	if (report != std::string::npos && Contains(log.substr(report, log.find("\n----", report) - report), "nan"))
		return Outcome::NotANumberInReport;
	return Outcome::Rendered;
}
