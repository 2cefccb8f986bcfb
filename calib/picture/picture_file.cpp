// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/picture_file.h"

#include <tiltcal/error.h>
#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

/// Of one file; more is no photograph. (MAX_PIXELS of three 16-bit colours, not compressed, are 1.2 GB.)
const std::uintmax_t MAX_BYTES = 2'000'000'000;

/// Pipes and devices are refused before they are opened: opening a pipe waits for its writer.
std::uintmax_t CheckedLength(const std::string& file)
{
	std::error_code code;
	if (fs::is_directory(file, code))
		throw FileError(fmt::format("{}: is a folder, not a picture; give the files, such as '{}/*.png'", file, file));
	NeedRegularFile(file, "a picture");
	const std::uintmax_t length = fs::file_size(file, code);
	if (code)
		throw FileError(fmt::format("{}: cannot be read ({})", file, code.message()));
	if (length == 0)
		throw FileError(fmt::format("{}: is empty (0 bytes)", file));
	if (length > MAX_BYTES)
		throw FileError(fmt::format("{}: has {} MB; pictures of up to {} MB are read", file, length / 1000000, MAX_BYTES / 1000000));
	return length;
}

bool StartsWith(const std::string& bytes, const char* magic, size_t length)
{
	return bytes.size() >= length && std::memcmp(bytes.data(), magic, length) == 0;
}

PictureFormat FormatOf(const std::string& file, const std::string& bytes)
{
	if (StartsWith(bytes, "\x89PNG", 4))
		return PictureFormat::PNG;
	if (StartsWith(bytes, "\xff\xd8\xff", 3))
		return PictureFormat::JPEG;
	// 42 is TIFF, 43 BigTIFF.
	for (const char* const magic : { "II\x2a\0", "II\x2b\0", "MM\0\x2a", "MM\0\x2b" })
		if (StartsWith(bytes, magic, 4))
			return PictureFormat::TIFF;
	if (StartsWith(bytes, "\x76\x2f\x31\x01", 4))
		return PictureFormat::EXR;
	throw FileError(fmt::format("{}: not a picture that is read here, or damaged; PNG, JPEG, TIFF and OpenEXR are read", file));
}

}

PictureFile ReadPictureFile(const std::string& file)
{
	const size_t length = static_cast<size_t>(CheckedLength(file));
	errno = 0;
	std::ifstream in(file, std::ios::binary);
	const auto read = [&](std::string& bytes, size_t from, size_t to)
	{
		try
		{
			bytes.resize(to);
		}
		catch (const std::bad_alloc&)
		{
			throw FileError(fmt::format("{}: too large for this machine's memory", file));
		}
		if (!in.read(bytes.data() + from, static_cast<std::streamsize>(to - from)))
			throw FileError(fmt::format("{}: cannot be read ({}); check its permissions", file, errno ? std::strerror(errno) : "it became shorter"));
	};
	// What is no picture is not read whole.
	std::string bytes;
	const size_t first = std::min<size_t>(length, 16);
	read(bytes, 0, first);
	const PictureFormat format = FormatOf(file, bytes);
	read(bytes, first, length);
	return { file, std::move(bytes), format };
}

void CheckPictureSize(const std::string& file, long long width, long long height)
{
	if (width < 1 || height < 1)
		throw FileError(fmt::format("{}: has {} x {} pixels; it is damaged", file, width, height));
	if (width > MAX_SIDE || height > MAX_SIDE || width > MAX_PIXELS / height)
		throw FileError(fmt::format("{}: its header says {} x {} pixels; up to {} megapixels, and {} a side, are read", file, width, height,
			MAX_PIXELS / 1000000, MAX_SIDE));
}

}
