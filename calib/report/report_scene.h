// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REPORT_SCENE_H
#define TILTCAL_REPORT_SCENE_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// The sketch of one state as inline SVG: side view along the hinge, oblique view, and the camera alone, enlarged.
/// All orthographic and to scale. The side view is a group of class "side" with data-px-per-mm, data-axis-x and
/// data-axis-y, the lens centre's place in the picture: depth z goes right, tilt_up (scene_parts.h) goes up.
std::string SceneSvg(const Calibration& calibration, size_t state);

}

#endif
