// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"
#include "base/files.h"
#include "base/spelling.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <glog/logging.h>
#include <opencv2/core/utils/logger.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <new>

namespace
{

int Fail(tiltcal::ExitCode code, const std::string& message)
{
	fmt::print(stderr, "tiltcal: error: {}\n", tiltcal::SpelledAsOptions(message));
	return code;
}

std::string Quoted(const std::string& word)
{
	const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
	if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
		return word;
	std::string out = "'";
	for (const char c : word)
		out += c == '\'' ? std::string("'\\''") : std::string(1, c);
	return out + "'";
}

/// For a shell; the program without its folder.
std::string CommandLine(int argc, char** argv)
{
	std::string out = argc > 0 ? Quoted(tiltcal::BaseName(argv[0])) : "";
	for (int k = 1; k < argc; ++k)
		out += " " + Quoted(argv[k]);
	return out;
}

}

tiltcal::Log tiltcal::ProgramLog()
{
	return Log([](Severity severity, const std::string& message)
	{
		spdlog::log(severity == Severity::WARNING ? spdlog::level::warn : spdlog::level::info, "{}", SpelledAsOptions(message));
	});
}

int main(int argc, char** argv)
{
	// Results go to stdout, everything else to stderr.
	spdlog::set_default_logger(spdlog::stderr_logger_mt("tiltcal"));
	spdlog::set_pattern("tiltcal: %v");
	// What Ceres and OpenCV have to say is said in our own errors.
	FLAGS_minloglevel = google::GLOG_FATAL;
	cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);

	CLI::App app("tiltcal: calibrates a tilted lens from photographs of a checkerboard or a grid of circles, for tilt_lens in POV-Ray.", "tiltcal");
	app.set_version_flag("--version", "tiltcal " TILTCAL_VERSION);
	app.require_subcommand(1);
	app.footer("Exit codes: 0 done, 1 refused or not converged, 2 wrong usage, 3 unreadable or unwritable file.\n"
		"'tiltcal SUBCOMMAND --help' shows options, units, defaults and an example.");
	tiltcal::AddTarget(app);
	tiltcal::AddDetect(app);
	tiltcal::AddCalibrate(app, CommandLine(argc, argv));
	tiltcal::AddPose(app);
	tiltcal::AddProfile(app);
	tiltcal::AddExport(app);
	tiltcal::AddImport(app);
	try
	{
		app.parse(argc, argv);
		// A full disk or a closed pipe must not look like success.
		if (std::fflush(stdout) != 0)
			return Fail(tiltcal::EXIT_FILE, "the results could not be written to stdout");
		return tiltcal::EXIT_DONE;
	}
	catch (const CLI::ParseError& e)
	{
		return app.exit(e) == 0 ? tiltcal::EXIT_DONE : tiltcal::EXIT_USAGE;
	}
	catch (const tiltcal::Error& e)
	{
		return Fail(e.Code(), e.what());
	}
	catch (const std::bad_alloc&)
	{
		return Fail(tiltcal::EXIT_REFUSED, "out of memory: the pictures are too large");
	}
	catch (const std::exception& e)
	{
		return Fail(tiltcal::EXIT_REFUSED, fmt::format("unexpected: {}", e.what()));
	}
}
