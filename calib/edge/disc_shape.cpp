// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/disc_shape.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// The integral from -1 to u of 2/pi sqrt(1 - u^2) Un(u), n > 0: Un is sin((n + 1) t) / sin t of u = cos t.
double Integral(int n, double t) { return (std::sin((n + 2) * t) / (n + 2) - std::sin(n * t) / n) / M_PI; }

}

Eigen::Vector2d ShapeResponse(double x, double radius, double box_a, double box_b)
{
	// Of the variance of both boxes: Gauss's three points of one box as wide.
	const double width = std::hypot(box_a, box_b), at[] = { -std::sqrt(0.15), 0, std::sqrt(0.15) }, weight[] = { 5 / 18., 8 / 18., 5 / 18. };
	Eigen::Vector2d seen = Eigen::Vector2d::Zero();
	for (int i = 0; i < 3; ++i)
	{
		const double t = std::acos(std::clamp((x + at[i] * width) / radius, -1., 1.));
		seen += weight[i] * Eigen::Vector2d(Integral(3, t), Integral(4, t));
	}
	return seen;
}

}
