// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/file_set.h"

#include "base/files.h"
#include "base/output_place.h"
#include "base/unfinished.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

[[noreturn]] void Fail(const std::string& file, int fault)
{
	throw FileError(fmt::format("{}: cannot be written ({}); check the folder and the free space", file, std::strerror(fault ? fault : EIO)));
}

void Rename(const std::string& from, const std::string& to, const std::string& file)
{
	if (std::rename(from.c_str(), to.c_str()) != 0)
		Fail(file, errno);
}

}

FileSet::~FileSet()
{
	std::error_code ignored;
	for (const Entry& e : entries)
		if (!e.temporary.empty() && !e.there)
		{
			fs::remove(e.temporary, ignored);
			ForgetUnfinished(e.temporary);
		}
}

std::string FileSet::Write(const std::string& file, const std::function<bool(const std::string&)>& write)
{
	Entry e;
	e.file = file;
	const OutputPlace place = PlaceOf(file);
	e.place = place.path;
	e.through = place.through;
	{
		const Uninterrupted uninterrupted;
		e.temporary = NewTemporary(place);
		NoteUnfinished(e.temporary);
	}
	entries.push_back(e);
	bool written = false;
	errno = 0;
	try
	{
		written = write(e.temporary);
	}
	catch (const Error&)
	{
		throw;
	}
	catch (const std::exception& fault)
	{
		throw FileError(fmt::format("{}: cannot be written: {}", file, fault.what()));
	}
	if (!written)
		Fail(file, errno);
	if (const int fault = SyncToDisk(e.temporary))
		Fail(file, fault);
	return e.temporary;
}

std::string FileSet::Text(const std::string& file, const std::string& text)
{
	return Write(file, [&](const std::string& temporary)
	{
		std::ofstream out(temporary, std::ios::binary);
		out << text;
		out.close();
		return static_cast<bool>(out);
	});
}

void FileSet::Join(FileSet& other)
{
	entries.insert(entries.end(), other.entries.begin(), other.entries.end());
	other.entries.clear();
}

void FileSet::Remove(const std::string& file)
{
	Entry e;
	e.file = e.place = file;
	entries.push_back(e);
}

void FileSet::PutAside(Entry& e)
{
	std::error_code code;
	if (!fs::exists(fs::symlink_status(e.place, code)))
		return;
	const std::string aside = NewTemporary({ e.place, false });
	if (std::rename(e.place.c_str(), aside.c_str()) != 0)
	{
		const int fault = errno;
		fs::remove(aside, code);
		Fail(e.file, fault);
	}
	e.aside = aside;
}

void FileSet::Undo()
{
	std::error_code ignored;
	for (Entry& e : entries)
	{
		if (e.there && !e.through && e.aside.empty())
			fs::remove(e.place, ignored);
		if (!e.aside.empty())
			fs::rename(e.aside, e.place, ignored);
	}
}

void FileSet::Commit()
{
	const Uninterrupted uninterrupted;   // Ctrl-C waits while files change places
	std::set<std::string> folders;
	try
	{
		for (Entry& e : entries)
			if (e.through)
				CopyThrough(e.temporary, e.place, e.file);
		// One new file alone takes its place in one step.
		if (entries.size() != 1 || entries[0].temporary.empty())
			for (auto e = entries.rbegin(); e != entries.rend(); ++e)
				if (!e->through)
					PutAside(*e);
		for (Entry& e : entries)
		{
			if (e.through)
				continue;
			folders.insert(fs::path(e.place).parent_path().string());
			if (e.temporary.empty())
				continue;
			Rename(e.temporary, e.place, e.file);
			e.there = true;
		}
	}
	catch (...)
	{
		Undo();
		throw;
	}
	for (const std::string& folder : folders)
		SyncToDisk(folder.empty() ? "." : folder);
	std::error_code ignored;
	for (const Entry& e : entries)
	{
		if (!e.aside.empty())
			fs::remove(e.aside, ignored);
		if (e.through)
			fs::remove(e.temporary, ignored);
		ForgetUnfinished(e.temporary);
	}
	entries.clear();
}

void WriteAtomically(const std::string& file, const std::function<bool(const std::string&)>& write)
{
	FileSet set;
	set.Write(file, write);
	set.Commit();
}

void WriteText(const std::string& file, const std::string& text)
{
	FileSet set;
	set.Text(file, text);
	set.Commit();
}

}
