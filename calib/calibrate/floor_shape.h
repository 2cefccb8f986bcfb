// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the shape of the photographs' own unsharpness leaves open.

#ifndef TILTCAL_FLOOR_SHAPE_H
#define TILTCAL_FLOOR_SHAPE_H

#include "calibrate/between_parts.h"

#include <optional>

namespace tiltcal
{

/// The part of a floor of 1 that a disc's diameter, in roots of the floor, leaves out of the measured blur's square where what is behind the floor is a Gaussian, as against
/// one that adds by squares everywhere. Domain: all; 0.29 at 0, 0 at infinity.
double GaussianFloorExcess(double diameter);

/// Whether the shape of the floor's blur moves the aperture by a visible part of its sigma; false without a floor.
bool ShapeOfFloorIsSeen(const Calibration& calibration);

/// The joint fit of `calibration` again, with blurs read as if their floor were a Gaussian's. Demosaicing, resampling and lenses blur each in their own way; measured as discs
/// they add to the disc of the lens by squares (as a peaked one does to a hundredth), or less the larger that is: a Gaussian by 0.3 of the floor, a triangle or a box by up to half as much again.
/// The photographs do not say which, so sigmas are to hold what lies between, evenly: 1/sqrt(3) of the distance. None where it does not converge. Domain: a floor above 0.
std::optional<PartAnswer> SolveWithGaussianFloor(const Calibration& calibration);

}

#endif
