// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the unit square of the sampler to the opening of the lens.

#ifndef TILT_LENS_PUPIL_H
#define TILT_LENS_PUPIL_H

#include <cmath>

#include "lens/angles.h"

namespace tilt_lens
{

/// A point of the unit disc.
struct PupilPoint
{
	double x, y;
};

/// Sine and cosine of |x| <= pi/4, to the last bit but one: polynomials of FDLIBM's k_sin
/// and k_cos. The library's own take three times as long, and differ from machine to machine.
inline void SineAndCosine(double x, double& sine, double& cosine)
{
	const double z = x * x;
	sine = x + x * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 +
	       z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
	cosine = 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 +
	         z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)))));
}

/// Square to disc, preserving area and neighbourhood: Shirley and Chiu, "A low
/// distortion map between disk and square" (1997). u, v in [0, 1]; |result| <= 1.
inline PupilPoint SquareToDisc(double u, double v)
{
	const double pi_4 = 0.25 * Pi;
	const double a = 2.0 * u - 1.0;
	const double b = 2.0 * v - 1.0;
	double sine, cosine;

	if(std::fabs(a) > std::fabs(b))
	{
		SineAndCosine(pi_4 * (b / a), sine, cosine);
		return { a * cosine, a * sine };
	}
	if(b == 0.0)
		return { 0.0, 0.0 };
	SineAndCosine(pi_4 * (a / b), sine, cosine);
	return { b * sine, b * cosine };
}

}

#endif
