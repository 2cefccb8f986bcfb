// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where an output really goes, and the system's calls for it.

#ifndef TILTCAL_OUTPUT_PLACE_H
#define TILTCAL_OUTPUT_PLACE_H

#include <string>

namespace tiltcal
{

struct OutputPlace
{
	std::string path;       ///< behind links
	bool through = false;   ///< a device, a pipe or an open file (/dev/stdout): nothing that could be replaced
};

/// Throws FileError for a folder, and for links that go round in a circle.
OutputPlace PlaceOf(const std::string& file);

/// A new empty file to write in: beside the place (with its rights, if it is there), or in $TMPDIR for what is written through. Same
/// suffix. Throws FileError.
std::string NewTemporary(const OutputPlace& place);

/// fsync of a file or a folder. 0, or the errno of what the disk could not keep.
int SyncToDisk(const std::string& path);

/// The bytes of one file into a device. `file` is named in the FileError.
void CopyThrough(const std::string& from, const std::string& device, const std::string& file);

}

#endif
