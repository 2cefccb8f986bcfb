// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/watched_files.h"

#include "base/files.h"

#include <tiltcal/error.h>

#include <filesystem>
#include <set>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

const auto STANDS_STILL = std::chrono::seconds(1);

/// Of browsers, rsync, gphoto2 and darktable, and all that is hidden.
bool IsUnfinishedName(const std::string& file)
{
	const std::string name = BaseName(file), suffix = fs::path(name).extension().string();
	return name.empty() || name[0] == '.' || name.back() == '~' || suffix == ".part" || suffix == ".tmp" || suffix == ".crdownload" || suffix == ".partial";
}

}

WatchedFiles::WatchedFiles(const std::string& folder, const std::vector<StatePatterns>& given) : states(given)
{
	for (StatePatterns& state : states)
		for (std::string& pattern : state.patterns)
			if (!fs::path(pattern).is_absolute())
				pattern = Join(AsPattern(folder), pattern);
}

void WatchedFiles::Look()
{
	const auto now = std::chrono::steady_clock::now();
	std::set<std::string> there;
	settled.clear();
	pending = false;
	for (const StatePatterns& state : states)
	{
		settled.push_back({ state.name, {}, state.f_number });
		std::vector<std::string> files;
		try
		{
			files = ExpandGlobs(state.patterns, state.option);
		}
		catch (const Error&)
		{
			// None yet, of one pattern at least.
			for (const std::string& pattern : state.patterns)
				try
				{
					for (const std::string& file : ExpandGlobs({ pattern }, state.option))
						files.push_back(file);
				}
				catch (const Error&)
				{
				}
		}
		for (const std::string& file : files)
		{
			std::error_code gone;
			if (IsUnfinishedName(file) || !fs::is_regular_file(file, gone))
				continue;
			const FileStamp stamp{ fs::file_size(file, gone), gone ? 0 : static_cast<std::int64_t>(fs::last_write_time(file, gone).time_since_epoch().count()) };
			if (gone)
				continue;
			there.insert(file);
			const auto [at, is_new] = known.emplace(file, Entry{ stamp, now });
			if (!is_new && !(at->second.stamp == stamp))
				at->second = { stamp, now };
			if (now - at->second.since < STANDS_STILL)
				pending = true;
			else if (stamp.size > 0)   // an empty one that stands still is no photograph yet, and nobody waits for it
				settled.back().files.push_back(file);
		}
	}
	for (auto at = known.begin(); at != known.end();)
		at = there.count(at->first) ? std::next(at) : known.erase(at);
}

}
