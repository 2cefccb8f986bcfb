// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The texts that tiltcal reads: calibration.json (pose, export), points (pose), OpenCV's files (import) and --line (profile).
#pragma once
#include <string>
#include <vector>

enum class InputKind { JSON, CSV, YAML, XML, LINE };

struct Input
{
	InputKind kind;
	std::string bytes;
};

/// json, csv, ..: as a suffix too.
const char* NameOf(InputKind kind);

/// Whole ones, of every kind.
std::vector<Input> InputSeeds(const std::string& folder);

/// Does with the input what the subcommands do. True: it was taken; false: refused as it should be, in one line that names it, with a
/// file's exit code or a refusal's. Throws std::runtime_error otherwise, and where what comes out holds a number that is none or is
/// not taken itself. Files are written in `folder`.
bool TryInput(const Input& input, const std::string& folder);
