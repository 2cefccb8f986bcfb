// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where in the picture the time goes, for those who render it in strips.

#ifndef TILTCOST_ROWS_H
#define TILTCOST_ROWS_H

#include "tiltcost/pilot_run.h"
#include "tiltcost/prediction.h"

#include <string>
#include <vector>

namespace tiltcost
{

/// CPU seconds that tracing each row of a picture of width x height takes, from the top. Between
/// blocks of the pilot: the mean of the nearest four, weighted by inverse squared distances.
std::vector<double> RowSeconds(const std::vector<BlockCost>& blocks, int width, int height);

/// The same as JSON, with what cutting the picture needs besides: seconds before the first ray, and
/// how many rows beyond its own a strip traces.
std::string RowsText(const PilotRun& run, const Pilot& pilot, const Setting& setting);

}

#endif
