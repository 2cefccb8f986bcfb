// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One POV-Ray process, and what became of it.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>

#include "camera_blocks.h"

enum class Outcome
{
	Rendered,           // every pixel finite
	RefusedByTiltLens,  // a parse error that names file and line, in the words of tilt_lens
	RefusedByParser,    // the same from POV-Ray's own parser
	NotFiniteUpstream,  // damage to the block has left a camera without tilt_lens: stock's own pixels
	Crash, Sanitizer, Hang, NotFinite, NoPicture, NoLine, NotANumberInReport,
	NotStarted          // upstream gives up when the machine is too busy to start its threads within seconds
};
const int Outcomes = int(Outcome::NotStarted) + 1;

const char* Name(Outcome outcome);
bool IsFailure(Outcome outcome);

// Writes the block's scene to `folder` and starts POV-Ray there, in a process group of its own.
pid_t Start(const Block& block, const std::string& povray, const std::filesystem::path& folder);

// Reads what a process that ended with `status` (as from waitpid) has left in `folder`.
Outcome Judge(const Block& block, int status, const std::filesystem::path& folder);
