// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CHROMATIC_FIT_H
#define TILTCAL_CHROMATIC_FIT_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Chromatic aberration of lens/chromatic.h, common to all states, from the edges' places and blur widths in red and blue
/// against green (measure_colours.h); the lens is as the calibration's solution of an exact model says. Lateral: the shift across an edge is C
/// times what a larger image about the lens axis would shift it. Axial: the plane of focus moves by A n.
/// Robust; sigmas of the fit's scatter and of leaving photographs out (jackknife) the larger one.
Chromatic EstimateChromatic(const Calibration& calibration);

}

#endif
