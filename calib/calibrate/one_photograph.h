// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What hangs on one photograph.

#ifndef TILTCAL_ONE_PHOTOGRAPH_H
#define TILTCAL_ONE_PHOTOGRAPH_H

#include <tiltcal/calibration.h>

#include <vector>

namespace tiltcal
{

/// The photograph of state `s` without which the answer changes most, where it changes by more than its sigmas and than it may; or that
/// there is one alone. Of the untilted state's photographs all tilts count: they share d and w with it.
std::vector<Remark> JudgeLeftOut(const Calibration& calibration, size_t s);

}

#endif
