// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whole pictures of every kind that tiltcal reads, in memory: a small checkerboard, written
// by OpenCV, libpng, libtiff, OpenEXR and exiv2. The tests read them, the fuzzer damages them.
#pragma once

#include <opencv2/core.hpp>

#include <string>
#include <vector>

struct PictureSeed
{
	std::string name;     ///< as a file name
	std::string bytes;
	double tolerance;     ///< of linear light against Checkerboard(): rounding and compression
};

/// 7 x 5 squares with a white margin, a little blurred, linear light, CV_32FC1.
cv::Mat Checkerboard();

/// Writes below `folder`, which exists.
std::vector<PictureSeed> PictureSeeds(const std::string& folder);
