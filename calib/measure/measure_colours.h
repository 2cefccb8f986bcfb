// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_COLOURS_H
#define TILTCAL_MEASURE_COLOURS_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Fits some edges of a checkerboard, spread evenly over it, in each colour channel by itself: photo.coloured and photo.colours.
/// `linear`: CV_32FC1 (nothing to do) or CV_32FC3, blue first; `photo` has its corners and edges. Colour pictures whose channels
/// are equal are grey ones. JPEG files with subsampled colour have no edges in colour: what they show of a shift is a third.
void MeasureColours(const cv::Mat& linear, const Board& board, Photo& photo);

}

#endif
