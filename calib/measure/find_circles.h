// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where a grid of circles is in a picture, and which circle is which.

#ifndef TILTCAL_FIND_CIRCLES_H
#define TILTCAL_FIND_CIRCLES_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>
#include "measure/detect.h"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

struct FoundCircles
{
	/// Images of the centres to some tenths of a pixel, row by row. Corner::column, row as in board.h.
	std::vector<Corner> centres;
	bool bright = false;      ///< white circles on dark
	double radius = 0;        ///< of the circles as the picture shows them, in units of the spacing
};

/// OpenCV's blobs and its findCirclesGrid in `grey` (linear light, CV_32FC1) reduced to several sizes, as it is and with
/// local mean and contrast made equal; dark circles first, then white ones. Blobs' middles are
/// moved to where the circles' centres are in perspective.
/// Circles look the same turned by 180 degrees, as many columns as rows also by 90: the picture's top left is the first. In asymmetric
/// grids the pattern decides.
/// Throws Refused: no grid, another size, mirrored; `file` is named in the message. UsageError: asymmetric, an even number of rows.
FoundCircles FindCircles(const cv::Mat& grey, const Board& board, const DetectOptions& options, const std::string& file);

}

#endif
