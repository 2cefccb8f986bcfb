// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REAL_LENS_RAY_H
#define TILTCAL_REAL_LENS_RAY_H

#include <tiltcal/camera.h>

namespace tiltcal
{

/// Camera frame, mm; the origin is the centre of the entrance pupil. The ray's z component of `direction` is 1.
struct CameraRay
{
	Vec3<double> origin{ 0, 0, 0 }, direction{ 0, 0, 1 };
};

/// The mean of all rays that come to the pixel through the opening that the rims leave: where a blurred point lies on the average. `camera` has aberrations.
CameraRay MeanRayThroughLens(const StateCamera& camera, const Point& pixel);

}

#endif
