// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_DETECT_H
#define TILTCAL_DETECT_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

struct DetectOptions
{
	/// Accept a board that appears turned by more than 90 degrees from its upright
	/// position. Off by default: a checkerboard's colours cannot tell a mirrored
	/// picture from a board upside down.
	bool any_orientation = false;
};

/// Inner corners of the board in `grey` (linear light, CV_32FC1), row by row.
/// FindCheckerboard, then cornerSubPix at full scale on
/// linear light. Square (0, 0) is the black one at the board's top left when the colours
/// tell the board's two ends apart, otherwise the one at the top left of the picture.
/// Throws Refused: no board, another size, mirrored; `file` is named in the message.
std::vector<Corner> DetectCorners(const cv::Mat& grey, const Board& board, const DetectOptions& options, const std::string& file);

}

#endif
