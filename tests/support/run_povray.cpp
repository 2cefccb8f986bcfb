// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/run_povray.h"

#include "support/run_measured.h"

#include <algorithm>
#include <stdexcept>

void RunPovray(const std::string& program, const std::filesystem::path& folder, const std::string& scene,
	const std::string& picture, int width, int height, const std::vector<std::string>& more)
{
	if (program.empty() || !std::filesystem::exists(program))
		throw std::runtime_error("no POV-Ray at '" + program + "'; the distribution's package povray is the oracle (cmake/setup.sh installs it)");
	std::vector<std::string> command = {program, "-D", "-GA", "+WT1", "-A", "+FE", "+W" + std::to_string(width), "+H" + std::to_string(height),
		"+I" + scene, "+O" + picture};
	command.insert(command.end(), more.begin(), more.end());
	std::filesystem::remove(folder / picture);
	const std::filesystem::path log = folder / "povray.log";
	try
	{
		RunMeasured(command, folder, log);
	}
	catch (const std::runtime_error&)
	{
		// -GA silences the reason too: ask again, on the console. What goes well then is a failure all the same.
		std::replace(command.begin(), command.end(), std::string("-GA"), std::string("+GA"));
		RunMeasured(command, folder, log);
		throw;
	}
}
