// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REPORT_MAPS_H
#define TILTCAL_REPORT_MAPS_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// The residuals of one state as inline SVG. Colours of photographs as html::PhotoColour.

/// The light that every white patch of a state has left over the angle from the lens axis, and what the model says of it (FalloffOf).
/// Empty where there is none.
std::string FalloffPlot(const Calibration& calibration, size_t state);

/// Blur width of every edge: measured over predicted, and below it the difference; px.
std::string BlurPlot(const Calibration& calibration, size_t state);

/// Reprojected minus measured place of every corner, an arrow where it is in the picture, magnified by a factor that is stated.
std::string CornerMap(const Calibration& calibration, size_t state);

/// Measured minus predicted blur of every edge where it is in the picture, a stroke along the edge: blue less, red more.
/// Only edges that run across the radius from the principal point (those that see the tangential focus), or only the others.
/// The colours mean the same in both.
std::string BlurMap(const Calibration& calibration, size_t state, bool across_radius);

}

#endif
