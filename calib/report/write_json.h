// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_JSON_H
#define TILTCAL_WRITE_JSON_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// calibration.json. Frames: camera.h, X_camera = rotation
/// X_board + translation_mm. Beside every estimate its standard deviation, `_sigma`
/// before the unit. "comparison": the paper's model on the same photographs. "render": the
/// distortion-free camera of the .inc. An infinite number is written as null.
std::string CalibrationJson(const Calibration& calibration);

}

#endif
