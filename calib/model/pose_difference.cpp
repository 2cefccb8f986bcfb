// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/pose_difference.h"

#include <ceres/rotation.h>

namespace tiltcal
{

Pose FromPoseTo(const Pose& from, const Pose& to)
{
	double first[4], second[4], turn[4];
	ceres::AngleAxisToQuaternion(from.data(), first);
	ceres::AngleAxisToQuaternion(to.data(), second);
	const double back[4] = { first[0], -first[1], -first[2], -first[3] };
	ceres::QuaternionProduct(second, back, turn);
	Pose difference{};
	ceres::QuaternionToAngleAxis(turn, difference.data());
	for (size_t k = 3; k < 6; ++k)
		difference[k] = to[k] - from[k];
	return difference;
}

}
