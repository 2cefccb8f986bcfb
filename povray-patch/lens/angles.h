// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pi, and degrees.

#ifndef TILT_LENS_ANGLES_H
#define TILT_LENS_ANGLES_H

namespace tilt_lens
{

constexpr double PI = 3.14159265358979323846;
constexpr double RADIANS_PER_DEGREE = PI / 180;
constexpr double DEGREES_PER_RADIAN = 180 / PI;

}

#endif
