// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/circle_outline.h"

#include "lens/angles.h"
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}

CircleOutline::CircleOutline(const GridMap& map, const Vec2& place, double radius, const Vec2& at) : centre(at)
{
	const int points = 16;
	const Vec2 shift = centre - map.Pixel(place);
	cosines.fill(Vec2::Zero());
	sines.fill(Vec2::Zero());
	for (int m = 0; m < points; ++m)
	{
		const double t = 2 * Pi * m / points;
		const Vec2 p = map.Pixel(place + radius * Vec2(std::cos(t), std::sin(t))) + shift;
		for (int k = 0; k <= ORDER; ++k)
		{
			cosines[size_t(k)] += (k == 0 ? 1.0 : 2.0) / points * std::cos(k * t) * p;
			sines[size_t(k)] += 2.0 / points * std::sin(k * t) * p;
		}
	}
	place_from_pixel = map.Jacobian(place).inverse();
}

CircleOutline::Point CircleOutline::All(double t) const
{
	const double c1 = std::cos(t), s1 = std::sin(t);
	Point at{ cosines[0], Vec2::Zero(), Vec2::Zero() };
	double c = 1, s = 0;
	for (int k = 1; k <= ORDER; ++k)
	{
		const double next = c * c1 - s * s1;
		s = s * c1 + c * s1;
		c = next;
		const Vec2 value = c * cosines[size_t(k)] + s * sines[size_t(k)];
		at.p += value;
		at.first += k * (c * sines[size_t(k)] - s * cosines[size_t(k)]);
		at.second -= k * k * value;
	}
	return at;
}

Vec2 CircleOutline::Outward(double t) const
{
	const Vec2 d = Tangent(t).normalized();
	return { d.y(), -d.x() };
}

double CircleOutline::Curvature(double t, double reach) const
{
	const Vec2 p = At(t), inward = -Outward(t);
	// Nearer steps lose digits and change nothing.
	const double step = std::clamp(reach / Tangent(t).norm(), 0.02, 1.2);
	double sum = 0;
	for (const double side : { -step, step })
	{
		const Vec2 chord = At(t + side) - p;
		sum += chord.dot(inward) / chord.squaredNorm();
	}
	return sum;
}

CircleOutline::Foot CircleOutline::FootOf(const Vec2& pixel) const
{
	const Vec2 on_board = place_from_pixel * (pixel - centre);
	Foot foot;
	foot.t = std::atan2(on_board.y(), on_board.x());
	for (int k = 0; k < 8; ++k)
	{
		const Point at = All(foot.t);
		const Vec2 gap = at.p - pixel, d = at.first;
		const double slope = d.squaredNorm() + gap.dot(at.second);
		// Zero at the centre of curvature, d^2 on the outline.
		if (slope < 0.1 * d.squaredNorm())
			return foot;
		const double step = -gap.dot(d) / slope;
		foot.t += std::clamp(step, -0.5, 0.5);
		if (std::abs(step) < 1e-6)
		{
			foot.found = true;
			foot.distance = (pixel - At(foot.t)).dot(Outward(foot.t));
			return foot;
		}
	}
	return foot;
}

Vec2 CircleOutline::Centroid() const
{
	// Green: the mean of p over the area is the integral of p (p x dp) / 3 over that of (p x dp) / 2, from any origin.
	double area = 0;
	Vec2 moment = Vec2::Zero();
	for (int k = 0; k < 32; ++k)
	{
		const double t = 2 * Pi * k / 32;
		const Vec2 p = At(t) - centre;
		const double w = Cross(p, Tangent(t));
		area += w / 2;
		moment += w / 3 * p;
	}
	return centre + moment / area;
}

double CircleOutline::SmallerRadius() const
{
	double least = std::numeric_limits<double>::infinity();
	for (int k = 0; k < 16; ++k)
		least = std::min(least, 0.5 * (At(Pi * k / 16) - At(Pi * k / 16 + Pi)).norm());
	return least;
}

}
