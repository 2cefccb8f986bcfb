// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One POV-Ray process, and what became of it.
#pragma once
#include <filesystem>
#include <string>

#include "program/process.h"
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

// Writes the block's scene to `folder` and starts POV-Ray there, for `timeout` seconds at the most.
tiltcal::Process Start(const Block& block, const std::string& povray, const std::filesystem::path& folder, double timeout);

// Reads what a process that ended so has left in `folder`.
Outcome Judge(const Block& block, const tiltcal::ProcessResult& result, const std::filesystem::path& folder);
