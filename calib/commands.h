// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One function per subcommand: it declares its options and, when it is the one called,
// does the work. Each throws Error.

#ifndef TILTCAL_COMMANDS_H
#define TILTCAL_COMMANDS_H

#include <CLI/CLI.hpp>

namespace tiltcal
{

void AddCalibrate(CLI::App& app);
void AddDetect(CLI::App& app);
void AddProfile(CLI::App& app);

}

#endif
