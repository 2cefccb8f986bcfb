// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The shape of an edge's blur: what is measured of light that was laid as told, and what a lens's light is predicted to measure.

#include "edge/binned_profile.h"
#include "edge/disc_edge.h"
#include "edge/edge_fit.h"
#include "edge/edge_shape.h"
#include "edge/fit_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{

using namespace tiltcal;

const double NX = 0.8, NY = 0.6;

/// Points of light along the normal of an edge, px from it, and their parts.
using Spread = std::vector<std::pair<double, double>>;

/// A disc's light with so much of each shape: its chords, times 1 + a U3 + h U4.
Spread Disc(double radius, double asymmetry = 0, double hollowness = 0)
{
	const int n = 400;
	Spread spread;
	for (int k = 1; k <= n; ++k)
	{
		const double t = M_PI * k / (n + 1), sine = std::sin(t);
		spread.emplace_back(radius * std::cos(t), 2 * sine / (n + 1) * (sine + asymmetry * std::sin(4 * t) + hollowness * std::sin(5 * t)));
	}
	return spread;
}

/// As it is measured, of pixels 0.2 px apart; `noise` of a pixel, of a step of 0.75.
Edge Measured(const Spread& spread, double radius, double noise = 0, unsigned seed = 1)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, 1);
	const double reach = 1.5 * radius + 3;
	std::vector<EdgeSample> samples;
	for (double x = -reach + 0.1; x < reach; x += 0.2)
	{
		double light = 0;
		for (const auto& [at, part] : spread)
			light += part * PixelEdgeResponse(x - at, 0, NX, NY).value;
		for (double s = -7; s <= 7; s += 1)
			samples.push_back({ x, s, 0.05 + 0.75 * light + noise * normal(random) });
	}
	const EdgeFit fit = FitEdge(samples, LoneEdge(NX, NY), {}, radius);
	EXPECT_TRUE(fit.valid);
	Edge edge;
	edge.nx = NX;
	edge.ny = NY;
	edge.blur = 2 * fit.radius;
	edge.noise = fit.rms;
	edge.reach = reach;
	edge.profile = BinnedProfile(samples, fit);
	return edge;
}

// To first order in what is put in: its square may be left, of which place and width, fitted first, make their own; 3 % for a pixel's boxes, which are three points of one as wide (their
// fourth moments differ by a third of (1/12)^2 px^4, beside a quarter R^4 of the shape: 1e-4 at 4 px), and for bins a sixteenth of a radius wide.
TEST(EdgeShape, IsWhatTheLightWasLaidAs)
{
	for (const double radius : { 4.0, 8.0, 16.0 })
		for (const double asymmetry : { -0.04, 0.0, 0.04 })
			for (const double hollowness : { -0.04, 0.0, 0.04 })
			{
				const std::optional<EdgeShape> shape = ShapeOfEdge(Measured(Disc(radius, asymmetry, hollowness), radius));
				ASSERT_TRUE(shape);
				const double left = 0.03 * 0.04 + 0.04 * 0.04;
				EXPECT_NEAR(shape->value[ASYMMETRY], asymmetry, left) << radius << " " << hollowness;
				EXPECT_NEAR(shape->value[HOLLOWNESS], hollowness, left) << radius << " " << asymmetry;
			}
}

// A disc's noise, 200 times: mean 0 within 4 of its own sigmas, chi squared of 200 degrees of freedom within 4 of its (1 +- 0.4).
TEST(EdgeShape, ScattersAsItSays)
{
	const int n = 200;
	for (const double radius : { 2.0, 6.0 })
		for (int k = 0; k < SHAPES; ++k)
		{
			double sum = 0, squares = 0;
			for (int i = 0; i < n; ++i)
			{
				const std::optional<EdgeShape> shape = ShapeOfEdge(Measured(Disc(radius), radius, 0.01, unsigned(i)));
				ASSERT_TRUE(shape);
				const double u = shape->value[size_t(k)] / shape->sigma[size_t(k)];
				sum += u;
				squares += u * u;
			}
			EXPECT_LT(std::abs(sum) / std::sqrt(n), 4) << radius << " " << k;
			EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2.0 / n)) << radius << " " << k;
		}
}

TEST(EdgeShape, NeedsABlurThatPixelsDoNotHide)
{
	EXPECT_FALSE(ShapeOfEdge(Measured(Disc(1.2), 1.2)));
	Edge told = Measured(Disc(4), 4);
	told.profile.clear();
	EXPECT_FALSE(ShapeOfEdge(told));
}

// A part of a disc's light thrown aside, as FitResponse.IsWhatTheFitOfAnEdgeDoes has it, with its bounds: a few times the part's square, 3 % for samples and nodes; a disc of Chebyshev points about the
// line has a shape of 1e-4 of its own.
TEST(FitResponse, KnowsTheShapeOfLightThatIsThrownAside)
{
	const double part = 0.004;
	for (const double radius : { 4.0, 10.0 })
		for (const double aside : { -0.8, -0.3, 0.0, 0.5, 0.9 })
		{
			Spread spread = Disc(radius);
			for (auto& [at, share] : spread)
				share *= 1 - part;
			spread.emplace_back(aside * radius, part);
			const Edge disc = Measured(Disc(radius), radius), edge = Measured(spread, radius);
			const std::optional<EdgeShape> before = ShapeOfEdge(disc), after = ShapeOfEdge(edge);
			ASSERT_TRUE(before && after);
			const FitResponse response(NX, NY, disc.blur, disc.reach, 0, true);
			for (int k = 0; k < SHAPES; ++k)
				EXPECT_NEAR(after->value[size_t(k)] - before->value[size_t(k)], part * response.ShapeOf(Shape(k), aside * radius).value, 6 * part * part + 0.03 * part + 1e-4) << radius << " " << aside << " " << k;
		}
}

}
