// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The tilt_lens part of POV-Ray's Camera: what the scene said, and the lens that
// the parser resolved from it. Copied with the camera.

#ifndef TILT_LENS_CAMERA_LENS_H
#define TILT_LENS_CAMERA_LENS_H

#include <vector>

#include "backend/tilt_lens/lens_spec.h"

namespace tilt_lens
{

/// A number of samples at which a pixel may stop, and the variance of its mean
/// below which it does.
struct SampleLevel
{
	int samples;
	double stop_below;
};

struct CameraLens
{
	LensSpec spec;
	TiltLens lens;
	std::vector<SampleLevel> levels;    ///< increasing; the last one always stops

	/// Rays leave from many points of the lens (and cover the pixel's area), not from one.
	bool Samples_Lens() const { return spec.enabled && !Shows() && !lens.IsPinhole(); }
	/// The preview of focus is asked for instead of the picture.
	bool Shows() const { return spec.show_focus || spec.show_plane; }
};

}

#endif
