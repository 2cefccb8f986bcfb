// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures of the render tests: RGB, linear when read from OpenEXR.
#pragma once
#include <string>
#include <vector>

struct Picture
{
	int width = 0, height = 0;
	std::vector<double> rgb; // rows from the top, three values a pixel
	std::vector<double> alpha; // one value a pixel, 1 in files without it; empty for pictures that no file holds
};

// All throw std::exception when the file cannot be read. ReadPpm: 16 bits, to 0 ... 1; ReadPicture: by the name's end.
Picture ReadExr(const std::string& path);
Picture ReadPpm(const std::string& path);
Picture ReadPicture(const std::string& path);

// Means of cells of `size` by `size` pixels; what does not fill a cell is left out. Noise fades there, a wrong lens does not.
Picture Coarser(const Picture& picture, int size);

Picture Mirrored(const Picture& picture);

bool AllFinite(const Picture& picture);

// rgb alone, in full precision. Both throw std::runtime_error when the file cannot be written, or read as that size.
void WriteRaw(const Picture& picture, const std::string& path);
Picture ReadRaw(const std::string& path, int width, int height);

// rgb alone. Both throw std::runtime_error when the sizes differ.
double RmsDifference(const Picture& a, const Picture& b);
double LargestDifference(const Picture& a, const Picture& b);
