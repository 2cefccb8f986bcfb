// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether the board is as it was told to be.

#ifndef TILTCAL_CHECK_BOARD_H
#define TILTCAL_CHECK_BOARD_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// The corners once more, with a board that may be wider than told and bent: four numbers. Every photograph has its own pose. Not
/// known where the fit has no answer.
BoardCheck CheckBoard(const Task& task, const Geometry& geometry);

}

#endif
