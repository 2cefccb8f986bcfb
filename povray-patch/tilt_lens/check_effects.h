// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What an effect must fulfil to be rendered, once the lens is known. Free of POV-Ray.

#ifndef TILT_LENS_CHECK_EFFECTS_H
#define TILT_LENS_CHECK_EFFECTS_H

#include "lens_spec.h"
#include "ray_range.h"
#include "refusal.h"

namespace tilt_lens
{

/// Refuses a distortion that folds within the frame, seen at 33 x 33 points of it
/// and half a percent beyond, where anti-aliasing may ask.
inline void CheckDistortion(const TiltLens& lens, const CameraVectors& camera)
{
	for(int i = 0; i < DistortionTerms; i++)
		if(!IsFinite(lens.distortion[i]))
			Refuse("tilt_lens: distortion is not a finite number.");
	for(int i = 0; i <= 32; i++)
		for(int j = 0; j <= 32; j++)
		{
			const double x = 1.01 * (i / 32.0 - 0.5), y = 1.01 * (j / 32.0 - 0.5);
			const Vec3d v = lens.direction + x * camera.right + y * camera.up;
			const double depth = Dot(v, lens.normal);
			if(depth > 0.0 && !IsInvertible(lens.distortion, Dot(v, lens.basis_x) / depth, -Dot(v, lens.basis_y) / depth))
				Refuse("tilt_lens: the distortion folds inside the frame: no ideal point is imaged %.0f%% right and "
				       "%.0f%% up of the centre. Use smaller coefficients or a narrower view.", 200.0 * x, 200.0 * y);
		}
}

/// Refuses a bowl that is too deep for numbers. At the rim of what the lens sees, where
/// v.n is but the rounding of |v|, kappa is larger than on the axis by C |v| / 1e-16.
inline void CheckFieldCurvature(const TiltLens& lens, const CameraVectors& camera)
{
	const double v = ScaledLength(lens.direction) + ScaledLength(camera.right) + ScaledLength(camera.up);
	if(!(std::fabs(lens.field_curvature) * 1e17 * v * (1.0 + lens.aperture_diameter) < LongestRay))
		Refuse("tilt_lens: field_curvature %g is too large to compute with.", lens.field_curvature);
}

}

#endif
