// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Brightness, the measure of Table 2, and differences of it.

#ifndef PAPER_BRIGHTNESS_H
#define PAPER_BRIGHTNESS_H

#include <opencv2/core.hpp>

#include <string>

namespace paper
{

/// In levels of 255.
struct Error
{
	double mean_abs = 0;
	double rms = 0;
};

/// Along the two lines of Table 2 and over the whole picture.
struct Errors
{
	Error red, green, picture;
};

/// The lines, of pictures of 1800 x 1200 pixels: row 660 is red, column 900 green, as in demo.cmake.
const int RED_ROW = 660, GREEN_COLUMN = 900;

/// Luminance in linear light of a picture file, CV_32FC1.
cv::Mat ReadLuminance(const std::string& file);

/// 255 times the sRGB code of linear luminance, clipped: CV_32FC1. The definition of tiltcal profile.
cv::Mat Brightness(const cv::Mat& luminance);

/// Of two pictures of brightness of one size, which must hold the lines.
Errors Differences(const cv::Mat& a, const cv::Mat& b);

/// Over rows begin to end - 1.
Error DifferenceInRows(const cv::Mat& a, const cv::Mat& b, int begin, int end);

}

#endif
