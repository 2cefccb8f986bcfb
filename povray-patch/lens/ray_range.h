// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether the rays of a lens are numbers that POV-Ray can trace. Free of POV-Ray.

#ifndef TILT_LENS_RAY_RANGE_H
#define TILT_LENS_RAY_RANGE_H

#include <algorithm>

#include "lens/lens_spec.h"
#include "lens/optics.h"

namespace tilt_lens
{

/// POV-Ray divides a direction by the root of its sum of squares, which overflows
/// above the second and vanishes below the first.
const double ShortestRay = 1e-150;
const double LongestRay = 1e150;

/// An upper bound of the largest component of any ray direction w R, HUGE_VAL where
/// it is not even finite. R is linear in the pixel and in the lens point, so the
/// corners of the picture and of the square around the opening bound it.
inline double LongestDirection(const TiltLens& lens, const CameraVectors& camera)
{
	double longest = 0.0;
	for(int corner = 0; corner < 16; corner++)
	{
		const double x = corner & 1 ? 0.5 : -0.5, y = corner & 2 ? 0.5 : -0.5;
		const double a = corner & 4 ? 1.0 : -1.0, b = corner & 8 ? 1.0 : -1.0;
		const Vec3d v = lens.direction + x * camera.right + y * camera.up;
		const Vec3d R = RayDirection(v, a * lens.lens_x + b * lens.lens_y, Dot(lens.inverse_focus, v));
		// Component by component: a maximum may drop what is not a number.
		if(!std::isfinite(R.x) || !std::isfinite(R.y) || !std::isfinite(R.z))
			return HUGE_VAL;
		longest = std::max(longest, MaxAbs(R));
	}
	return longest;
}

/// A lower bound of the length of any pixel's pinhole direction: all end in one plane.
inline double ShortestDirection(const TiltLens& lens)
{
	return Dot(lens.direction, lens.axis);
}

}

#endif
