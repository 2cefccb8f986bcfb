// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which photographs are in a folder, by looking again and again: a network's folder tells nobody what arrives.

#ifndef TILTCAL_WATCHED_FILES_H
#define TILTCAL_WATCHED_FILES_H

#include "cli/calibrate_run.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tiltcal
{

/// What tells a file from an older one of its name.
struct FileStamp
{
	std::uintmax_t size = 0;
	std::int64_t written = 0;   ///< ticks of the file system's clock

	bool operator==(const FileStamp& o) const { return size == o.size && written == o.written; }
};

class WatchedFiles
{
public:
	/// Patterns that are no absolute names are of `folder`.
	WatchedFiles(const std::string& folder, const std::vector<StatePatterns>& states);

	/// Looks again. A file counts once its size and time have stood still for a second; names of unfinished downloads never do.
	void Look();

	/// Of every one of the states, in their order.
	const std::vector<StateFiles>& Settled() const { return settled; }
	const FileStamp& StampOf(const std::string& file) const { return known.at(file).stamp; }
	/// Settled, or still being written.
	bool IsThere(const std::string& file) const { return known.count(file) > 0; }
	/// Some are still being written.
	bool Pending() const { return pending; }

private:
	struct Entry
	{
		FileStamp stamp;
		std::chrono::steady_clock::time_point since;
	};

	std::vector<StatePatterns> states;
	std::map<std::string, Entry> known;
	std::vector<StateFiles> settled;
	bool pending = false;
};

}

#endif
