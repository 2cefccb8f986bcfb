// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/run_measured.h"

#include "program/process.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

static std::string LastWords(const std::filesystem::path& log)
{
	std::ifstream file(log, std::ios::binary);
	std::ostringstream text;
	text << file.rdbuf();
	const std::string all = text.str();
	return all.substr(all.size() > 1500 ? all.size() - 1500 : 0);
}

Cost RunMeasured(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::filesystem::path& log)
{
	const tiltcal::ProcessResult result = tiltcal::RunProcess({command, folder.string(), {}, "", log.string()});
	if (result.exit_code != 0)
	{
		std::string line;
		for (const std::string& word : command)
			line += word + " ";
		throw std::runtime_error(line + "failed in " + folder.string() + ":\n" + LastWords(log));
	}
	return {result.cpu, result.wall, result.most_memory};
}
