// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/output_place.h"

#include <tiltcal/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

/// As Linux follows.
const int MOST_LINKS = 40;

/// Links there are open files, whose text need not be a path.
bool InProc(const fs::path& path)
{
	std::error_code code;
	const fs::path below = fs::weakly_canonical(path.parent_path(), code).lexically_relative("/proc");
	return !code && !below.empty() && *below.begin() != "..";
}

/// What a file created without ado gets.
mode_t UsualMode()
{
	const mode_t mask = umask(0);
	umask(mask);
	return 0666 & ~mask;
}

}

OutputPlace PlaceOf(const std::string& file)
{
	fs::path path(file);
	std::error_code code;
	for (int links = 0; fs::is_symlink(fs::symlink_status(path, code)); ++links)
	{
		if (InProc(path))
			return { file, true };
		const fs::path to = fs::read_symlink(path, code);
		if (code || links == MOST_LINKS)
			throw FileError(fmt::format("{}: is a link that leads nowhere; remove it", file));
		path = to.is_absolute() ? to : path.parent_path() / to;
	}
	const fs::file_status status = fs::status(path, code);
	if (fs::is_directory(status))
		throw FileError(fmt::format("{}: is a folder; give the name of a file", file));
	return { path.string(), fs::exists(status) && !fs::is_regular_file(status) };
}

std::string NewTemporary(const OutputPlace& place)
{
	const fs::path path(place.path);
	const char* const chosen = std::getenv("TMPDIR");
	const fs::path folder = place.through ? fs::path(chosen && *chosen ? chosen : "/tmp") : path.parent_path();
	const std::string suffix = path.extension().string();
	const std::string name = (folder / (".tiltcal-XXXXXX" + suffix)).string();
	std::vector<char> text(name.c_str(), name.c_str() + name.size() + 1);
	const int descriptor = mkstemps(text.data(), static_cast<int>(suffix.size()));
	if (descriptor < 0)
		throw FileError(fmt::format("{}: cannot be written ({}); check the folder and the free space", place.path, std::strerror(errno)));
	struct stat old;
	const bool there = !place.through && stat(place.path.c_str(), &old) == 0;
	// A file system without rights refuses, and needs none.
	if (fchmod(descriptor, there ? old.st_mode & 07777 : UsualMode()) != 0)
		errno = 0;
	close(descriptor);
	return text.data();
}

int SyncToDisk(const std::string& path)
{
	const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
	if (descriptor < 0)
		return 0;   // it may be written without being readable
	const int fault = fsync(descriptor) == 0 ? 0 : errno;
	close(descriptor);
	// Others say that the file system has no fsync.
	return fault == EIO || fault == ENOSPC || fault == EDQUOT ? fault : 0;
}

void CopyThrough(const std::string& from, const std::string& device, const std::string& file)
{
	std::ifstream in(from, std::ios::binary);
	// Not created: it is there.
	const int out = open(device.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
	int fault = out < 0 ? errno : 0;
	char part[65536];
	while (!fault && (in.read(part, sizeof part), in.gcount() > 0))
		for (ssize_t at = 0, length = in.gcount(); !fault && at < length;)
		{
			const ssize_t written = write(out, part + at, static_cast<size_t>(length - at));
			if (written >= 0)
				at += written;
			else if (errno != EINTR)
				fault = errno;
		}
	if (out >= 0 && close(out) != 0 && !fault)
		fault = errno;
	if (fault)
		throw FileError(fmt::format("{}: cannot be written ({})", file, std::strerror(fault)));
}

}
