// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_POINTS_H
#define TILTCAL_POSE_POINTS_H

#include "model/projection.h"

#include <string>
#include <vector>

namespace tiltcal
{

/// Who says where in the photograph a point is.
enum class Placed
{
	GIVEN,     ///< the file, to the pixel it names
	MEASURED,  ///< the photograph, near the pixel that the file names
	FOUND,     ///< the photograph, near where the other points' camera sees it
	NOWHERE    ///< nobody yet: u and v are NaN
};

/// A point of the scene and where a photograph shows it.
struct PosePoint
{
	double u = 0, v = 0;       ///< pixels
	Vec3<double> world{};      ///< scene units, left-handed
	int line = 0;              ///< of the file, for messages
	Placed placed = Placed::GIVEN;
	double sigma = 1;          ///< of its pixel, over that of the surest points
};

/// Reads a CSV with the header u_px,v_px,x,y,z; a point without a pixel (",,x,y,z") is NOWHERE.
/// Empty lines and lines that begin with # are passed over. Throws FileError with file:line:
/// unreadable, another header, not five finite numbers.
std::vector<PosePoint> ReadPosePoints(const std::string& file);

}

#endif
