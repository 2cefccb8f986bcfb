// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/disc_edge.h"

#include "lens/angles.h"
#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

/// ESF, its first and second antiderivative (both 0 at -infinity) and their
/// derivatives by R, at x.
struct Antiderivatives
{
	double e0, e1, e2;    // ESF, its integral, its double integral
	double de1, de2;      // d e1 / dR, d e2 / dR
};

Antiderivatives Evaluate(double x, double R)
{
	if (x <= -R)
		return { 0, 0, 0, 0, 0 };
	if (x >= R)
		return { 1, x, x * x / 2 + R * R / 8, 0, R / 4 };
	const double t = x / R;
	const double s2 = (1 - t) * (1 + t);
	const double s = std::sqrt(s2);
	const double a = std::asin(t);
	const double g0 = 0.5 + (a + t * s) / Pi;
	const double g1 = t / 2 + (t * a + s - s * s2 / 3) / Pi;
	const double g2 = t * t / 4 + ((t * t / 2 + 0.125) * a + 0.625 * t * s - t * s * s2 / 12) / Pi + 0.0625;
	// e1 = R g1(x/R), e2 = R^2 g2(x/R): the chain rule gives the derivatives by R.
	return { g0, R * g1, R * R * g2, g1 - t * g0, R * (2 * g2 - t * g1) };
}

}

double DiscEdgeSpread(double x, double radius)
{
	if (radius <= 0)
		return x < 0 ? 0 : x > 0 ? 1 : 0.5;
	return Evaluate(x, radius).e0;
}

EdgeResponse PixelEdgeResponse(double x, double radius, double box_a, double box_b)
{
	const double a = std::max(box_a, box_b);
	const double b = std::min(box_a, box_b);
	// Below this width the second difference loses its digits, and the narrow box
	// does nothing: its effect is of order b^2.
	if (b < 1e-3)
	{
		const Antiderivatives r = Evaluate(x + a / 2, radius);
		const Antiderivatives l = Evaluate(x - a / 2, radius);
		return { (r.e1 - l.e1) / a, (r.e0 - l.e0) / a, (r.de1 - l.de1) / a };
	}
	const double outer = (a + b) / 2, inner = (a - b) / 2;
	const Antiderivatives p = Evaluate(x + outer, radius);
	const Antiderivatives q = Evaluate(x + inner, radius);
	const Antiderivatives r = Evaluate(x - inner, radius);
	const Antiderivatives s = Evaluate(x - outer, radius);
	const double area = a * b;
	return {
		(p.e2 - q.e2 - r.e2 + s.e2) / area,
		(p.e1 - q.e1 - r.e1 + s.e1) / area,
		(p.de2 - q.de2 - r.de2 + s.de2) / area
	};
}

}
