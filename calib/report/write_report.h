// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_REPORT_H
#define TILTCAL_WRITE_REPORT_H

#include <tiltcal/calibration.h>
#include "base/transfer.h"

#include <string>

namespace tiltcal
{

/// The summary that `tiltcal calibrate` prints; also report.txt.
std::string SummaryTable(const Calibration& calibration);

/// Everything into `folder`: calibration.json, camera-<state>.inc, report.txt, report.html,
/// overlay-<photo>.png, blur-<state>.png (gnuplot) with its .csv. `refinement` is --refine's, for the page. Throws FileError.
void WriteEverything(const Calibration& calibration, const Transfer& transfer, const std::string& folder, const std::string& refinement);

}

#endif
