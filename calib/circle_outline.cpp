// SPDX-License-Identifier: AGPL-3.0-or-later

#include "circle_outline.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double PI = 3.14159265358979323846;

double Cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}

CircleOutline::CircleOutline(const GridMap& map, const Vec2& place, double radius, const Vec2& at) : centre(at)
{
	const int points = 16;
	const Vec2 shift = centre - map.Pixel(place);
	series.fill(0);
	for (int m = 0; m < points; ++m)
	{
		const double t = 2 * PI * m / points;
		const Vec2 p = map.Pixel(place + radius * Vec2(std::cos(t), std::sin(t))) + shift;
		for (int k = -ORDER; k <= ORDER; ++k)
			series[size_t(k + ORDER)] += std::complex<double>(p.x(), p.y()) * std::polar(1.0 / points, -k * t);
	}
	place_from_pixel = map.Jacobian(place).inverse();
}

Vec2 CircleOutline::Derivative(double t, int k) const
{
	const std::complex<double> turn = std::polar(1.0, t);
	std::complex<double> sum = 0, power = std::polar(1.0, -ORDER * t);
	for (int n = -ORDER; n <= ORDER; ++n, power *= turn)
	{
		const std::complex<double> in(0, n);
		sum += series[size_t(n + ORDER)] * (k == 0 ? power : k == 1 ? in * power : in * in * power);
	}
	return { sum.real(), sum.imag() };
}

Vec2 CircleOutline::Outward(double t) const
{
	const Vec2 d = Derivative(t, 1).normalized();
	return { d.y(), -d.x() };
}

double CircleOutline::Curvature(double t, double reach) const
{
	const Vec2 p = At(t), inward = -Outward(t);
	// Nearer steps lose digits and change nothing.
	const double step = std::clamp(reach / Derivative(t, 1).norm(), 0.02, 1.2);
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
		const Vec2 gap = At(foot.t) - pixel, d = Derivative(foot.t, 1);
		const double slope = d.squaredNorm() + gap.dot(Derivative(foot.t, 2));
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
		const double t = 2 * PI * k / 32;
		const Vec2 p = At(t) - centre;
		const double w = Cross(p, Derivative(t, 1));
		area += w / 2;
		moment += w / 3 * p;
	}
	return centre + moment / area;
}

double CircleOutline::SmallerRadius() const
{
	double least = 1e300;
	for (int k = 0; k < 16; ++k)
		least = std::min(least, 0.5 * (At(PI * k / 16) - At(PI * k / 16 + PI)).norm());
	return least;
}

}
