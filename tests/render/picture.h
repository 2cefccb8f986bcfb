// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures of the render tests: linear RGB, read from OpenEXR.
#pragma once
#include <string>
#include <vector>

struct Picture
{
	int width = 0, height = 0;
	std::vector<double> rgb; // rows from the top, three values a pixel
};

// Throws std::exception when the file cannot be read.
Picture ReadExr(const std::string& path);

// Means of cells of `size` by `size` pixels; what does not fill a cell is left out. Noise fades there, a wrong lens does not.
Picture Coarser(const Picture& picture, int size);

// Both throw std::runtime_error when the sizes differ.
double RmsDifference(const Picture& a, const Picture& b);
double LargestDifference(const Picture& a, const Picture& b);
