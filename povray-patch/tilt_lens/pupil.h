// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the unit square of the sampler to the opening of the lens.

#ifndef TILT_LENS_PUPIL_H
#define TILT_LENS_PUPIL_H

#include <cmath>

namespace tilt_lens
{

/// A point of the unit disc.
struct PupilPoint
{
	double x, y;
};

/// Square to disc, preserving area and neighbourhood: Shirley and Chiu, "A low
/// distortion map between disk and square" (1997). u, v in [0, 1]; |result| <= 1.
inline PupilPoint SquareToDisc(double u, double v)
{
	const double pi_4 = 0.78539816339744830962;
	const double a = 2.0 * u - 1.0;
	const double b = 2.0 * v - 1.0;
	double r, phi;

	if(std::fabs(a) > std::fabs(b))
	{
		r = a;
		phi = pi_4 * (b / a);
	}
	else if(b != 0.0)
	{
		r = b;
		phi = 2.0 * pi_4 - pi_4 * (a / b);
	}
	else
		return { 0.0, 0.0 };

	return { r * std::cos(phi), r * std::sin(phi) };
}

}

#endif
