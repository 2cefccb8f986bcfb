// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_INC_H
#define TILTCAL_WRITE_INC_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// camera-<state>.inc: `#declare`s of every number of the state and the macro
/// TiltCal_<state>(Location, Look_At, Sky), a whole tilt_lens camera block in mm; and
/// the pose of every photograph, so that the board can be rendered through it.
/// Two cameras are in the file: without distortion (default), and, when the scene sets
/// TiltCal_Distortion before including it, with the lens's distortion.
std::string CameraInc(const Calibration& calibration, size_t state);

}

#endif
