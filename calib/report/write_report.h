// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_REPORT_H
#define TILTCAL_WRITE_REPORT_H

#include <tiltcal/calibration.h>

#include "report/report_html.h"

#include <functional>

#include <string>

namespace tiltcal
{

/// The summary that `tiltcal calibrate` prints; also report.txt.
std::string SummaryTable(const Calibration& calibration);

/// A photograph as it was measured, for DrawOverlay.
using ReadGrey = std::function<cv::Mat(size_t state, size_t photo)>;

/// Everything into `folder`: calibration.json, camera-<state>.inc, report.txt, report.html,
/// overlay-<photo>.png, blur-<state>.png (gnuplot) with its .csv. Throws FileError.
void WriteEverything(const Calibration& calibration, const RunNotes& notes, const ReadGrey& read, const std::string& folder);

}

#endif
