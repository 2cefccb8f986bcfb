// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef CALIBRATOR_REPORT_H
#define CALIBRATOR_REPORT_H

#include "calibrator_statistics.h"

namespace calibrator_cost
{

/// calibrator-cost.csv, calibrator-cost.html (a fragment) and calibrator-cost.svg in `folder`; each
/// whole or not at all. Throws tiltcal::Error; without gnuplot the plot is left out, with a warning.
void WriteReport(const std::vector<Row>& rows, const std::string& folder);

}

#endif
