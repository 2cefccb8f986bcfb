// SPDX-License-Identifier: AGPL-3.0-or-later

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lens/aberrations.h"

using namespace tilt_lens;

namespace
{

typedef long double Real;
typedef PupilRay<Real> R4;

struct Random
{
	std::mt19937_64 generator{ 9 };

	Real Between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
	/// A ray of a lens of that power, |power S| <= 1.
	R4 Ray(Real power)
	{
		const Real length = std::sqrt(Between(0, 1)) / power, angle = Between(0, 6.28);
		return { length * std::cos(angle), length * std::sin(angle), Between(-1.5, 1.5), Between(-1.5, 1.5) };
	}
};

/// The point, and the sines p = b / sqrt(1 + b.b).
void Canonical(const R4& ray, Real z[4])
{
	const Real length = std::sqrt(1 + ray.slope_x * ray.slope_x + ray.slope_y * ray.slope_y);
	z[0] = ray.x;
	z[1] = ray.y;
	z[2] = ray.slope_x / length;
	z[3] = ray.slope_y / length;
}

R4 Moved(R4 ray, int i, Real by)
{
	(i == 0 ? ray.x : i == 1 ? ray.y : i == 2 ? ray.slope_x : ray.slope_y) += by;
	return ray;
}

/// J^T W J of the canonical coordinates by the image-side ray's numbers, by central differences: of the object's ray, less that of the image's. Largest element.
Real EtendueError(const RealLens<Real>& lens, const R4& ray)
{
	const Real h = 1e-6L;
	Real after[4][4], before[4][4];
	for(int j = 0; j < 4; j++)
	{
		Real z[4][4];
		Canonical(Moved(ray, j, h), z[0]);
		Canonical(Moved(ray, j, -h), z[1]);
		Canonical(ObjectSideRay(lens, Moved(ray, j, h)), z[2]);
		Canonical(ObjectSideRay(lens, Moved(ray, j, -h)), z[3]);
		for(int i = 0; i < 4; i++)
		{
			before[i][j] = (z[0][i] - z[1][i]) / (2 * h);
			after[i][j] = (z[2][i] - z[3][i]) / (2 * h);
		}
	}
	Real worst = 0;
	for(int a = 0; a < 4; a++)
		for(int b = 0; b < 4; b++)
		{
			Real object = 0, image = 0;
			for(int k = 0; k < 2; k++)
			{
				object += after[k][a] * after[k + 2][b] - after[k + 2][a] * after[k][b];
				image += before[k][a] * before[k + 2][b] - before[k + 2][a] * before[k][b];
			}
			worst = std::max(worst, std::fabs(object - image));
		}
	return worst;
}

}

// Lengths in units of the focal length, so that points and slopes are alike. By central differences in long double, whose errors of h^2 and of rounding over h are
// some 1e-12.
TEST(ObliquePupil, LightKeepsItsEtendue)
{
	Random random;
	for(int i = 0; i < 200; i++)
	{
		RealLens<Real> lens = { random.Between(0.4, 2.5), 1, { {}, 0.2L }, true };
		// Next to the middles of the pupils, whatever the slope.
		EXPECT_LT(double(EtendueError(lens, { 0, 0, random.Between(-0.8, 0.8), random.Between(-0.8, 0.8) })), 1e-9);
		// Nor elsewhere, where a map that leaves S alone misses it by the second order.
		const R4 ray = { random.Between(-0.4, 0.4), random.Between(-0.4, 0.4), random.Between(-0.4, 0.4), random.Between(-0.4, 0.4) };
		const auto error = [&](Real scale) { return EtendueError(lens, { scale * ray.x, scale * ray.y, scale * ray.slope_x, scale * ray.slope_y }); };
		EXPECT_LT(double(error(1)), 1e-9) << i;
		lens.etendue = false;
		EXPECT_NEAR(double(error(0.1L) / error(0.05L)), 4, 0.5) << i;
	}
}

// It is one to one, and goes back to rounding: of numbers of some ones, over what the last sine leaves below 1.
TEST(ObliquePupil, GoesBack)
{
	Random random;
	for(int i = 0; i < 100000; i++)
	{
		const double m = double(random.Between(0.3, 3)), power = double(random.Between(0.01, 2));
		const R4 r = random.Ray(power);
		const PupilRay<double> ray = { double(r.x), double(r.y), double(r.slope_x), double(r.slope_y) };
		const Across<double> x = ChangeOfObliquePupil(m, power, ray, 0.0, 0.0, { 1, 0, 0, 0 }), y = ChangeOfObliquePupil(m, power, ray, 0.0, 0.0, { 0, 1, 0, 0 });
		ASSERT_GT(x.x * y.y - x.y * y.x, 0);
		PupilRay<double> back;
		ASSERT_TRUE(UprightPupil(m, power, ObliquePupil(m, power, ray), back));
		ASSERT_NEAR(back.x * power, ray.x * power, 1e-11);
		ASSERT_NEAR(back.y * power, ray.y * power, 1e-11);
		ASSERT_EQ(back.slope_x, ray.slope_x);
		// No power, and next to none: the limit.
		const PupilRay<double> none = ObliquePupil(m, 0.0, ray), little = ObliquePupil(m, 1e-9 * power, ray);
		ASSERT_NEAR(none.x * power, little.x * power, 1e-7);
	}
	PupilRay<double> back;
	EXPECT_FALSE(UprightPupil(1.0, 1.0, { 1.5, 0, 0, 0 }, back)) << "at infinity on the axis: wider than f/0.5";
}

TEST(ObliquePupil, ItsChangeIsThatOfDifferences)
{
	Random random;
	const Real h = 1e-6L;
	for(int i = 0; i < 200; i++)
	{
		const Real m = random.Between(0.4, 2.5), power = random.Between(0.3, 2);
		const R4 ray = random.Ray(power);
		const auto expect = [&](const R4& plus, const R4& minus, const Across<Real>& change)
		{
			EXPECT_NEAR(double(change.x - (plus.x - minus.x) / (2 * h)), 0, 1e-9);
			EXPECT_NEAR(double(change.y - (plus.y - minus.y) / (2 * h)), 0, 1e-9);
		};
		for(int j = 0; j < 4; j++)
			expect(ObliquePupil(m, power, Moved(ray, j, h)), ObliquePupil(m, power, Moved(ray, j, -h)), ChangeOfObliquePupil<Real>(m, power, ray, 0, 0, Moved({ 0, 0, 0, 0 }, j, 1)));
		expect(ObliquePupil<Real>(m + h, power, ray), ObliquePupil<Real>(m - h, power, ray), ChangeOfObliquePupil<Real>(m, power, ray, 1, 0, {}));
		expect(ObliquePupil<Real>(m, power + h, ray), ObliquePupil<Real>(m, power - h, ray), ChangeOfObliquePupil<Real>(m, power, ray, 0, 1, {}));
	}
}
