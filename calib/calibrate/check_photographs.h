// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which photographs do not belong to the rest.

#ifndef TILTCAL_CHECK_PHOTOGRAPHS_H
#define TILTCAL_CHECK_PHOTOGRAPHS_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Every photograph held against the others, state by state: how corners and blur fit, whether another state's plane of focus explains
/// its blur better, and whether it was measured like another, noise and all.
std::vector<PhotographCheck> CheckPhotographs(const Calibration& calibration);

/// Of these, those whose blur `lens` explains as it does the others' do not stand out by it: aberrations show most where blur is largest.
void ClearByRealLens(const RealLens& lens, std::vector<PhotographCheck>& photographs);

}

#endif
