// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One function per subcommand: it declares its options and, when it is the one called,
// does the work. Each throws Error.

#ifndef TILTCAL_COMMANDS_H
#define TILTCAL_COMMANDS_H

#include <CLI/CLI.hpp>

#include <string>

namespace tiltcal
{

void AddTarget(CLI::App& app);
void AddDetect(CLI::App& app);
/// `command_line`: how the program was called, for the report.
void AddCalibrate(CLI::App& app, const std::string& command_line);
void AddPose(CLI::App& app);
void AddProfile(CLI::App& app);
void AddLens(CLI::App& app);
void AddExport(CLI::App& app);
void AddImport(CLI::App& app);
void AddUndistort(CLI::App& app);
void AddProject(CLI::App& app);
void AddUnproject(CLI::App& app);

}

#endif
