// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether the untilted state is.

#ifndef TILTCAL_CHECK_UNTILTED_H
#define TILTCAL_CHECK_UNTILTED_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// The blur once more, with the untilted state's tilt free and the geometry held. Not known where the fit has no answer. And the places of
/// the edges, with that tilt free and blur aside, where they tell it.
UntiltedCheck CheckUntilted(const Calibration& calibration);

}

#endif
