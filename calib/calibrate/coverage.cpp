// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/coverage.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const char* const THIRDS[] = { "upper left", "upper middle", "upper right", "middle left", "middle", "middle right", "lower left", "lower middle", "lower right" };
const char* const SIDES[] = { "upper side", "upper right corner", "right side", "lower right corner", "lower side", "lower left corner", "left side", "upper left corner" };

/// Below it a board counts as parallel to the sensor: at 40 degrees from the axis's foot a board as deep as a fifth of its distance gives 1.14.
const double PARALLEL = 1.04;

/// Homography from the board's (column, row) to the picture, by least squares; the last entry is 1.
Eigen::Matrix3d HomographyOf(const std::vector<Corner>& corners, const Eigen::Vector2d& middle, double unit)
{
	Eigen::MatrixXd A(2 * Eigen::Index(corners.size()), 8);
	Eigen::VectorXd b(A.rows());
	for (Eigen::Index k = 0; k < Eigen::Index(corners.size()); ++k)
	{
		const Corner& c = corners[size_t(k)];
		const double i = c.column, j = c.row, u = (c.x - middle.x()) / unit, v = (c.y - middle.y()) / unit;
		A.row(2 * k) << i, j, 1, 0, 0, 0, -i * u, -j * u;
		A.row(2 * k + 1) << 0, 0, 0, i, j, 1, -i * v, -j * v;
		b[2 * k] = u;
		b[2 * k + 1] = v;
	}
	const Eigen::VectorXd h = A.colPivHouseholderQr().solve(b);
	Eigen::Matrix3d H;
	H << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
	return H;
}

}

Stance StanceOf(const Photo& photo)
{
	Stance out;
	if (!photo.edges.empty())
	{
		const auto [least, most] = std::minmax_element(photo.edges.begin(), photo.edges.end(), [](const Edge& a, const Edge& b) { return a.blur < b.blur; });
		out.least_blur = std::max(least->blur, 0.0);
		out.most_blur = std::max(most->blur, 0.0);
	}
	if (photo.corners.size() < 4 || photo.width <= 0)
		return out;
	Eigen::Vector2d middle(0, 0);
	for (const Corner& c : photo.corners)
		middle += Eigen::Vector2d(c.x, c.y) / double(photo.corners.size());
	const Eigen::Matrix3d H = HomographyOf(photo.corners, middle, photo.width);
	// What the homography divides by is the depth, but for a factor.
	double nearest = HUGE_VAL, farthest = 0, left = HUGE_VAL, right = -HUGE_VAL;
	for (const Corner& c : photo.corners)
	{
		const double depth = H(2, 0) * c.column + H(2, 1) * c.row + 1;
		nearest = std::min(nearest, depth);
		farthest = std::max(farthest, depth);
		left = std::min(left, c.x);
		right = std::max(right, c.x);
	}
	if (nearest > 0)
		out.depth_ratio = farthest / nearest;
	out.share_of_width = (right - left) / photo.width;
	// Rows run down.
	out.recedes_deg = std::atan2(H(2, 0), -H(2, 1)) * 180 / M_PI;
	return out;
}

Thirds SeenThirds(const Task& task)
{
	Thirds seen{};
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			for (const Corner& c : photo.corners)
			{
				const int x = std::clamp(int(3 * (c.x + 0.5) / std::max(task.width, 1)), 0, 2), y = std::clamp(int(3 * (c.y + 0.5) / std::max(task.height, 1)), 0, 2);
				seen[size_t(3 * y + x)] = true;
			}
	return seen;
}

const char* NameOfThird(size_t third) { return THIRDS[third]; }

const char* SideWords(double recedes_deg)
{
	const int eighth = int(std::lround(recedes_deg / 45)) % 8;
	return SIDES[(eighth + 8) % 8];
}

std::string StanceWords(const Stance& s)
{
	if (s.depth_ratio < PARALLEL)
		return "nearly parallel to the sensor";
	return fmt::format("its {} {:.0f} % farther away than what is across", SideWords(s.recedes_deg), 100 * (s.depth_ratio - 1));
}

}
