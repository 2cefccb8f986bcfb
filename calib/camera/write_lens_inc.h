// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_LENS_INC_H
#define TILTCAL_WRITE_LENS_INC_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// The part of camera-<state>.inc that shows the state through the real lens: its numbers, the photographs' poses and the macros of the thin lens's part.
/// `calibration.real_lens` has an answer.
std::string RealLensPart(const Calibration& calibration, size_t state);

}

#endif
