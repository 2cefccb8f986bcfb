// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The disc's edge spread against the area of the disc counted numerically.

#include "edge/disc_edge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using tiltcal::DiscEdgeSpread;
using tiltcal::EdgeResponse;
using tiltcal::PixelEdgeResponse;

/// Share of a disc's area with x' <= x, by midpoint strips of its chord lengths.
double CountedSpread(double x, double radius)
{
	const int strips = 200000;
	double below = 0, all = 0;
	for (int k = 0; k < strips; ++k)
	{
		const double u = radius * ((k + 0.5) / strips * 2 - 1);
		const double chord = std::sqrt(radius * radius - u * u);
		all += chord;
		if (u <= x)
			below += chord;
	}
	return below / all;
}

TEST(DiscEdge, IsTheShareOfTheDisc)
{
	// 200000 strips: one strip's share is below 1e-5.
	for (const double x : { -4.9, -3.0, -0.7, 0.0, 1.3, 4.99 })
		EXPECT_NEAR(DiscEdgeSpread(x, 5), CountedSpread(x, 5), 1e-5) << x;
	EXPECT_EQ(DiscEdgeSpread(-5.1, 5), 0);
	EXPECT_EQ(DiscEdgeSpread(5.1, 5), 1);
}

TEST(DiscEdge, OfAPointIsAStep)
{
	EXPECT_EQ(DiscEdgeSpread(-1e-9, 0), 0);
	EXPECT_EQ(DiscEdgeSpread(1e-9, 0), 1);
}

/// Mean of the counted spread over the pixel's area, seen along its normal.
double CountedPixel(double x, double radius, double nx, double ny)
{
	const int n = 60;
	double sum = 0;
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			sum += DiscEdgeSpread(x + nx * ((i + 0.5) / n - 0.5) + ny * ((j + 0.5) / n - 0.5), radius);
	return sum / (n * n);
}

TEST(DiscEdge, PixelIsTheMeanOverItsSquare)
{
	// 60 x 60 midpoints: the error of a midpoint rule across the disc's square-root rim
	// at R = 0.4 px is below 3e-4; a wrong pixel width would show at 1e-2.
	for (const double radius : { 0.4, 1.0, 6.0 })
		for (const double angle : { 0.0, 1e-5, 0.3, 0.785398 })
			for (const double x : { -1.1, -0.2, 0.0, 0.55 })
			{
				const double nx = std::cos(angle), ny = std::sin(angle);
				EXPECT_NEAR(PixelEdgeResponse(x, radius, nx, ny).value, CountedPixel(x, radius, nx, ny), 3e-4)
					<< "R " << radius << " angle " << angle << " x " << x;
			}
}

TEST(DiscEdge, DerivativesAreDifferences)
{
	// Central differences with h = 1e-5: truncation 1e-10, cancellation of the second
	// antiderivative (about R^2 eps / (a b h)) below 1e-6 at R = 12, b >= 0.03.
	const double h = 1e-5;
	for (const double radius : { 0.3, 2.0, 12.0 })
		for (const double box : { 0.0, 0.03, 0.7 })
			for (const double x : { -2.2, -0.4, 0.1, 1.9 })
			{
				const EdgeResponse r = PixelEdgeResponse(x, radius, 0.8, box);
				const double dx = (PixelEdgeResponse(x + h, radius, 0.8, box).value - PixelEdgeResponse(x - h, radius, 0.8, box).value) / (2 * h);
				const double dr = (PixelEdgeResponse(x, radius + h, 0.8, box).value - PixelEdgeResponse(x, radius - h, 0.8, box).value) / (2 * h);
				EXPECT_NEAR(r.d_position, dx, 2e-6) << radius << " " << box << " " << x;
				EXPECT_NEAR(r.d_radius, dr, 2e-6) << radius << " " << box << " " << x;
			}
}

TEST(DiscEdge, OfAVanishingDiscIsThePixelAlone)
{
	// A step through a pixel square at 0 degrees: a ramp one pixel wide.
	EXPECT_NEAR(PixelEdgeResponse(0.25, 1e-9, 1, 0).value, 0.75, 1e-9);
	EXPECT_NEAR(PixelEdgeResponse(-0.5, 1e-9, 1, 0).value, 0.0, 1e-9);
}

}
