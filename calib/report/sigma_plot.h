// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SIGMA_PLOT_H
#define TILTCAL_SIGMA_PLOT_H

#include "report/report_next.h"

#include <string>
#include <vector>

namespace tiltcal
{

/// SVG: sigma over what is wanted, logarithmic, against the number of photographs; a line a number.
std::string SigmaPlot(const std::vector<SigmasOfMany>& history);

}

#endif
