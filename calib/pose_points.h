// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_POINTS_H
#define TILTCAL_POSE_POINTS_H

#include "camera.h"

#include <string>
#include <vector>

namespace tiltcal
{

/// A point of the scene and where a photograph shows it.
struct PosePoint
{
	double u = 0, v = 0;       ///< pixels
	Vec3<double> world{};      ///< scene units, left-handed
	int line = 0;              ///< of the file, for messages
};

/// Reads a CSV with the header u_px,v_px,x,y,z. Empty lines and lines that begin with # are
/// passed over. Throws FileError with file:line: unreadable, another header, not five
/// finite numbers.
std::vector<PosePoint> ReadPosePoints(const std::string& file);

}

#endif
