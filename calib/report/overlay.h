// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_OVERLAY_H
#define TILTCAL_OVERLAY_H

#include <tiltcal/calibration.h>

#include <opencv2/core.hpp>

namespace tiltcal
{

/// The photograph (grey: linear, or ToDisplay of that) with detected corners (crosses), reprojected corners
/// (with the error drawn ten times as long), and for every edge its measured blur disc
/// (filled ring) and the predicted one (thin ring). Rings are coloured by the sign of the
/// difference. 8-bit BGR at the photograph's size, a legend in a strip below.
cv::Mat DrawOverlay(const cv::Mat& grey, const Calibration& calibration, size_t state, size_t photo);

/// What was measured in a photograph: corners (crosses), edges (the portion fitted, and its direction) and their blur discs.
/// 8-bit BGR at the photograph's size, in a strip below the blur in terms of squares.
cv::Mat DrawMeasured(const cv::Mat& grey, const Photo& photo);

}

#endif
