// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The polygonal opening: its area, its edges, and that the map from the square preserves
// area and neighbourhood.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lens/blades.h"

using namespace tilt_lens;

namespace
{

const double Degree = Pi / 180.0;

/// How far a point lies outside the opening (< 0: inside), from the definition: beyond an edge's chord, or for a bent
/// edge outside of the circle through its ends and the top of its bulge.
double Outside(int count, double rotation, double curvature, const PupilPoint& p)
{
	const double half = Pi / count, chord = std::sin(half), height = curvature * (1 - std::cos(half));
	double most = -1;
	for(int i = 0; i < count; i++)
	{
		const double azimuth = rotation + (2 * i + 1) * half;
		const double along = p.x * std::sin(azimuth) + p.y * std::cos(azimuth), across = p.x * std::cos(azimuth) - p.y * std::sin(azimuth);
		if(std::atan2(std::fabs(across), along) > half + 1e-12)
			continue;
		if(height == 0)
			most = std::max(most, along - std::cos(half));
		else
		{
			const double radius = (chord * chord + height * height) / (2 * height);
			most = std::max(most, std::hypot(along - (std::cos(half) + height - radius), across) - radius);
		}
	}
	return most;
}

}

TEST(Blades, AreaIsThePolygonsAndGrowsToTheCircles)
{
	for(int count : { 3, 5, 6, 9, 64 })
	{
		EXPECT_NEAR(AreaOf(MakeBlades(count, 0, 0)), 0.5 * count * std::sin(2 * Pi / count), 1e-14);
		EXPECT_NEAR(AreaOf(MakeBlades(count, 0, 1)), Pi, 1e-14);
		// A circular segment over each chord: r^2 (alpha - sin(2 alpha)/2) with alpha half its angle.
		const double half = Pi / count, c = std::sin(half), h = 0.5 * (1 - std::cos(half)), r = (c * c + h * h) / (2 * h), alpha = std::asin(c / r);
		EXPECT_NEAR(AreaOf(MakeBlades(count, 0, 0.5)), 0.5 * count * std::sin(2 * half) + count * r * r * (alpha - 0.5 * std::sin(2 * alpha)), 1e-13);
	}
}

TEST(Blades, PointsFillTheOpeningUpToItsEdges)
{
	for(int count : { 3, 5, 8 })
		for(double curvature : { 0.0, 1e-6, 0.3, 1.0 })
		{
			const double rotation = 17 * Degree;
			const Blades b = MakeBlades(count, rotation, curvature);
			for(int i = 0; i <= 400; i++)
				for(double side : { 0.0, 1.0 })
				{
					// The square's edges become the opening's. 1e-9: an edge of radius 1e6 loses that much in Outside.
					EXPECT_NEAR(Outside(count, rotation, curvature, SquareToBlades(b, i / 400.0, side)), 0, 1e-9) << count << " " << curvature;
					EXPECT_NEAR(Outside(count, rotation, curvature, SquareToBlades(b, side, i / 400.0)), 0, 1e-9);
				}
			for(int i = 0; i < 50; i++)
				EXPECT_LT(Outside(count, rotation, curvature, SquareToBlades(b, 0.01 + 0.0196 * i, 0.99 - 0.0031 * i)), 0);
			EXPECT_NEAR(Outside(count, rotation, curvature, { std::sin(rotation), std::cos(rotation) }), 0, 1e-9) << "a corner at the rotation's azimuth";
		}
}

// The determinant of the map's derivative is the area everywhere; central differences, away from the square's diagonals
// and from the corners' rays, where the map has creases. Their own error is about 1e-8.
TEST(Blades, MapPreservesArea)
{
	const double h = 1e-6;
	for(int count : { 3, 5, 6, 11 })
		for(double curvature : { 0.0, 0.05, 0.5, 1.0 })
		{
			const Blades b = MakeBlades(count, 0.3, curvature);
			int checked = 0;
			for(int i = 0; i < 40; i++)
				for(int k = 0; k < 40; k++)
				{
					const double u = (i + 0.37) / 40, v = (k + 0.61) / 40;
					const PupilPoint a = SquareToBlades(b, u - h, v), c = SquareToBlades(b, u + h, v), d = SquareToBlades(b, u, v - h), e = SquareToBlades(b, u, v + h);
					const double determinant = ((c.x - a.x) * (e.y - d.y) - (c.y - a.y) * (e.x - d.x)) / (4 * h * h);
					const double step = std::max(std::hypot(c.x - a.x, c.y - a.y), std::hypot(e.x - d.x, e.y - d.y));
					ASSERT_LT(step, 40 * h) << "neighbours stay neighbours";
					if(std::fabs(std::fabs(determinant) - AreaOf(b)) < 1e-6)
						checked++;
				}
			EXPECT_GE(checked, 1595) << count << " " << curvature << ": at most creases differ";
		}
}

TEST(Blades, CurvatureOneIsTheDisc)
{
	const Blades b = MakeBlades(5, 0.2, 1);
	for(int i = 0; i <= 20; i++)
		for(int k = 0; k <= 20; k++)
		{
			const PupilPoint p = SquareToBlades(b, i / 20.0, k / 20.0);
			const double r = std::max(std::fabs(i / 10.0 - 1), std::fabs(k / 10.0 - 1));
			EXPECT_NEAR(std::hypot(p.x, p.y), r, 1e-14);
		}
}

TEST(Blades, SurplusOfAnArcHasAllItsDigits)
{
	for(double x : { 1e-300, 1e-8, 1e-3, 0.05, 0.0999999, 0.1000001, 0.7, 1.5 })
	{
		// Taylor's series in long double.
		long double sum = 0, term = (long double)x / 6;
		for(int k = 1; k < 20; k++)
		{
			sum += term;
			term *= -(long double)x * x / ((2 * k + 2) * (2 * k + 3));
		}
		EXPECT_NEAR(ArcSurplus(x), double(sum), 2e-14 * double(sum)) << x;
	}
}
