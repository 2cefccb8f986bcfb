// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From POV-Ray's vectors to those of the optics headers.

#ifndef TILT_LENS_CAMERA_VECTORS_H
#define TILT_LENS_CAMERA_VECTORS_H

#include "backend/scene/camera.h"
#include "lens/lens_spec.h"

namespace pov
{

inline tilt_lens::Vec3d From_Vector(const VECTOR v)
{
	return { v[X], v[Y], v[Z] };
}

/// The camera's vectors as they are now, in the world.
inline tilt_lens::CameraVectors Vectors_Of(const Camera& camera)
{
	return { From_Vector(camera.Location), From_Vector(camera.Direction), From_Vector(camera.Right), From_Vector(camera.Up) };
}

}

#endif
