// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Starts for the blur fit. |1 - q.P| hides the sign of the blur, so the fit has many
// minima: nothing about focus, tilt or direction is assumed, everything is tried.

#ifndef TILTCAL_SEARCH_FOCUS_H
#define TILTCAL_SEARCH_FOCUS_H

#include "solve/blur_fit.h"

namespace tiltcal
{

// Both hold the field curvature of x.

/// Fits d, floor and the untilted state of x, from both sides of every possible focus.
/// Throws Refused when two focus distances explain the blur equally well.
void SearchUntilted(const BlurFit& fit, const Task& task, const Geometry& geometry, Unknowns& x);

/// Fits the numbers of one tilted state of x, from every direction, tilts up to a plane of
/// focus along the axis, and the mirror images of the best in the boards. Two answers of
/// the same quality: PLANE takes the one that keeps the focal length, if only one does,
/// and returns true; otherwise, and in RIGID, which keeps it anyway, throws Refused.
bool SearchTilted(const BlurFit& fit, const Task& task, const Geometry& geometry, size_t state, Unknowns& x);

}

#endif
