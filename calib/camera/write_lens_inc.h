// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_LENS_INC_H
#define TILTCAL_WRITE_LENS_INC_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// lens-<state>.inc: the state through the real lens, with the macros and names of camera-<state>.inc, in whose place a scene includes it.
/// `calibration.real_lens` has an answer.
std::string LensInc(const Calibration& calibration, size_t state);

}

#endif
