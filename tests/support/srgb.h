// SPDX-License-Identifier: AGPL-3.0-or-later
//
// sRGB as IEC 61966-2-1 has it. Shares nothing with the calibrator's.

#ifndef TILT_LENS_TESTS_SRGB_H
#define TILT_LENS_TESTS_SRGB_H

#include <algorithm>
#include <cmath>

/// Linear light, cut to 0..1, to a code of 0..1.
inline double SrgbCode(double light)
{
	const double v = std::clamp(light, 0.0, 1.0);
	return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// What is left of linear light in a file of 8 bits.
inline float ThroughSrgb(double light)
{
	const double rounded = std::round(SrgbCode(light) * 255) / 255;
	return float(rounded <= 0.04045 ? rounded / 12.92 : std::pow((rounded + 0.055) / 1.055, 2.4));
}

#endif
