// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one function of a real lens (lens/aberrations.h), fitted to rays traced through its glass.

#ifndef TILTCAL_LENS_FIT_H
#define TILTCAL_LENS_FIT_H

#include "lens/aberrations.h"
#include "prescription/bundle.h"

#include <vector>

namespace tiltcal
{

/// A lens as the camera knows it: where its pupils stand on the axis of the glass (heights as in trace.h), what it does to rays between.
struct FittedLens
{
	double entrance_pupil = 0, exit_pupil = 0;
	tilt_lens::RealLens<double> lens;
	/// Over the rays, of how far a ray lands from where it should; of all, and of each state's. mm.
	double rms_mm = 0;
	std::vector<double> state_rms_mm;
};

/// What else of the lens than the numbers c is fitted.
enum class LinearPart
{
	PARAXIAL,     ///< nothing: focal length and pupils are those near the axis
	FITTED        ///< focal length and the place of the exit pupil too, which take over a part of what is left out
};

/// Without aberrations.
FittedLens ParaxialLens(const Paraxial& paraxial);

/// Where the lens sends the object-side ray of `ray`: as an offset on the sensor from where the glass sends it, mm; x right, y up.
/// False: the map folds there.
bool Misses(const FittedLens& lens, const GlassFrame& frame, const TracedRay& ray, std::array<double, 2>& offset);

/// `terms`: 0, ThirdOrderTerms or AberrationTerms. Least squares over all states together. Throws Error (EXIT_REFUSED) where there are too
/// few rays, or the fitted lens folds within the rays.
FittedLens FitLens(const std::vector<TracedRay>& rays, const std::vector<GlassFrame>& frames, const Paraxial& paraxial, int terms, LinearPart linear);

}

#endif
