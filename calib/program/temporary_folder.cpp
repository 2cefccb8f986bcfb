// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/temporary_folder.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace tiltcal
{

std::string TemporaryTemplate(const std::string& program)
{
	const char* place = std::getenv("TMPDIR");
	return std::string(place && *place ? place : "/tmp") + "/" + program + ".XXXXXX";
}

TemporaryFolder::TemporaryFolder(const std::string& program)
{
	std::string name = TemporaryTemplate(program);
	if (!mkdtemp(name.data()))
		throw FileError(fmt::format("{}: no temporary folder ({}); set TMPDIR to a place that can be written", name, std::strerror(errno)));
	path = std::filesystem::absolute(name).string();
}

TemporaryFolder::~TemporaryFolder()
{
	std::error_code ignored;
	std::filesystem::remove_all(path, ignored);
}

}
