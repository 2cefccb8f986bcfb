// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A curved edge's response against the blur disc and the pixel counted numerically.

#include "edge/circle_edge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using tiltcal::CurvedEdgeResponse;
using tiltcal::EdgeResponse;

/// Mean over a disc of `radius` and a pixel at (x, 0) of: outside of the circle of radius rho about (-rho, 0). The pixel's sides
/// lie along (nx, ny) and across.
double Counted(double x, double radius, double rho, double nx, double ny)
{
	const int disc = 4000, pixel = 12;
	double outside = 0;
	for (int k = 0; k < disc; ++k)
	{
		// Fermat's spiral covers the disc evenly.
		const double r = radius * std::sqrt((k + 0.5) / disc), a = k * 2.399963229728653;
		for (int i = 0; i < pixel; ++i)
			for (int j = 0; j < pixel; ++j)
			{
				const double u = (i + 0.5) / pixel - 0.5, v = (j + 0.5) / pixel - 0.5;
				const double px = x + r * std::cos(a) + u * nx - v * ny, py = r * std::sin(a) + u * ny + v * nx;
				outside += std::hypot(px + rho, py) > rho;
			}
	}
	return outside / (disc * pixel * pixel);
}

TEST(CircleEdge, IsTheShareOfDiscAndPixelOutsideOfTheCircle)
{
	for (const double rho : { 6.0, 15.0, 40.0 })
		for (const double ratio : { 0.02, 0.2, 0.4, 0.7 })
			for (const double at : { -0.8, -0.3, 0.0, 0.4, 0.9 })
			{
				const double R = ratio * rho, x = at * (R + 0.5), nx = 0.8, ny = 0.6;
				// The pixel bends only with the variance of the disc, which a square is not: 4e-3 are 0.003 px of the smallest circle's edge
				// where it is sharp. The counting's own error is 5e-4.
				EXPECT_NEAR(CurvedEdgeResponse(x, R, 1 / rho, nx, ny).value, Counted(x, R, rho, nx, ny), rho < 10 ? 4e-3 : 2e-3) << rho << " " << ratio << " " << at;
				// Around the bright side the same, turned over.
				EXPECT_NEAR(CurvedEdgeResponse(x, R, -1 / rho, nx, ny).value, 1 - CurvedEdgeResponse(-x, R, 1 / rho, nx, ny).value, 1e-12);
			}
}

TEST(CircleEdge, DerivativesAreThoseOfTheValue)
{
	const double h = 1e-5;
	for (const double curvature : { -0.1, -0.02, 0.03, 0.12 })
		for (const double R : { 0.5, 2.0, 5.0 })
			for (const double x : { -3.1, -0.4, 0.3, 2.2 })
			{
				const EdgeResponse e = CurvedEdgeResponse(x, R, curvature, 0.8, 0.6);
				const auto value = [&](double dx, double dR) { return CurvedEdgeResponse(x + dx, R + dR, curvature, 0.8, 0.6).value; };
				// Second differences of a curve with kinks of its slope: 1e-4 of a response of 1.
				EXPECT_NEAR(e.d_position, (value(h, 0) - value(-h, 0)) / (2 * h), 1e-4) << curvature << " " << R << " " << x;
				EXPECT_NEAR(e.d_radius, (value(0, h) - value(0, -h)) / (2 * h), 1e-4) << curvature << " " << R << " " << x;
			}
}

TEST(CircleEdge, WithoutBendIsStraight)
{
	const EdgeResponse bent = CurvedEdgeResponse(0.7, 3, 1e-7, 0.8, 0.6), straight = tiltcal::PixelEdgeResponse(0.7, 3, 0.8, 0.6);
	EXPECT_NEAR(bent.value, straight.value, 1e-7);
	EXPECT_NEAR(CurvedEdgeResponse(0.7, 3, 1e-5, 0.8, 0.6).value, straight.value, 1e-5);
}

}
