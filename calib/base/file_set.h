// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Files that belong together: all of them appear, or none.

#ifndef TILTCAL_FILE_SET_H
#define TILTCAL_FILE_SET_H

#include <functional>
#include <string>
#include <vector>

namespace tiltcal
{

/// Files are written under temporary names beside their places and take them with Commit. A link keeps pointing where it does: the file
/// that it names is replaced. Devices and pipes cannot be replaced and are written to. What is written is on the disk (fsync).
///
/// Commit puts old files aside from the last to the first and lets new ones in from the first to the last: so write last the file by
/// which others know a whole set, and a power failure in between leaves no such file. Any other failure puts the old ones back.
class FileSet
{
public:
	FileSet() = default;
	/// Removes what was not committed.
	~FileSet();
	FileSet(const FileSet&) = delete;
	FileSet& operator=(const FileSet&) = delete;

	/// Lets `write` produce `file` under a temporary name (same suffix), which is returned. `write` returns false, or throws, when it
	/// cannot. Throws FileError.
	std::string Write(const std::string& file, const std::function<bool(const std::string& temporary)>& write);

	/// Write for text.
	std::string Text(const std::string& file, const std::string& text);

	/// Takes over what `other` has written.
	void Join(FileSet& other);

	/// `file` is of an older set: it goes when this one comes.
	void Remove(const std::string& file);

	/// Throws FileError; all is then as before.
	void Commit();

private:
	struct Entry
	{
		std::string file, place, temporary, aside;   ///< place: behind links; temporary: empty to remove only
		bool through = false, there = false;         ///< through: a device; there: has taken its place
	};
	std::vector<Entry> entries;

	void PutAside(Entry& entry);
	void Undo();
};

}

#endif
