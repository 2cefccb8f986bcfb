// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A picture file in memory, before anything of it is decoded, and the limits that hold for all formats.

#ifndef TILTCAL_PICTURE_FILE_H
#define TILTCAL_PICTURE_FILE_H

#include <string>

namespace tiltcal
{

enum class PictureFormat
{
	PNG,
	JPEG,
	TIFF,
	EXR
};

struct PictureFile
{
	std::string name;
	std::string bytes;
	PictureFormat format;   ///< by the first bytes; the suffix plays no part
};

/// No camera with an exchangeable lens has more, and four bytes for each of three colours of these are 2.4 GB.
constexpr long long MAX_PIXELS = 200'000'000;
constexpr long long MAX_SIDE = 65'535;

/// The whole file. Throws FileError: missing, a folder, a pipe or device, not readable, empty,
/// 2 GB and more, or of none of the formats.
PictureFile ReadPictureFile(const std::string& file);

/// Throws FileError unless a picture of this size is read; to be called with the header's
/// numbers, before memory is taken for the pixels.
void CheckPictureSize(const std::string& file, long long width, long long height);

}

#endif
