// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_WEIGHTS_H
#define TILTCAL_POSE_WEIGHTS_H

#include "camera/pose.h"

namespace tiltcal
{

/// Width of the camera's blur disc of a point of the world, px: BlurWidth.
double BlurAt(const StateCamera& camera, const CameraPose& pose, double unit_mm, const Vec3<double>& world);

/// Sets PosePoint::sigma, over a sharp point's: blurred crossings are measured worse, by how much their own scatter says. Of the variance a^2 + (c b)^2
/// of a point whose blur disc is b px wide (the camera's, at `pose`), c/a is the likeliest by the residuals. The same for all where the camera knows
/// no aperture, and for fewer than 12 points, from which that is not told.
void WeighByBlur(const StateCamera& camera, const CameraPose& pose, double unit_mm, std::vector<PosePoint>& points);

}

#endif
