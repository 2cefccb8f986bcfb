// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The distortion taken out of photographs, and put into pictures.

#ifndef TILTCAL_UNDISTORT_H
#define TILTCAL_UNDISTORT_H

#include "exchange/flat_view.h"

#include "base/file_set.h"

#include <tiltcal/transfer.h>

#include <string>

namespace tiltcal
{

enum class Direction
{
	UNDISTORT,
	REDISTORT
};

/// One map for many pictures.
class Resampling
{
public:
	/// UNDISTORT: photographs to the flat view with these margins; REDISTORT: back.
	Resampling(const StateCamera& camera, const Margins& margins, Direction direction);

	/// `linear` (CV_32FC1 or CV_32FC3), as large as what is resampled, in linear light, by cubic convolution with a = -1/2 (Keys 1981), its
	/// undershoot cut off at 0. Less than a pixel beyond the picture its edge is repeated, then it is black. Throws Refused: of another
	/// size (`file` is named).
	cv::Mat Of(const cv::Mat& linear, const std::string& file) const;

private:
	cv::Mat map;
	cv::Size from;
	std::string expected;
};

/// The share of the pixels that have a channel above 1, which PNG cannot hold.
double BrighterThanWhite(const cv::Mat& linear);

/// `linear` as a PNG of 16 bits with the transfer curve of `transfer`, or as OpenEXR of 32 bit floats, by the suffix of `file`. Throws
/// UsageError for another suffix.
void WriteLinear(const cv::Mat& linear, const Transfer& transfer, const std::string& file, FileSet& set);

}

#endif
