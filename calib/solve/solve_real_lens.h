// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SOLVE_REAL_LENS_H
#define TILTCAL_SOLVE_REAL_LENS_H

#include <tiltcal/calibration.h>

#include "lens/optical_vignetting.h"

#include <vector>

namespace tiltcal
{

/// One real lens for all states, from the thin lens on; `rims`: what vignettes. Where there is no answer, its failure says so.
RealLens FindRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims);

}

#endif
