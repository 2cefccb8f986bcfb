// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The frames and what places things in them.
// Camera: left-handed, origin in the lens centre, z forward, x right, y up, mm. Sensor plane z = -w.
// Board: left-handed, origin at the first feature, x along the columns, y up the rows, z into the board, mm.
// Picture: pixels, (0, 0) the centre of the top left one, u right, v down.

#ifndef TILTCAL_FRAMES_H
#define TILTCAL_FRAMES_H

#include "lens/vec3.h"

#include <array>

namespace tiltcal
{

using tilt_lens::Vec3;

/// cam_from_board: angle-axis rotation (radians) and translation (mm).
using Pose = std::array<double, 6>;
/// k1, k2, p1, p2, k3 of Brown-Conrady, in OpenCV's order and axes (y down).
using Distortion = std::array<double, 5>;
/// Principal point, pixels.
using Point = std::array<double, 2>;

}

#endif
