// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From a prescription to cameras: what `tiltcal lens` does, as a function.

#ifndef TILTCAL_GLASS_CAMERA_H
#define TILTCAL_GLASS_CAMERA_H

#include "prescription/rims.h"

#include <tiltcal/camera.h>

#include <string>
#include <vector>

namespace tiltcal
{

/// The glass, at its size and f-number, and what it stands before.
struct GlassTask
{
	Prescription glass;
	Sensor sensor;
	std::vector<GlassState> states;
	int terms = tilt_lens::AberrationTerms;   ///< that the cameras get: ThirdOrderTerms or all
};

struct GlassCameras
{
	GlassTask task;
	Paraxial paraxial;
	FittedLens none, six, sixteen;            ///< without aberrations, with the third order, with the fifth
	GlassRims rims;

	const FittedLens& Lens() const { return task.terms < tilt_lens::AberrationTerms ? six : sixteen; }
};

/// Traces and fits. Throws Error (EXIT_REFUSED) where the glass has no focal length, no ray comes through, or the function folds.
GlassCameras MakeGlassCameras(const GlassTask& task);

/// The camera of a state: its linear part, opening and rims; the aberrations are written beside it (camera/real_lens_words.h). lens_centre_mm is counted from
/// the entrance pupil (near the axis) of the untilted lens with the same sensor.
StateCamera CameraOfGlass(const GlassCameras& cameras, size_t state);

/// camera-<state>.inc: #declares, the camera as a macro TiltCal_<state>(Location, Look_At, Sky), and TiltCal_<state>_Body.
std::string GlassInc(const GlassCameras& cameras, size_t state);

/// What was found, a page of text.
std::string GlassReport(const GlassCameras& cameras);

}

#endif
