// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_DIFFERENCE_H
#define TILTCAL_POSE_DIFFERENCE_H

#include <tiltcal/frames.h>

namespace tiltcal
{

/// From one camera_from_board to another: the difference of their rotation vectors, rad, as sigmas of poses are of their components, and of the
/// translations, mm. Of the vectors that turn as the second does, a whole turn apart, the one nearest the first, for they jump at half a turn.
Pose FromPoseTo(const Pose& from, const Pose& to);

}

#endif
