// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Points of area lights: the weights of POV-Ray's own averaging, and stratified over a pixel's samples.

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "lens/light_samples.h"

using namespace tilt_lens;

namespace
{

/// As TraceAreaLightSubsetShadowRay goes without `adaptive`: four corners a quarter each, of
/// which each is replaced by a quarter of the grid where that has points between.
void AddWeights(int u1, int v1, int u2, int v2, double weight, std::map<std::pair<int, int>, double>& weights)
{
	if(u2 - u1 <= 1 && v2 - v1 <= 1)
	{
		for(int i = 0; i < 4; i++)
			weights[{ i & 1 ? u2 : u1, i & 2 ? v2 : v1 }] += weight / 4;
		return;
	}
	const double u = (u1 + u2) / 2.0, v = (v1 + v2) / 2.0;
	for(int i = 0; i < 4; i++)
		AddWeights(i & 1 ? int(std::ceil(u)) : u1, i & 2 ? int(std::ceil(v)) : v1, i & 1 ? u2 : int(std::floor(u)), i & 2 ? v2 : int(std::floor(v)), weight / 4, weights);
}

}

// Digits that halve exactly: 2^12 equally spaced numbers count the weights without error.
TEST(LightSamples, CellsHaveTheWeightsOfPovRaysAverage)
{
	for(int columns = 1; columns <= 17; columns++)
		for(int rows : { 1, 2, 3, 6 })
		{
			std::map<std::pair<int, int>, double> weights;
			AddWeights(0, 0, columns - 1, rows - 1, 1.0, weights);
			std::vector<double> u(columns), v(rows);
			const int n = 1 << 12;
			for(int i = 0; i < n; i++)
			{
				const LightCell cu = CellOfLight((i + 0.5) / n, columns), cv = CellOfLight((i + 0.5) / n, rows);
				ASSERT_TRUE(cu.place > 0.0 && cu.place < 1.0);
				u[cu.index] += 1.0 / n;
				v[cv.index] += 1.0 / n;
			}
			for(const auto& w : weights)
				ASSERT_EQ(w.second, u[w.first.first] * v[w.first.second]) << columns << " x " << rows;
		}
}

// What the choice of the point leaves is uniform: jitter.
TEST(LightSamples, PlacesInACellAreUniform)
{
	double sum = 0.0;
	int count = 0;
	const int n = 1 << 12;
	for(int i = 0; i < n; i++)
	{
		const LightCell cell = CellOfLight((i + 0.5) / n, 5);
		if(cell.index != 2)
			continue;
		sum += cell.place;
		count++;
	}
	EXPECT_EQ(count, n / 4);
	EXPECT_NEAR(sum / count, 0.5, 1e-12);   // equally spaced
}

// 2^k samples put one into each of 2^k intervals, for every light and every time it is asked.
TEST(LightSamples, AreStratifiedOverAPixel)
{
	const int n = 64;
	PixelSampler sampler(12, 34);
	LightSamples lights;
	std::set<int> strata[3][2][2];
	for(int i = 0; i < n; i++)
	{
		sampler.Next();
		lights.Draw(sampler.Light());
		for(int light : { 2, 0, 1 })
			for(int time = 0; time < 2; time++)
			{
				const LightPoint p = lights.Next(light);
				strata[light][time][0].insert(int(p.u * n));
				strata[light][time][1].insert(int(p.v * n));
			}
	}
	for(const auto& light : strata)
		for(const auto& time : light)
			for(const auto& axis : time)
				EXPECT_EQ(axis.size(), size_t(n));
}

// The order in which lights are asked, or how many there are, does not change a light's points.
TEST(LightSamples, DoNotDependOnOtherLights)
{
	PixelSampler sampler(5, 6);
	sampler.Next();
	const LightDimensions light = sampler.Light();
	LightSamples a, b;
	a.Draw(light);
	b.Draw(light);
	const LightPoint p = a.Next(3);
	b.Next(7);
	const LightPoint q = b.Next(3);
	EXPECT_EQ(p.u, q.u);
	EXPECT_EQ(p.v, q.v);
	EXPECT_NE(a.Next(3).u, p.u);
	a.Begin();
	EXPECT_EQ(a.Next(3).u, p.u);
}

// The lens and the light together, 4096 samples: independent ones would err by sqrt(p (1 - p) / 4096) <= 0.0078, a net far less.
TEST(LightSamples, IntegrateLensAndLightTogether)
{
	const int n = 4096;
	PixelSampler sampler(9, 2);
	LightSamples lights;
	int lit = 0;
	for(int i = 0; i < n; i++)
	{
		const LensSample s = sampler.Next();
		lights.Draw(sampler.Light());
		const LightPoint p = lights.Next(0);
		lit += s.lens_u + s.lens_v + p.u + p.v < 2.0;
	}
	EXPECT_NEAR(lit / double(n), 0.5, 0.004);
}
