// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What more is done with the covariance of a fit: the size of the board, and its table for calibration.json.

#ifndef TILTCAL_NAMED_COVARIANCE_H
#define TILTCAL_NAMED_COVARIANCE_H

#include "solve/blur_fit.h"

namespace tiltcal
{

/// Of d, C and the planes of focus also what the board's size adds, `relative` its own sigma. All that lies before the lens grows with
/// the board, poses, d and 1/q, and the pictures stay the same; w is told in pixels, and stays.
LensCovariance WithBoardSize(const LensCovariance& covariance, const Unknowns& x, const std::vector<Vec3<double>>& planes, double relative);

/// By the names of calibration.json; numbers that were held are left out.
NamedCovariance Named(const LensCovariance& covariance, const Task& task);

}

#endif
