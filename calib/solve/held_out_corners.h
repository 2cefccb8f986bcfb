// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_HELD_OUT_CORNERS_H
#define TILTCAL_HELD_OUT_CORNERS_H

#include "solve/solve_geometry.h"

namespace tiltcal
{

/// How well a geometry predicts corners that it was not fitted to, px: fitted to every second corner of each
/// photograph, as on a chessboard of its own, and asked for the others, and the other way round; RMS of both. Corners,
/// not photographs, because a photograph that is left out has no pose. 0: half of the corners does not determine it.
double CornersLeftOut(const Task& task, const GeometryOptions& options);

}

#endif
