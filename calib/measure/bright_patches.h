// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How bright a photograph is where what it shows is evenly bright: what vignetting is told by.

#ifndef TILTCAL_BRIGHT_PATCHES_H
#define TILTCAL_BRIGHT_PATCHES_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

/// Fills photo.white and photo.white_saturated: the interiors of the board's white squares, the outermost included, as
/// far as no edge's blur reaches, but those that are clipped (measure/clipped.h). Grids of circles have none.
/// `linear`: CV_32FC1 or CV_32FC3; `photo` has its corners and edges.
void MeasureWhite(const cv::Mat& linear, const Board& board, Photo& photo);

/// A photograph of an evenly lit plain surface in whole cells of 1/40 of its width, from the top left. Clipped cells are left
/// out. Throws Refused when those are most of them, or when the picture is dark, which only one with a full scale can be:
/// not in `floating_point`. `file` is named.
std::vector<BrightPatch> MeasureFlatField(const cv::Mat& linear, const std::string& file, bool floating_point = false);

}

#endif
