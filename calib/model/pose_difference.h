// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_DIFFERENCE_H
#define TILTCAL_POSE_DIFFERENCE_H

#include <tiltcal/frames.h>

namespace tiltcal
{

/// From one camera_from_board to another: the rotation vector, camera frame, by which the second is turned against the first, and the difference
/// of the translations, mm. Rotation vectors themselves jump at half a turn.
Pose FromPoseTo(const Pose& from, const Pose& to);

}

#endif
