// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/pose_difference.h"

#include <cmath>

namespace tiltcal
{

Pose FromPoseTo(const Pose& from, const Pose& to)
{
	const double angle = std::hypot(to[0], to[1], to[2]);
	const auto by_turns = [&](int turns)
	{
		Pose difference{};
		for (size_t k = 0; k < 6; ++k)
			difference[k] = (k < 3 && turns != 0 ? to[k] * (1 + 2 * M_PI * turns / angle) : to[k]) - from[k];
		return difference;
	};
	const auto turned = [](const Pose& p) { return std::hypot(p[0], p[1], p[2]); };
	Pose nearest = by_turns(0);
	for (const int turns : { -1, 1 })
		if (angle > 0 && turned(by_turns(turns)) < turned(nearest))
			nearest = by_turns(turns);
	return nearest;
}

}
