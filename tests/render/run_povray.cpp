// SPDX-License-Identifier: AGPL-3.0-or-later

#include "run_povray.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

void RunPovray(const std::string& program, const std::filesystem::path& folder, const std::string& scene,
	const std::string& picture, int width, int height, const std::vector<std::string>& more)
	{
	if (program.empty() || !std::filesystem::exists(program))
		throw std::runtime_error("no POV-Ray at '" + program + "'; the distribution's package povray is the oracle (cmake/setup.sh installs it)");
	const auto quoted = [](const std::string& word) { return "'" + word + "'"; };
	std::string command = "cd " + quoted(folder.string()) + " && " + quoted(program) + " -D -GA +WT1 -A +FE";
	command += " +W" + std::to_string(width) + " +H" + std::to_string(height);
	command += " +I" + quoted(scene) + " +O" + quoted(picture);
	for (const std::string& word : more)
		command += " " + quoted(word);
	command += " > povray.log 2>&1";
	std::filesystem::remove(folder / picture);
	if (std::system(command.c_str()) == 0)
		return;
	// -GA silences the reason too: ask again, on the console.
	std::string again = command;
	again.replace(again.find("-GA"), 3, "+GA");
	(void)!std::system(again.c_str());
	std::ifstream log(folder / "povray.log");
	std::ostringstream text;
	text << log.rdbuf();
	const std::string all = text.str();
	throw std::runtime_error(command + " failed:\n" + all.substr(all.size() > 1500 ? all.size() - 1500 : 0));
}
