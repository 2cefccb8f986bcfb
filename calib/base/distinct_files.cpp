// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/distinct_files.h"

#include "base/plain_text.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <filesystem>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

bool IsSameFile(const std::string& a, const std::string& b)
{
	std::error_code none;
	if (a.empty() || b.empty())
		return false;
	if (fs::exists(a, none) && !fs::is_regular_file(a, none))
		return false;
	// Before there is a file names must do.
	return fs::equivalent(a, b, none) || fs::weakly_canonical(fs::absolute(a, none), none) == fs::weakly_canonical(fs::absolute(b, none), none);
}

}

void CheckDistinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs)
{
	for (size_t k = 0; k < outputs.size(); ++k)
	{
		const auto& [option, file] = outputs[k];
		for (const NamedFile& in : inputs)
			if (IsSameFile(file, in.file))
				throw UsageError(fmt::format("{} {}: would write over what {} reads; give another place", option, OneLine(file), in.option));
		for (size_t other = 0; other < k; ++other)
			if (IsSameFile(file, outputs[other].file))
				throw UsageError(fmt::format("{} {}: is the file of {} too; give another", option, OneLine(file), outputs[other].option));
	}
}

}
