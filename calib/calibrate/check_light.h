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

/// Whether more of it is seen than the lens could do, and than chance.
bool SharpeningIsSeen(const LightCheck& light);
bool BendIsSeen(const LightCheck& light);

/// Whether what is seen of sharpening and of a tone curve is enough for the photograph's misfit of blur. One of another state misses by more: by its own blur.
bool LightMayExplain(const Calibration& calibration, const PhotographCheck& photograph);

/// What it says that a user must know, with grades.
std::vector<Remark> JudgeLight(const LightCheck& light);

/// Whether the states' photographs were not developed alike: in the mean of all that may cancel.
std::vector<Remark> JudgeLightOfStates(const Calibration& calibration);

}

#endif
