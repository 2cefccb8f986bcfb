// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether a thin lens leaves over more than noise.

#ifndef TILTCAL_LEFT_OVER_H
#define TILTCAL_LEFT_OVER_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// A misfit is noise up to so much of it.
constexpr double MOST_OF_NOISE = 3;

/// Of one edge's blur, px, the middle one of all; infinite without edges.
double NoiseOfBlur(const Task& task);

/// Of one corner, px, of both its coordinates as Geometry::rms is; the middle one of all, infinite without corners.
double NoiseOfPlaces(const Task& task);

/// The thin lens puts corners worse than their noise alone would make it; it does, or so fits blur.
bool PlacesAreLeftOver(const Calibration& calibration);
bool MoreThanNoiseIsLeftOver(const Calibration& calibration);

}

#endif
