// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What an effect must fulfil to be rendered. Free of POV-Ray.

#ifndef TILT_LENS_CHECK_EFFECTS_H
#define TILT_LENS_CHECK_EFFECTS_H

#include <algorithm>

#include "lens/lens_spec.h"
#include "lens/pupil_magnification.h"
#include "lens/ray_range.h"
#include "lens/refusal.h"

namespace tilt_lens
{

/// Refuses numbers that no lens has.
inline void CheckEffectWords(const LensSpec& spec)
{
	if(!IsFinite(spec.field_curvature.value))
		Refuse("tilt_lens: field_curvature is not a finite number.");
	for(int i = 0; i < DistortionTerms; i++)
		if(!IsFinite(spec.distortion[i]))
			Refuse("tilt_lens: distortion is not a finite number.");
	const double count = spec.blades.value;
	if(spec.blades && !(count >= FewestBlades && count <= MostBlades && count == std::floor(count)))
		Refuse("tilt_lens: blades must be a whole number from %d to %d, but is %g.", FewestBlades, MostBlades, count);
	if(!IsFinite(spec.blade_rotation.value))
		Refuse("tilt_lens: the rotation of blades is not a finite number.");
	if(!(spec.blade_curvature.value >= 0.0 && spec.blade_curvature.value <= 1.0))
		Refuse("tilt_lens: the curvature of blades must lie between 0 (straight) and 1 (a circle), but is %g.", spec.blade_curvature.value);
	for(int i = 0; i < spec.rim_count; i++)
		if(!(spec.rims[i].radius > 0.0 && IsFinite(spec.rims[i].radius) && IsFinite(spec.rims[i].distance)))
			Refuse("tilt_lens: a rim of vignetting optical must have a radius greater than 0 and a finite distance before the lens, but has %g and %g.",
			       spec.rims[i].radius, spec.rims[i].distance);
	if(spec.pupil_magnification && !(spec.pupil_magnification.value > 0.01 && spec.pupil_magnification.value < 100.0))
		Refuse("tilt_lens: pupil_magnification must lie between 0.01 and 100 (1.0 where both pupils are as large), but is %g.", spec.pupil_magnification.value);
	for(int i = 0; i < Wavelengths; i++)
	{
		if(!(std::fabs(spec.lateral[i]) < 0.5))
			Refuse("tilt_lens: chromatic lateral must lie between -0.5 and 0.5 (0.001 is much for a real lens), but is %g.", spec.lateral[i]);
		if(!IsFinite(spec.axial[i]))
			Refuse("tilt_lens: chromatic axial is not a finite number.");
	}
}

/// Refuses a distortion that folds within the frame, seen at 33 x 33 points of it
/// and half a percent beyond, where anti-aliasing may ask.
inline void CheckDistortion(const TiltLens& lens, const CameraVectors& camera)
{
	// The colour whose image is the smallest is looked at the farthest out.
	const double magnified = 1.0 + std::min(0.0, std::min(lens.lateral[RedWavelength], lens.lateral[BlueWavelength]));
	for(int i = 0; i <= 32; i++)
		for(int j = 0; j <= 32; j++)
		{
			const double x = 1.01 * (i / 32.0 - 0.5), y = 1.01 * (j / 32.0 - 0.5);
			const Vec3d pixel = DirectionFromExitPupil(lens.axis, lens.pupil_magnification, lens.direction + x * camera.right + y * camera.up);
			const Vec3d v = DirectionBeforePupils(lens.normal, lens.pupil_magnification, pixel);
			const double depth = Dot(v, lens.normal) * magnified;
			if(depth > 0.0 && !IsInvertible(lens.distortion, Dot(v, lens.basis_x) / depth, -Dot(v, lens.basis_y) / depth))
				Refuse("tilt_lens: the distortion folds inside the frame: no ideal point is imaged %.0f%% right and "
				       "%.0f%% up of the centre. Use smaller coefficients or a narrower view.", 200.0 * x, 200.0 * y);
		}
}

/// Refuses light relative to that on a lens axis which is parallel to the sensor.
inline void CheckFalloff(const TiltLens& lens)
{
	if(lens.natural_vignetting && !(Dot(lens.normal, lens.axis) > 1e-6))
		Refuse("tilt_lens: vignetting natural is relative to the light where the lens's axis meets the sensor, and this lens is tilted by 90 degrees.");
}

/// Refuses a rim beyond the sensor, which would cut nothing of its light.
inline void CheckRims(const TiltLens& lens)
{
	const double sensor = lens.pupil_magnification * lens.image_distance;
	for(int i = 0; i < lens.rim_count; i++)
		// Room for the rounding of a distance that was to be the sensor's.
		if(!(lens.rims[i].distance >= -sensor * (1.0 + 1e-9)))
			Refuse("tilt_lens: a rim of vignetting optical lies %g behind the lens, beyond the sensor, which is %g behind it.",
			       -lens.rims[i].distance, sensor);
}

/// Refuses a bowl that is too deep for numbers, or colours too far apart. At the rim of what the
/// lens sees, where v.n is but the rounding of |v|, kappa is larger than on the axis by C |v| / 1e-16.
inline void CheckFocus(const TiltLens& lens, const CameraVectors& camera)
{
	const double v = ScaledLength(lens.direction) + ScaledLength(camera.right) + ScaledLength(camera.up);
	if(!(std::fabs(lens.field_curvature) * 1e17 * v * (1.0 + lens.aperture_diameter) < LongestRay))
		Refuse("tilt_lens: field_curvature %g is too large to compute with.", lens.field_curvature);
	for(int i = 0; i < Wavelengths; i++)
		if(!(std::fabs(lens.axial[i]) * v * (1.0 + lens.aperture_diameter) < LongestRay))
			Refuse("tilt_lens: chromatic axial %g is too large to compute with.", lens.axial[i]);
}

}

#endif
