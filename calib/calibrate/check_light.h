// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a camera does to light before it writes a file biases blur, and the lens with it: clipped whites, sharpening, a tone
// curve. What of this a calibration itself shows.

#ifndef TILTCAL_CHECK_LIGHT_H
#define TILTCAL_CHECK_LIGHT_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Of a solved calibration by an exact model. `sharpening` is NaN where nothing is sharp.
LightCheck CheckLight(const Calibration& calibration);

/// What it says that a user must know, with grades.
std::vector<Remark> JudgeLight(const LightCheck& light);

}

#endif
