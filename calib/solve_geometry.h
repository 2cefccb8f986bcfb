// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SOLVE_GEOMETRY_H
#define TILTCAL_SOLVE_GEOMETRY_H

#include "calibration.h"

namespace tiltcal
{

/// Least squares of the reprojection over all photographs of all states: common image
/// distance, common distortion (when `with_distortion`) centred on each state's own
/// principal point, a pose per photograph. A tilted lens turns about a pivot away from
/// its pupil, so neither the principal point nor the pose is shared between states.
/// Starts from cv::calibrateCamera. A principal point that the photographs do not
/// determine (sigma above 2 % of the picture's width) stays at the picture's centre.
/// Throws Refused when w is not determined, naming what to photograph.
Geometry SolveGeometry(const Task& task, bool with_distortion);

/// Pixel where the geometry puts board point (column, row), in squares.
Point Reproject(const Task& task, const Geometry& geometry, size_t state, size_t photo, double column, double row);

/// The measured edge's place in camera coordinates, mm.
Vec3<double> EdgeInCamera(const Task& task, const Pose& pose, const Edge& edge);

}

#endif
