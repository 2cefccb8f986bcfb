// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/callgrind.h"
#include "support/run_measured.h"

#include <fstream>
#include <stdexcept>

Profile RunCallgrind(const std::vector<std::string>& command, const std::filesystem::path& folder)
{
	std::vector<std::string> words = {"valgrind", "--tool=callgrind", "--callgrind-out-file=callgrind.out"};
	words.insert(words.end(), command.begin(), command.end());
	RunMeasured(words, folder, folder / "valgrind.log");
	Profile profile;
	std::ifstream file(folder / "callgrind.out");
	for (std::string line; std::getline(file, line);)
	{
		for (const std::string head : {"totals: ", "summary: "})
			if (profile.instructions == 0 && line.compare(0, head.size(), head) == 0)
				profile.instructions = std::stod(line.substr(head.size()));
		// fn=(12) name, once; later fn=(12).
		const std::size_t name = line.find(") ");
		if (name != std::string::npos && (line.compare(0, 4, "fn=(") == 0 || line.compare(0, 5, "cfn=(") == 0))
			profile.functions.insert(line.substr(name + 2));
	}
	if (!(profile.instructions > 0))
		throw std::runtime_error("callgrind counted nothing");
	return profile;
}
