// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where a board is in a picture, to about a pixel: the start of all that is measured.

#ifndef TILTCAL_FIND_BOARD_H
#define TILTCAL_FIND_BOARD_H

#include <tiltcal/board.h>

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

/// 8-bit sRGB-coded copy of `grey` (linear, CV_32FC1), its brightest percent near white: what OpenCV's detectors are made for.
cv::Mat ForDetector(const cv::Mat& grey);

/// `picture` (8 bit) with the local mean taken away, the local contrast made equal, then saturated: signs of the pattern, in 8 bit.
/// `window` px.
cv::Mat Flatten(const cv::Mat& picture, double window);

/// Small from full (2x3) for a picture reduced by `scale`: pixel centres are at integers, so about (-0.5, -0.5).
cv::Mat ScaleMap(double scale);

/// Inner corners of a checkerboard in `grey`, row by row in some numbering, to a few tenths of a pixel or, strongly
/// blurred, to a twentieth of the blur radius. findChessboardCornersSB on reduced pictures; where that fails on pictures made
/// locally equal in mean and contrast and then saturated: a blurred checkerboard is nearly the product of two sines, and
/// its signs are a sharp checkerboard again (up to a blur radius of 0.7 squares; the contrast reverses at 0.86). Then
/// the same on pictures stretched to twice their width in four directions, against foreshortening (60 degrees).
/// Throws Refused, naming `file` and what to change.
std::vector<cv::Point2f> FindCheckerboard(const cv::Mat& grey, const Board& board, const std::string& file);

}

#endif
