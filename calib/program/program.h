// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the programs have in common: where messages go, and exit codes.

#ifndef TILTCAL_PROGRAM_H
#define TILTCAL_PROGRAM_H

#include <tiltcal/log.h>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace tiltcal
{

/// Runs a program: results go to stdout, messages as "NAME: .." to stderr. Returns `run`'s exit code, that of an Error (its inputs
/// spelled as options), EXIT_REFUSED of any other exception, 128 + the signal of an interrupt; EXIT_FILE where stdout cannot be written.
int RunProgram(const std::string& name, const std::function<int()>& run);

/// Writes to the program's messages, inputs spelled as options.
Log ProgramLog();

/// Where a report goes beside these outputs: stdout, but stderr where one of them is written there (/dev/stdout).
std::FILE* ReportBeside(const std::vector<std::string>& outputs);

/// The command line for a shell to read; the program without its folder.
std::string CommandLine(int argc, const char* const* argv);

}

#endif
