// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The edge fit on edges that were rendered by scattering rays, which knows nothing of
// the edge-spread formula.

#include "edge/edge_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{

using tiltcal::EdgeFit;
using tiltcal::EdgeSample;
using tiltcal::FitEdge;
using tiltcal::LoneEdge;

struct Rendered
{
	double radius, angle, offset, slope, shade_x, noise;
};

/// Every pixel of a 36 x 36 patch: the mean over `rays` points of the pixel's square,
/// each moved by a point of the blur disc, of a black or white half plane.
std::vector<EdgeSample> Render(const Rendered& r, int rays, unsigned seed)
{
	std::mt19937 random(seed);
	std::uniform_real_distribution<double> unit(0, 1);
	std::normal_distribution<double> normal(0, 1);
	const double low = 0.04, high = 0.8;
	const double nx = std::cos(r.angle), ny = std::sin(r.angle);
	const int half = 18;
	std::vector<EdgeSample> samples;
	for (int v = -half; v <= half; ++v)
		for (int u = -half; u <= half; ++u)
		{
			const double x = nx * u + ny * v, s = ny * u - nx * v;
			if (std::abs(x) > 15 || std::abs(s) > 12)
				continue;
			double white = 0;
			for (int k = 0; k < rays; ++k)
			{
				// Stratified in the pixel's x; the disc by rejection.
				const double pu = u + (k + unit(random)) / rays - 0.5, pv = v + unit(random) - 0.5;
				double a, b;
				do
				{
					a = 2 * unit(random) - 1;
					b = 2 * unit(random) - 1;
				} while (a * a + b * b > 1);
				const double qu = pu + r.radius * a, qv = pv + r.radius * b;
				white += nx * qu + ny * qv > r.offset + r.slope * (ny * qu - nx * qv);
			}
			const double value = (low + (high - low) * white / rays) * (1 + r.shade_x * x) + r.noise * normal(random);
			samples.push_back({ x, s, value });
		}
	return samples;
}

TEST(EdgeFit, FindsTheDisc)
{
	// 1500 rays a pixel: noise of at most 0.76 * 0.5 / sqrt(1500) = 0.01 in the blurred band,
	// which 24 px of edge reduce to about 0.03 px of radius at R = 10, less below.
	for (const double radius : { 1.0, 3.0, 10.0 })
		for (const double angle : { 0.0, 0.4, 1.2 })
		{
			const EdgeFit fit = FitEdge(Render({ radius, angle, 0.3, 0, 0, 0 }, 1500, 7), LoneEdge(std::cos(angle), std::sin(angle)), {}, 2);
			ASSERT_TRUE(fit.valid);
			EXPECT_NEAR(fit.radius, radius, 0.04 + 0.005 * radius) << angle;
			EXPECT_NEAR(fit.offset, 0.3, 0.03);
			// At R = 10 the patch shows 5 px of plateau on each side.
			EXPECT_NEAR(fit.low, 0.04, 0.006);
			EXPECT_NEAR(fit.high, 0.8, 0.006);
		}
}

TEST(EdgeFit, IsNotFooledByVignettingOrAnOblique)
{
	// Without the shading 1 % per pixel would move the radius by more than 0.2 px.
	const EdgeFit fit = FitEdge(Render({ 5, 0.2, -0.4, 0.02, 0.01, 0.005 }, 1500, 3), LoneEdge(std::cos(0.2), std::sin(0.2)), { 0.01, 0 }, 3);
	ASSERT_TRUE(fit.valid);
	EXPECT_NEAR(fit.radius, 5, 0.06);
	EXPECT_NEAR(fit.offset, -0.4, 0.03);
	EXPECT_NEAR(fit.slope, 0.02, 0.004);
}

TEST(EdgeFit, SharpEdgeHasNoBlur)
{
	const EdgeFit fit = FitEdge(Render({ 0, 0.35, 0, 0, 0, 0 }, 400, 5), LoneEdge(std::cos(0.35), std::sin(0.35)), {}, 2);
	ASSERT_TRUE(fit.valid);
	// The pixel hides radii below about 0.3 px.
	EXPECT_LT(fit.radius, 0.3);
}

TEST(EdgeFit, SigmaIsTheScatter)
{
	// 40 noisy edges: the scatter of the radius and its mean predicted sigma agree within a
	// factor of 1.5 (the scatter of 40 is itself known to 11 %; 1.5 is 4 sigma).
	double sum = 0, squares = 0, predicted = 0;
	const int n = 40;
	for (int k = 0; k < n; ++k)
	{
		const EdgeFit fit = FitEdge(Render({ 4, 0.3, 0, 0, 0, 0.02 }, 200, 100 + unsigned(k)), LoneEdge(std::cos(0.3), std::sin(0.3)), {}, 3);
		ASSERT_TRUE(fit.valid);
		sum += fit.radius;
		squares += fit.radius * fit.radius;
		predicted += fit.radius_sigma / n;
	}
	const double scatter = std::sqrt((squares - sum * sum / n) / (n - 1));
	EXPECT_LT(scatter, 1.5 * predicted);
	EXPECT_GT(scatter, predicted / 1.5);
}

/// An edge whose blur has a tail to its bright side, or, by `dark`, to its dark one: half of the light falls into a disc, half is spread over 3 R of it aside.
std::vector<EdgeSample> WithATail(bool dark)
{
	std::vector<EdgeSample> samples;
	const double R = 5, low = 0.05, high = 0.8, sign = dark ? -1 : 1;
	for (double x = -20; x <= 20; x += 0.5)
		for (const double s : { -3.0, 0.0, 3.0 })
		{
			double light = 0;
			for (int k = 0; k < 6; ++k)
				light += (k == 0 ? 0.5 : 0.1) * tiltcal::PixelEdgeResponse(x - sign * 0.6 * R * k, R, 1, 0).value;
			samples.push_back({ x, s, low + (high - low) * light });
		}
	return samples;
}

// Coma points one way in the picture, and edges have their bright sides on either. By symmetry, but for the steps at which a descent ends.
TEST(EdgeFit, ATailCountsAlikeOnBothSides)
{
	const EdgeFit bright = FitEdge(WithATail(false), LoneEdge(1, 0), {}, 5), dark = FitEdge(WithATail(true), LoneEdge(1, 0), {}, 5);
	ASSERT_TRUE(bright.valid && dark.valid);
	EXPECT_NEAR(bright.radius, dark.radius, 2e-3);
	EXPECT_NEAR(bright.offset, -dark.offset, 2e-3);
	EXPECT_GT(bright.offset, 1);
}

TEST(EdgeFit, RefusesWhatIsNoEdge)
{
	EXPECT_FALSE(FitEdge({}, LoneEdge(1, 0), {}, 2).valid);
	std::vector<EdgeSample> flat;
	for (int k = 0; k < 400; ++k)
		flat.push_back({ k % 20 - 9.5, k / 20 - 9.5, 0.5 });
	EXPECT_FALSE(FitEdge(flat, LoneEdge(1, 0), {}, 2).valid);
}

}
