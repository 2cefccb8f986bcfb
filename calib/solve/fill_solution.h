// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_FILL_SOLUTION_H
#define TILTCAL_FILL_SOLUTION_H

#include "solve/blur_fit.h"

#include <Eigen/Core>

namespace tiltcal
{

/// The numbers that people read, of a fit's unknowns; w is `geometry`'s.
void FillSolution(const Task& task, const Geometry& geometry, const BlurFit& fit, const Unknowns& x, const LensCovariance& covariance, Solution& out);

/// Every sigma becomes the larger of its own and the one by photographs, and NamedCovariance receives those.
void WidenSigmas(const Solution& by_photographs, Solution& out);
void WidenSigmas(const StateLens& by_photographs, StateLens& out);

/// Throws Refused where aperture, focus or a tilt are not determined, saying what to photograph.
void RefuseUndetermined(const Task& task, const BlurFit& fit, const Solution& solution);

}

#endif
