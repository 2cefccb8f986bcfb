// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is told of a lens's vignetting by evenly bright patches: the board's white, or photographs of a plain surface.

#ifndef TILTCAL_VIGNETTING_H
#define TILTCAL_VIGNETTING_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Fits the brightness of task.flat_fields, where there are any, else of the photographs' white patches (falloff_fit.h), as
/// nothing, the natural fall-off, a rim (common to all states) and both; the lens is as the calibration's solution of an exact model
/// says. Every photograph has its own exposure. Boards have a gradient of their lighting too, those that stand in one
/// pose in all states a common one; flat fields are lit evenly.
/// Sigmas: of the fit's covariance and of leaving photographs out (jackknife) the larger one.
/// `failure` is filled in where there is too little to see.
Vignetting EstimateVignetting(const Calibration& calibration);

/// To the sigmas of all rims, and of what the effects say of them, that of the opening, mm, in units of which light shows them. Once, when that is told.
void WidenRimsByOpening(const Estimate& aperture, Calibration& told);

}

#endif
