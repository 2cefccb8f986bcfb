// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Signed differences as colours.

#ifndef PAPER_PICTURES_H
#define PAPER_PICTURES_H

#include <opencv2/core.hpp>

#include <array>
#include <string>

namespace paper
{

/// Levels of 255 at which the colours end.
const double COLOUR_LEVELS = 40;

/// Blue to white to red (blue, green, red as OpenCV has them) for -1 to 1; clips. The legend calls it too.
std::array<unsigned char, 3> DifferenceColour(double x);

/// a - b, pictures of brightness, as CV_8UC3.
cv::Mat DifferencePicture(const cv::Mat& a, const cv::Mat& b);

}

#endif
