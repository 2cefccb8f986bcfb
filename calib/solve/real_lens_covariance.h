// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REAL_LENS_COVARIANCE_H
#define TILTCAL_REAL_LENS_COVARIANCE_H

#include "solve/real_lens_fit.h"

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Where a state's numbers begin among those of RealLensFit::Judged; those of stops follow the last state's.
int PlaceOfState(size_t state);

/// Of the lens's numbers and of where it stands, to first order, poses and rims integrated out, in the units of calibration.json; what is held is left out.
NamedCovariance CovarianceOfRealLens(const Task& task, const RealLensAnswer& answer);

}

#endif
