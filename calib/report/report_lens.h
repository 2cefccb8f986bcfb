// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A calibrated camera for the live sketch.

#ifndef TILTCAL_REPORT_LENS_H
#define TILTCAL_REPORT_LENS_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// JSON for PlanePart (plane_page/README.md has its keys). The world is the camera's frame, the unit mm.
std::string LensOfState(const Calibration& calibration, size_t state);

}

#endif
