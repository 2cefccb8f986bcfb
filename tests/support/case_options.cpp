// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/case_options.h"

#include <filesystem>
#include <stdexcept>

std::map<std::string, std::string> ReadCaseOptions(int argc, char** argv, const std::string& names)
{
	if (argc < 2 || argc % 2 != 0)
		throw std::runtime_error("usage: " + std::filesystem::path(argv[0]).filename().string() + " CASE " + names);
	std::map<std::string, std::string> option;
	for (int i = 2; i < argc; i += 2)
		option[argv[i]] = argv[i + 1];
	return option;
}
