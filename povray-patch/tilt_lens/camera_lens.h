// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The tilt_lens part of POV-Ray's Camera: what the scene said, and the lens that
// the parser resolved from it. Copied with the camera.

#ifndef TILT_LENS_CAMERA_LENS_H
#define TILT_LENS_CAMERA_LENS_H

#include "backend/tilt_lens/lens_spec.h"

namespace tilt_lens
{

struct CameraLens
{
	LensSpec spec;
	TiltLens lens;

	/// Rays leave from many points of the lens (and cover the pixel's area), not from one.
	bool Samples_Lens() const { return spec.enabled && !lens.IsPinhole(); }
};

}

#endif
