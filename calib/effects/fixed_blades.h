// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_FIXED_BLADES_H
#define TILTCAL_FIXED_BLADES_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// Takes "blades=N", "blade_rotation=DEG" or "blade_curvature=C". False: it is none of these. Throws UsageError for a
/// value that no opening has.
bool TakeBlades(const std::string& text, FixedBlades& blades);

/// Throws UsageError where rotation or curvature is given without the number of blades.
void CheckBlades(const FixedBlades& blades);

/// Mean of r^2 over the opening, its corners on the unit circle: 1/2 of a whole disc.
double MeanSquareRadius(const FixedBlades& blades);

/// How much wider the circle through the corners must be for the opening to have the disc's mean of r^2, which is what
/// the blur of edges sees, averaged over their directions. At least 1.
double WideningForBlades(const FixedBlades& blades);

}

#endif
