// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_ALL_H
#define TILTCAL_MEASURE_ALL_H

#include <tiltcal/calibrate.h>

#include <opencv2/core.hpp>

#include <functional>

namespace tiltcal
{

/// Photograph `number` of all, counted from 0: its brightness in linear light (CV_32F), as it was measured. Called from any thread and
/// in any order.
using SeePicture = std::function<void(size_t number, const cv::Mat& grey)>;

/// MeasureAll, which shows every photograph when it is measured, so that nobody reads it again. `see` may be empty.
Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm, const MeasureOptions& options, const SeePicture& see);

}

#endif
