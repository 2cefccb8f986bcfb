// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Vignetting: the natural one against the integral of Lambert's law over the opening, the
// optical one against rays that are followed to the rim, and against counting.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lens/natural_vignetting.h"
#include "lens/optical_vignetting.h"
#include "lens/optics.h"
#include "lens/pupil.h"

using namespace tilt_lens;

namespace
{

typedef Vec3<double> V;

const double Degree = 3.14159265358979323846 / 180.0;
const V Axis = { 0, 0, 1 };

/// Integral over a disc of the given radius around the lens centre of cos(lens) cos(sensor) / r^2, as seen from
/// the sensor's point -w v: midpoint rule in rings of equal area, in long double.
double Illuminance(const V& n, const V& v, double w, double radius)
{
	const int rings = 200, sectors = 256;
	const LensBasis<double> basis = BasisOfLensPlane(n);
	long double sum = 0;
	for(int i = 0; i < rings; i++)
		for(int k = 0; k < sectors; k++)
		{
			const double r = radius * std::sqrt((i + 0.5) / rings), phi = (k + 0.5) * 360 * Degree / sectors;
			const V S = (r * std::cos(phi)) * basis.a + (r * std::sin(phi)) * basis.b;
			const V d = S + w * v;          // from the sensor's point to the lens point
			sum += (long double)(Dot(d, n)) * Dot(d, Axis) / std::pow((long double)Dot(d, d), 2);
		}
	return double(sum / (rings * sectors)) * w * w;
}

}

TEST(NaturalVignetting, IsTheFourthPowerOfTheCosineWithoutTilt)
{
	for(double t : { 0.0, 5.0, 22.0, 60.0 })
		for(double azimuth : { 0.0, 70.0, 250.0 })
		{
			const V v = { 3 * std::tan(t * Degree) * std::sin(azimuth * Degree), 3 * std::tan(t * Degree) * std::cos(azimuth * Degree), 3 };
			EXPECT_NEAR(NaturalFalloff(Axis, Axis, v), std::pow(std::cos(t * Degree), 4), 1e-15);   // rounding
		}
}

// A lens of finite width d departs from the formula, which is that of a small one, by the order of (d/w)^2: 1e-6 at
// d = w/1000. At f/2.8 it is off by at most 4 % (30 degrees of tilt; 2 % at 5), four times as much as at f/5.6.
TEST(NaturalVignetting, IsTheIntegralOverASmallOpening)
{
	for(double tilt : { 0.0, 5.0, -30.0 })
	{
		const V n = LensNormalFromTilt(tilt * Degree, 20 * Degree);
		const V on_axis = (1 / n.z) * n;
		for(const V& v : { V{ 0, 0, 1 }, V{ 0.37, 0.25, 1 }, V{ -0.2, 0.3, 1 }, V{ 0.1, -0.6, 1 } })
		{
			const double falloff = NaturalFalloff(n, Axis, v);
			const auto integral = [&](double d) { return Illuminance(n, v, 1, d / 2) / Illuminance(n, on_axis, 1, d / 2); };
			EXPECT_NEAR(integral(1e-3), falloff, 2e-6) << tilt;
			const double wide = integral(1 / 2.8) - falloff, half = integral(1 / 5.6) - falloff;
			EXPECT_LT(std::fabs(wide), (std::fabs(tilt) > 5 ? 0.05 : 0.03) * falloff) << tilt;
			EXPECT_NEAR(half, wide / 4, 0.1 * std::fabs(wide) + 1e-6) << tilt;
		}
	}
}

TEST(NaturalVignetting, DoesNotDependOnTheLengthOfTheDirection)
{
	const V n = LensNormalFromTilt(7 * Degree, 0.0), v = { 0.2, -0.3, 1 };
	for(double s : { 1e-100, 48.2, 1e100 })
		EXPECT_NEAR(NaturalFalloff(n, Axis, s * v), NaturalFalloff(n, Axis, v), 1e-15);
}

// The rim's view of a ray that meets its plane at `met`, from its centre. Returns whether it passes.
bool ExpectMet(const RimView<double>& view, const V& S, const V& met, double R)
{
	EXPECT_NEAR(Length(view.scale * S + view.offset - met), 0, 1e-14);
	const bool passes = Length(met) <= R;
	EXPECT_EQ(PassesRim(view, S, R), passes);
	return passes;
}

// The ray R = v - kappa S followed to the plane n.P = Z. Random lenses, rounding only.
TEST(OpticalVignetting, AsksWhereTheRayMeetsTheRimsPlane)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> u(-1, 1);
	int passed = 0;
	for(int i = 0; i < 2000; i++)
	{
		const V n = LensNormalFromTilt(40 * Degree * u(random), 180 * Degree * u(random));
		const LensBasis<double> basis = BasisOfLensPlane(n);
		const V v = { 0.5 * u(random), 0.5 * u(random), 1 }, S = (0.4 * u(random)) * basis.a + (0.4 * u(random)) * basis.b;
		const double kappa = 2 * u(random), Z = 1.5 + u(random), R = 0.6 + 0.3 * u(random);
		const V direction = RayDirection(v, S, kappa);
		const V met = S + (Z / Dot(direction, n)) * direction;
		const RimView<double> view = ViewOfRim(n, 48.2 * v, 48.2 * kappa, Z);   // any length
		passed += ExpectMet(view, S, met - Z * n, R);
	}
	EXPECT_GT(passed, 400);
	EXPECT_LT(passed, 1600);
}

// Behind the lens the ray goes from S to a point of the sensor: the straight line between the two, in world coordinates. With pupils of
// different size it begins M S and ends M w behind.
TEST(OpticalVignetting, AsksWhereTheLightMeetsARimBehindTheLens)
{
	std::mt19937 random(2);
	std::uniform_real_distribution<double> u(-1, 1);
	int passed = 0;
	for(int i = 0; i < 2000; i++)
	{
		const V n = LensNormalFromTilt(20 * Degree * u(random), 180 * Degree * u(random)), e = { 0, 0, 1 };
		const LensBasis<double> basis = BasisOfLensPlane(n);
		const double w = 1.5 + 0.5 * u(random), M = 1 + 0.3 * u(random), Z = -0.4 * (1.01 + u(random)), R = 0.35 + 0.15 * u(random);
		const V S = (0.4 * u(random)) * basis.a + (0.4 * u(random)) * basis.b, p = { 0.5 * u(random), 0.5 * u(random), 1 };
		const V from = M * S, to = (-M * w) * p;
		const double t = (Z - Dot(from, n)) / (Dot(to, n) - Dot(from, n));
		const V met = from + t * (to - from);
		const RimView<double> view = ViewOfRimBehind(n, e, 48.2 * p, w, M, Z);   // any length
		passed += ExpectMet(view, S, met - Z * n, R);
	}
	EXPECT_GT(passed, 400);
	EXPECT_LT(passed, 1600);
}

// At the lens itself both views are the lens; at the sensor a rim is a disc on it, whatever the lens point.
TEST(OpticalVignetting, RimsAtTheLensAndAtTheSensor)
{
	const V e = { 0, 0, 1 }, p = { 0.3, -0.2, 1 }, S = { 0.1, 0.05, 0 };
	for(const RimView<double>& view : { ViewOfRim(e, p, 0.7, 0.0), ViewOfRimBehind(e, e, p, 2.0, 1.0, 0.0) })
	{
		EXPECT_EQ(view.scale, 1);
		EXPECT_EQ(Length(view.offset), 0);
	}
	const RimView<double> sensor = ViewOfRimBehind(e, e, p, 2.0, 1.0, -2.0);
	EXPECT_NEAR(sensor.scale, 0, 1e-15);
	EXPECT_NEAR(Length(sensor.offset + 2.0 * V{ 0.3, -0.2, 0 }), 0, 1e-15);
	EXPECT_TRUE(PassesRim(sensor, S, 0.722));   // 2 |p - e| = 0.7211
	EXPECT_FALSE(PassesRim(sensor, S, 0.720));
	EXPECT_TRUE(PassesRim(sensor, S, 1e30));
}

// 65536 points by the sampler's own map: their number follows the area to about 0.002.
TEST(OpticalVignetting, ShareIsThePartOfLensPointsThatPass)
{
	const V n = LensNormalFromTilt(5 * Degree, 0.0);
	const LensBasis<double> basis = BasisOfLensPlane(n);
	for(const V& v : { V{ 0, 0, 1 }, V{ 0.1, 0.1, 1 }, V{ 0.3, 0.2, 1 }, V{ 0.35, -0.25, 1 }, V{ 0, 0.9, 1 } })
		for(double kappa : { 0.0016, -0.01, 1 / 38.0, 0.05 })
		{
			const RimView<double> view = ViewOfRim(n, v, kappa, 38.0);
			int open = 0;
			for(int i = 0; i < 256; i++)
				for(int k = 0; k < 256; k++)
				{
					const PupilPoint p = SquareToDisc((i + 0.5) / 256, (k + 0.5) / 256);
					open += PassesRim(view, (8 * p.x) * basis.a + (8 * p.y) * basis.b, 16.3);
				}
			EXPECT_NEAR(OpenShare(view, 8.0, 16.3), open / 65536.0, 0.003) << v.x << " " << v.y << " " << kappa;
		}
}

// The four arrangements of two discs, and continuity where they touch: the area of a sliver goes with its width to the
// power 3/2, so 1e-9 away from touching there is less than 1e-12 of it.
TEST(OpticalVignetting, OverlapOfTwoDiscs)
{
	const double pi = 3.14159265358979323846;
	EXPECT_EQ(OverlapOfDiscs(1.0, 2.0, 3.5), 0);
	EXPECT_DOUBLE_EQ(OverlapOfDiscs(1.0, 2.0, 0.5), pi);
	EXPECT_DOUBLE_EQ(OverlapOfDiscs(2.0, 1.0, 0.0), pi);
	EXPECT_DOUBLE_EQ(OverlapOfDiscs(1.0, 1.0, 0.0), pi);
	// Two equal discs, each through the other's centre: 2 pi/3 - sqrt(3)/2.
	EXPECT_NEAR(OverlapOfDiscs(1.0, 1.0, 1.0), 2 * pi / 3 - std::sqrt(3.0) / 2, 1e-15);
	for(double step : { -1e-9, 1e-9 })
	{
		EXPECT_NEAR(OverlapOfDiscs(1.0, 2.0, 3 + step), 0, 1e-12);
		EXPECT_NEAR(OverlapOfDiscs(1.0, 2.0, 1 + step), pi, 1e-12);
		EXPECT_NEAR(OverlapOfDiscs(2.0, 1.0, 1 + step), pi, 1e-12);
	}
}
