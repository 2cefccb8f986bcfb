// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/circle_edge.h"

#include "lens/angles.h"
#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

/// b - sin b cos b: a segment of the unit circle of half angle b. The difference loses its digits below 0.05.
double Segment(double b)
{
	const double b2 = b * b;
	return b < 0.05 ? b * b2 * (2.0 / 3 - b2 * (2.0 / 15 - b2 * 4.0 / 315)) : b - std::sin(b) * std::cos(b);
}

/// Share of a disc of radius R outside of a circle of radius rho, from whose rim its centre is x away (outside positive).
EdgeResponse OutsideShare(double x, double R, double rho)
{
	const double D = rho + x;
	if (x >= R)
		return { 1, 0, 0 };
	if (x <= -R || D <= R - rho)
	{
		// The disc is in the circle, or the circle in the disc.
		const double inside = std::min(1.0, rho * rho / (R * R));
		return { 1 - inside, 0, rho < R ? 2 * inside / R : 0 };
	}
	const double area = Pi * R * R;
	// From the disc's centre towards the circle's: the common chord, half as long as h.
	const double a = (x * (2 * rho + x) + R * R) / (2 * D), h = std::sqrt(std::max(R * R - a * a, 0.0));
	const double alpha = std::acos(std::clamp(a / R, -1.0, 1.0)), beta = std::atan2(h, D - a);
	const double overlap = R * R * Segment(alpha) + rho * rho * Segment(beta);
	// The chord sweeps the overlap when the circles part, the disc's arc in the circle when the disc grows.
	return { 1 - overlap / area, 2 * h / area, 2 * (overlap / R - R * alpha) / area };
}

/// DiscEdgeSpread and its derivatives.
EdgeResponse StraightShare(double x, double R)
{
	if (std::abs(x) >= R)
		return { x < 0 ? 0.0 : 1.0, 0, 0 };
	const double slope = 2 * std::sqrt((R - x) * (R + x)) / (Pi * R * R);
	return { DiscEdgeSpread(x, R), slope, -x / R * slope };
}

}

EdgeResponse CurvedEdgeResponse(double x, double radius, double curvature, double box_a, double box_b)
{
	EdgeResponse e = PixelEdgeResponse(x, radius, box_a, box_b);
	const double R = std::sqrt(radius * radius + 1.0 / 3);
	// What the bend changes is of the order of R curvature / 8.
	if (std::abs(curvature) * R < 1e-5 || std::abs(x) > R)
		return e;
	const EdgeResponse straight = StraightShare(x, R);
	EdgeResponse curved = OutsideShare(curvature > 0 ? x : -x, R, 1 / std::abs(curvature));
	if (curvature < 0)
		curved = { 1 - curved.value, curved.d_position, -curved.d_radius };
	e.value += curved.value - straight.value;
	e.d_position += curved.d_position - straight.d_position;
	e.d_radius += (curved.d_radius - straight.d_radius) * radius / R;
	return e;
}

EdgeResponse CurvedEdge::At(const EdgeSample& sample, double offset, double slope, double radius) const
{
	size_t k = 1;
	while (k + 1 < bend.size() && bend[k].s < sample.s)
		++k;
	const BendPoint &a = bend[k - 1], &b = bend[k];
	const double t = (sample.s - a.s) / (b.s - a.s);
	const auto between = [t](double from, double to) { return from + t * (to - from); };
	return CurvedEdgeResponse(sample.x - offset - slope * sample.s, radius, between(a.curvature, b.curvature),
		std::abs(between(a.nx, b.nx)), std::abs(between(a.ny, b.ny)));
}

}
