// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_weights.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const size_t ENOUGH = 12;
/// c/a that is tried: from what makes 30 px count as 1.05 to what makes 1 px count as 2, in steps of a tenth.
const double LEAST_RATIO = 0.01, MOST_RATIO = 2, STEP = 1.1;

struct Seen
{
	double blur_squared, residual_squared;   ///< px^2
};

/// -2 log likelihood of both coordinates' normal errors, the common a at its likeliest.
double Misfit(const std::vector<Seen>& seen, double ratio)
{
	double a_squared = 0, logs = 0;
	for (const Seen& s : seen)
	{
		const double relative = 1 + ratio * ratio * s.blur_squared;
		a_squared += s.residual_squared / relative / (2 * double(seen.size()));
		logs += 2 * std::log(relative);
	}
	return 2 * double(seen.size()) * std::log(a_squared) + logs;
}

}

double BlurAt(const StateCamera& camera, const CameraPose& pose, double unit_mm, const Vec3<double>& world)
{
	const Eigen::Vector3d p = unit_mm * (pose.camera_from_world * (Eigen::Vector3d(world.x, world.y, world.z) - pose.location));
	return BlurWidth(camera, { p.x(), p.y(), p.z() });
}

void WeighByBlur(const StateCamera& camera, const CameraPose& pose, double unit_mm, std::vector<PosePoint>& points)
{
	std::vector<Seen> seen;
	for (size_t i = 0; i < points.size(); ++i)
	{
		const double blur = BlurAt(camera, pose, unit_mm, points[i].world);
		// What is no noise says nothing of it.
		const double limit = pose.far_off * points[i].sigma, far = pose.residuals[i].squaredNorm();
		seen.push_back({ std::isfinite(blur) ? blur * blur : 0, std::min(far, limit * limit) });
	}
	double best = 0, least = Misfit(seen, 0);
	for (double ratio = LEAST_RATIO; ratio < MOST_RATIO && seen.size() >= ENOUGH; ratio *= STEP)
		if (const double misfit = Misfit(seen, ratio); misfit < least)
		{
			least = misfit;
			best = ratio;
		}
	for (size_t i = 0; i < points.size(); ++i)
		points[i].sigma = std::sqrt(1 + best * best * seen[i].blur_squared);
}

}
