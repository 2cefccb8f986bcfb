// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What hangs on one photograph.

#ifndef TILTCAL_ONE_PHOTOGRAPH_H
#define TILTCAL_ONE_PHOTOGRAPH_H

#include <tiltcal/calibration.h>

#include <vector>

namespace tiltcal
{

/// Of all boards: mean 1/z, 1/mm; what 1/U is measured by.
double MeanNearness(const Geometry& geometry);

/// The photograph of state `s` without which the answer changes most, where it changes by more than its sigmas and than it may; or that
/// there is one alone, or no answer without some. Of the untilted state's photographs all tilts count: they share d and w with it.
std::vector<Remark> JudgeLeftOut(const Calibration& calibration, size_t s);

}

#endif
