// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_FIND_CROSSING_H
#define TILTCAL_FIND_CROSSING_H

#include <opencv2/core.hpp>

#include <optional>

namespace tiltcal
{

/// The crossing of two edges (as of a checkerboard's squares) nearest to `start`, px: cv::cornerSubPix in a window of
/// 2 half + 1 pixels, which is not moved by a blur that is the same all round. `grey`: CV_32FC1, display-encoded, 0..1.
/// Empty where there is no such crossing: it would lie more than `reach` pixels away or outside the picture, or around it
/// the brightness does not change to and fro twice (an edge, a corner of one box, plain paper, noise).
std::optional<cv::Point2d> FindCrossing(const cv::Mat& grey, const cv::Point2d& start, int half, double reach);

}

#endif
