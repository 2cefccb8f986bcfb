// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Points of the opening that stand for all of its light, and what rims leave of them.

#ifndef TILTCAL_OPENING_POINTS_H
#define TILTCAL_OPENING_POINTS_H

#include "lens/aberrations.h"
#include "lens/optical_vignetting.h"

#include <vector>

namespace tiltcal
{

/// In radii of the opening, and the point's share of the light.
struct OpeningPoint
{
	double x, y, weight;
};

/// Two rings with Gauss's radii and an odd number of points each, so that even functions along any direction see twice as many; the weights' sum is 1.
const std::vector<OpeningPoint>& OpeningPoints();

/// A ray from the opening's point (x, y), exit pupil, to a place of the picture; mm, the frame of lens/aberrations.h.
struct OpeningView
{
	tilt_lens::RealLens<double> lens;
	double radius;          ///< of the opening, exit pupil
	double X, Y, depth;     ///< the place: behind the exit pupil
};

/// OpeningPoints, each moved and lightened by what rims leave of its part of the opening; rims as in lens/optical_vignetting.h: before the entrance
/// pupil, or behind the exit pupil. All weights 1 in sum again; the whole opening where the rims leave nothing.
std::vector<OpeningPoint> OpeningThroughRims(const OpeningView& view, const std::vector<tilt_lens::Rim>& rims);

}

#endif
