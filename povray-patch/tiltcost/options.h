// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The command line.

#ifndef TILTCOST_OPTIONS_H
#define TILTCOST_OPTIONS_H

#include "tiltcost/pilot_run.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace tiltcost
{

const double AsTheScene = 0;

struct Options
{
	Job job;
	std::vector<std::string> files;             ///< the scene and ini files as they were named, [SECTION] with them
	double time = 0, error = 0, levels = 0;     ///< --time, --error or --levels, at most one of them; 0: not asked
	double stop_levels = 0.29;
	std::vector<Setting> own;                   ///< confidence AsTheScene where it was not named
	std::string plot, csv, rows, page;
};

/// Declares the options on `app` and parses. Words that begin with one + or -, and NAME=value,
/// are POV-Ray's. Throws CLI::ParseError.
Options ParseCommandLine(CLI::App& app, int argc, char** argv);

/// "90", "90s", "1.5m", "2h" as seconds; 0 for what is no positive time.
double ParseDuration(const std::string& text);

/// "0.004" or "1/255"; 0 for what is no positive number.
double ParseNumber(const std::string& text);

}

#endif
