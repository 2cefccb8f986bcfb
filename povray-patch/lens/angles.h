// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pi and degrees, for everything here. Free of POV-Ray.

#ifndef TILT_LENS_ANGLES_H
#define TILT_LENS_ANGLES_H

namespace tilt_lens
{

const double Pi = 3.14159265358979323846;
const double RadiansPerDegree = Pi / 180.0;
const double DegreesPerRadian = 180.0 / Pi;

}

#endif
