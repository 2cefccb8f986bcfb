// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A ray on its way from its pixel through the lens into the scene, and the steps that it
// takes there. Which steps a lens has is settled once, when it is resolved: an effect that
// a scene does not name has no step (effects.cpp). Free of POV-Ray.

#ifndef TILT_LENS_LENS_RAY_H
#define TILT_LENS_LENS_RAY_H

#include "lens/chromatic.h"
#include "lens/pupil.h"
#include "lens/vec3.h"

namespace tilt_lens
{

struct TiltLens;

/// World vectors; of directions the length is the pinhole direction's, w |v|.
struct LensRay
{
	Vec3<double> pixel;         ///< direction of the pixel, as the sensor sees it
	Vec3<double> v;             ///< direction in the scene, which effects may turn
	double lens_u, lens_v;      ///< the sample of the lens, in the unit square
	int wavelength;             ///< Wavelength that is traced; green stands for all
	PupilPoint point;           ///< on the lens, which is the unit disc
	Vec3<double> S;             ///< the same from the lens centre
	double kappa;               ///< inverse focus distance
	Vec3<double> R;             ///< direction in which the ray leaves S
	double weight;              ///< how much of its light arrives; 0: none
};

typedef void (*LensStep)(const TiltLens& lens, LensRay& ray);

/// Upper bound of a lens's steps.
const int MostLensSteps = 20;

}

#endif
