// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Runs a program and says what it cost.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

struct Cost
{
	double cpu = 0; // seconds, user and system, of the program and its children
	double wall = 0; // seconds
	double rss = 0; // MiB, at most
};

// Everything the program says goes to `log`. Throws std::runtime_error with its last words when it fails or is missing.
Cost RunMeasured(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::filesystem::path& log);
