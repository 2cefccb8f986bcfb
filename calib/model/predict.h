// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The forward model: what a camera and its boards' poses say a photograph shows.

#ifndef TILTCAL_PREDICT_H
#define TILTCAL_PREDICT_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Pixel where the geometry puts board point (column, row), in squares.
Point Reproject(const Task& task, const Geometry& geometry, size_t state, size_t photo, double column, double row);

/// The measured edge's place in camera coordinates, mm.
Vec3<double> EdgeInCamera(const Task& task, const Pose& pose, const Edge& edge);

/// Blur width (px) that the calibration's own solution gives an edge, the lens's own blur included.
double PredictedBlur(const Calibration& calibration, size_t state, size_t photo, const Edge& edge);

/// The same if the lens stood as in the state `lens`.
double PredictedBlurAs(const Calibration& calibration, size_t lens, size_t state, size_t photo, const Edge& edge);

}

#endif
