// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Runs a program under valgrind's callgrind and says what it executed. Repeatable, unlike times.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

struct Profile
{
	double instructions = 0;
	std::set<std::string> functions; // that were called, as valgrind writes them
};

// `folder` receives callgrind.out and valgrind.log. Throws std::runtime_error when the program fails or valgrind is missing.
Profile RunCallgrind(const std::vector<std::string>& command, const std::filesystem::path& folder);
