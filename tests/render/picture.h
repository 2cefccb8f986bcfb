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

// Both throw std::runtime_error when the sizes differ.
double RmsDifference(const Picture& a, const Picture& b);
double LargestDifference(const Picture& a, const Picture& b);
