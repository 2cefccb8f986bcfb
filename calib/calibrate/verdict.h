// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How far a calibration can be trusted, in words.

#ifndef TILTCAL_VERDICT_H
#define TILTCAL_VERDICT_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Judges: sigmas of w and of every tilt; how much one photograph decides; whether both sides of the plane of focus are
/// seen; photographs that stand out or are there twice; the board's shape; a tilt of the untilted state; correlations; what blur and geometry say apart; whether noise or the lens's aberrations limit the result. Of the paper's
/// model: nothing.
Verdict Judge(const Calibration& calibration);

}

#endif
