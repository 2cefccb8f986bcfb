// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The aberrations of a lens, from the words of the scene: their scale, what is refused, and where
// a pixel is in focus with them. Free of POV-Ray.

#ifndef TILT_LENS_ABERRATED_LENS_H
#define TILT_LENS_ABERRATED_LENS_H

#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Takes the words into a lens whose opening and focal length are known. Throws Refusal.
void TakeAberrations(const LensSpec& spec, TiltLens& lens);

/// Refuses aberrations that fold inside the frame or make rays that are no numbers, for a lens whose
/// steps are settled, and finds how far from the opening's centre rays leave.
void CheckAberrations(const CameraVectors& camera, TiltLens& lens);

/// Whether a ray through the middle of the opening is moved too.
bool AberratesPinholeRays(const TiltLens& lens);

/// The steps that aberrate, with the third order alone, which is quicker, and with the fifth too.
void AberrateThirdOrder(const TiltLens& lens, LensRay& ray);
void AberrateFifthOrder(const TiltLens& lens, LensRay& ray);

/// Inverse focus distance, along the lens's axis, of the pixel with the direction v: of the rays next to the
/// middle of the opening, the mean of what edges along and across the radius see. For any lens.
double InverseFocusAlongLensAxis(const TiltLens& lens, const Vec3d& v);

}

#endif
