// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/old_set.h"

#include "base/file_set.h"
#include "base/files.h"
#include "base/plain_text.h"
#include "model/state_names.h"
#include <tiltcal/calibration.h>
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

namespace tiltcal
{

namespace
{

namespace fs = std::filesystem;

std::set<std::string> NamesOfState(const std::string& state, size_t photos)
{
	std::set<std::string> names{ "camera-" + state + ".inc", "blur-" + state + ".csv", "blur-" + state + ".png" };
	for (size_t p = 1; p <= photos; ++p)
		names.insert(fmt::format("overlay-{}-{}.png", state, p));
	return names;
}

std::set<std::string> NamesOf(const Calibration& c)
{
	std::set<std::string> names;
	for (const State& state : c.task.states)
		names.merge(NamesOfState(state.name, state.photos.size()));
	return names;
}

/// What the run that wrote this calibration.json left beside it; nothing where it cannot be read.
std::set<std::string> NamesOf(const std::string& calibration)
{
	std::set<std::string> names;
	try
	{
		const nlohmann::json json = nlohmann::json::parse(ReadText(calibration, "a calibration.json"));
		for (const nlohmann::json& state : json.at("states"))
		{
			const std::string name = state.at("name");
			CheckStateName(name);   // it may be anybody's, with ../ in it
			names.merge(NamesOfState(name, std::min<size_t>(state.at("photos").size(), 100000)));
		}
	}
	catch (const std::exception&)
	{
	}
	return names;
}

}

void RemoveOldSet(const std::string& folder, const Calibration& c, FileSet& set)
{
	const std::set<std::string> mine = NamesOf(c), old = NamesOf(Join(folder, "calibration.json"));
	static const std::regex pattern("camera-.*\\.inc|blur-.*\\.(csv|png)|overlay-.*-[0-9]+\\.png");
	size_t removed = 0;
	std::error_code code;
	for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
	{
		const std::string name = entry.path().filename().string();
		if (mine.count(name) > 0 || !std::regex_match(name, pattern))
			continue;
		if (old.count(name) > 0)
		{
			set.Remove(entry.path().string());
			++removed;
		}
		else
			spdlog::warn("{}: not of this run; remove it, or it will be taken for this calibration's", OneLine(entry.path().string()));
	}
	if (removed > 0)
		spdlog::info("{} files of the earlier run in {} are of states or photographs that this one has not: removed", removed, folder);
}

}
