// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/files.h"

#include "base/output_place.h"
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <glob.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

/// Compares names with runs of digits as numbers.
bool NaturalLess(const std::string& a, const std::string& b)
{
	size_t i = 0, j = 0;
	while (i < a.size() && j < b.size())
	{
		const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
		if (digit(a[i]) && digit(b[j]))
		{
			const auto number = [&](const std::string& s, size_t& k)
			{
				while (k < s.size() && s[k] == '0')
					++k;
				const size_t start = k;
				while (k < s.size() && digit(s[k]))
					++k;
				return s.substr(start, k - start);
			};
			const std::string x = number(a, i), y = number(b, j);
			if (x.size() != y.size())
				return x.size() < y.size();
			if (x != y)
				return x < y;
		}
		else if (a[i] != b[j])
			return a[i] < b[j];
		else
			++i, ++j;
	}
	// Equal as far as they go ("01" and "1" included): plain order keeps it strict.
	if ((a.size() - i) != (b.size() - j))
		return a.size() - i < b.size() - j;
	return a < b;
}

}

std::string AsPattern(const std::string& folder)
{
	std::string pattern;
	for (const char c : folder)
	{
		if (std::string_view("*?[]\\").find(c) != std::string_view::npos)
			pattern += '\\';
		pattern += c;
	}
	return pattern;
}

std::vector<std::string> ExpandGlobs(const std::vector<std::string>& patterns, const std::string& option)
{
	std::vector<std::string> files;
	for (const std::string& pattern : patterns)
	{
		// A name that exists is taken as it is, even if it contains [ or *.
		std::error_code code;
		if (fs::exists(pattern, code))
		{
			files.push_back(pattern);
			continue;
		}
		glob_t found{};
		if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
			files.insert(files.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
		const bool none = found.gl_pathc == 0;
		globfree(&found);
		if (none)
			throw FileError(fmt::format("{}: no file matches '{}' (looked in {}); check the folder and the spelling",
				option, pattern, fs::current_path(code).string()));
	}
	std::sort(files.begin(), files.end(), NaturalLess);
	files.erase(std::unique(files.begin(), files.end()), files.end());
	return files;
}

void NeedRegularFile(const std::string& file, const std::string& what)
{
	std::error_code code;
	const fs::file_status status = fs::status(file, code);
	if (status.type() == fs::file_type::not_found)
		throw FileError(fmt::format("{}: no such file; give {}", file, what));
	if (fs::is_directory(status))
		throw FileError(fmt::format("{}: is a folder, not {}", file, what));
	if (code)
		throw FileError(fmt::format("{}: cannot be read ({})", file, code.message()));
	if (!fs::is_regular_file(status))
		throw FileError(fmt::format("{}: is a pipe or a device, not {}; save it to a file", file, what));
}

std::string ReadText(const std::string& file, const std::string& what, size_t most)
{
	NeedRegularFile(file, what);
	std::error_code code;
	if (fs::file_size(file, code) > most && !code)
		throw FileError(fmt::format("{}: has more than {} MB and is not {}", file, most >> 20, what));
	errno = 0;
	std::ifstream in(file, std::ios::binary);
	std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
	if (!in)
		throw FileError(fmt::format("{}: cannot be read ({}); check its permissions", file, errno ? std::strerror(errno) : "it became shorter"));
	return text;
}

void PrepareFolder(const std::string& folder, const std::string& input)
{
	const std::string another = input.empty() ? "write elsewhere" : fmt::format("give another with `{}`", input);
	std::error_code code;
	fs::create_directories(folder, code);
	if (code || !fs::is_directory(folder))
		throw FileError(fmt::format("{}: cannot create this folder ({}); {}",
			folder, code ? code.message() : "a file of this name is in the way", another));
	try
	{
		fs::remove(NewTemporary({ Join(folder, "probe"), false }), code);
	}
	catch (const Error&)
	{
		throw FileError(fmt::format("{}: cannot write in this folder; change its permissions or {}", folder, another));
	}
}

void PrepareFolderOf(const std::string& file)
{
	const OutputPlace place = PlaceOf(file);
	if (place.through)
	{
		if (access(place.path.c_str(), W_OK) != 0)
			throw FileError(fmt::format("{}: cannot be written ({})", file, std::strerror(errno)));
		return;
	}
	const std::string folder = fs::path(place.path).parent_path().string();
	PrepareFolder(folder.empty() ? "." : folder, "");
}

std::string Stem(const std::string& file) { return fs::path(file).stem().string(); }
std::string BaseName(const std::string& file) { return fs::path(file).filename().string(); }
std::string Join(const std::string& folder, const std::string& name) { return (fs::path(folder) / name).string(); }

}
