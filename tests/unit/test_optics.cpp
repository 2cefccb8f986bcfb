// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The optics header against the paper's equations and against geometrical optics
// that is done another way, in long double.
//
// Tolerance: a chain of about ten roundings, each of relative size 1.1e-16 and
// amplified by at most ten in these well-conditioned cases: 1e-13 is generous and
// would still show any wrong sign, factor or angle.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lens/optics.h"

using namespace tilt_lens;

namespace
{

typedef Vec3<double> V;
typedef Vec3<long double> VL;
const double Tolerance = 1e-13;
const double Deg = M_PI / 180.0;

V From(const VL& a) { return { double(a.x), double(a.y), double(a.z) }; }

void ExpectSameDirection(const V& a, const V& b, double tolerance)
{
	const V u = Normalized(a), w = Normalized(b);
	EXPECT_NEAR(u.x, w.x, tolerance);
	EXPECT_NEAR(u.y, w.y, tolerance);
	EXPECT_NEAR(u.z, w.z, tolerance);
}

/// The image of P through a thin lens by construction, not by the lens equation:
/// the ray through the centre is straight, the ray parallel to the lens axis goes
/// through the rear focal point. n: unit lens normal, f: focal length.
VL ImageByConstruction(const VL& P, const VL& n, long double f)
{
	const VL foot = P - Dot(n, P) * n;            // where the parallel ray meets the lens plane
	const VL focus = (-f) * n;
	const VL d = focus - foot;
	// a P = foot + b d, solved in the least-squares sense (the lines meet).
	const VL c = Cross(P, d);
	const long double a = Dot(Cross(foot, d), c) / Dot(c, c);
	return a * P;
}

}

// (1) tan theta_L = w tan theta_F / (U + w)
TEST(Optics, LensTiltIsThePapersEquation1)
{
	for(double U : { 618.4, 3.0, 1e5 })
		for(double w : { 55.39, 0.02 })
			for(double tilt : { -80.0, -5.0, 0.0, 1e-6, 30.0, 89.0 })
			{
				const V q = PlaneAtDistance(FocalPlaneDirection(tilt * Deg, 0.0), 1.0 / U);
				const Lens<double> lens = LensFromPlane(q, 1.0 / w);
				const long double expected = (long double)w * std::tan((long double)(tilt * Deg)) / ((long double)U + w);
				EXPECT_NEAR(-lens.normal.y / lens.normal.z, double(expected), Tolerance * std::fabs(double(expected)));
				EXPECT_EQ(lens.normal.x, 0.0);
			}
}

// (2) b = w d |1/U - 1/z|
TEST(Optics, BlurOfAnUntiltedLensIsThePapersEquation2)
{
	const double w = 55.39, d = 18.81, U = 618.4;
	const V q = PlaneAtDistance(V{ 0, 0, 1 }, 1.0 / U);
	for(double z : { 100.0, 618.4, 2000.0, 1e9 })
	{
		const double b = SignedBlurWidth(w, d, q, V{ 30.0, -20.0, z });
		// Relative to the terms of the difference, which cancel near the focus.
		EXPECT_NEAR(std::fabs(b), w * d * std::fabs(1 / U - 1 / z), Tolerance * w * d * (1 / U + 1 / z));
		EXPECT_EQ(b > 1e-12, z < U) << "positive means nearer than the focus";
	}
}

// (5) and (6), where they are well conditioned
TEST(Optics, RayIsThePapersCases5And6)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> uniform(-1.0, 1.0);
	int front = 0, behind = 0;
	for(int i = 0; i < 10000; i++)
	{
		const V q = { uniform(random), uniform(random), uniform(random) };
		const V v = { uniform(random), uniform(random), 1.0 };
		const V S = { 0.2 * uniform(random), 0.2 * uniform(random), 0.1 * uniform(random) };
		const double kappa = InverseFocusDistance(q, v);
		if(std::fabs(kappa) < 0.05)
			continue;
		const VL Pf = (1.0L / kappa) * VL{ v.x, v.y, v.z };
		const VL SL = { S.x, S.y, S.z };
		const VL R = kappa > 0 ? Pf - SL : SL - Pf;
		ExpectSameDirection(RayDirection(v, S, kappa), From(R), Tolerance);
		(kappa > 0 ? front : behind)++;
	}
	EXPECT_GT(front, 1000);
	EXPECT_GT(behind, 1000);
}

TEST(Optics, RaysOfAPixelMeetOnThePlaneOfFocus)
{
	const V q = PlaneAtDistance(FocalPlaneDirection(55.0 * Deg, 40.0 * Deg), 1.0 / 12.0);
	const V v = { 0.3, -0.2, 1.0 };
	const double kappa = InverseFocusDistance(q, v);
	const V Pf = (1.0 / kappa) * v;
	const Lens<double> lens = LensFromPlane(q, 1.0 / 1.5);
	const LensBasis<double> basis = BasisOfLensPlane(lens.normal);
	for(double phi = 0.0; phi < 6.0; phi += 0.7)
	{
		const V S = 0.4 * (std::cos(phi) * basis.a + std::sin(phi) * basis.b);
		const V R = RayDirection(v, S, kappa);
		// S + R / kappa is where the ray has come after the focal distance.
		const V P = S + (1.0 / kappa) * R;
		EXPECT_NEAR(Length(P - Pf), 0.0, Tolerance * Length(Pf));
		EXPECT_NEAR(Dot(q, P), 1.0, 1e-12);
		EXPECT_NEAR(Dot(R, lens.normal), Dot(v, lens.normal), Tolerance);
	}
}

TEST(Optics, PlaneRecedesTowardsTheTiltDirection)
{
	const double U = 10.0, tilt = 40.0 * Deg;
	for(double phi : { 0.0, 60.0, 90.0, -130.0, 180.0 })
	{
		const V q = PlaneAtDistance(FocalPlaneDirection(tilt, phi * Deg), 1.0 / U);
		const double ex = std::sin(phi * Deg), ey = std::cos(phi * Deg);
		for(double s : { -3.0, 0.0, 2.0 })
			EXPECT_NEAR(Dot(q, V{ s * ex, s * ey, U + s * std::tan(tilt) }), 1.0, Tolerance * 10);
		EXPECT_NEAR(AngleFromAxis(q), tilt, Tolerance);
		EXPECT_NEAR(std::remainder(TiltDirection(q) - phi * Deg, 2 * M_PI), 0.0, Tolerance);
	}
}

// The vector lens equation against the construction of an image, point by point:
// what lies on the plane q is imaged on the sensor z = -w, off it is not.
TEST(Optics, VectorLensEquationIsGeometricalOptics)
{
	for(double tilt : { 0.0, 35.0, -70.0 })
		for(double phi : { 0.0, 75.0, -130.0 })
		{
			const VL q = PlaneAtDistance(FocalPlaneDirection<long double>(tilt * Deg, phi * Deg), 1.0L / 600.0L);
			const long double w = 48.2L;
			const Lens<long double> lens = LensFromPlane(q, 1.0L / w);
			const long double f = 1.0L / lens.power;
			for(long double x : { -150.0L, 20.0L })
				for(long double y : { -80.0L, 110.0L })
				{
					const long double z = (1.0L - q.x * x - q.y * y) / q.z;
					if(z < 2.0L * f)
						continue;
					EXPECT_NEAR(double(ImageByConstruction({ x, y, z }, lens.normal, f).z), double(-w), 1e-12);
					EXPECT_GT(std::fabs(double(ImageByConstruction({ x, y, 1.1L * z }, lens.normal, f).z + w)), 1e-3);
				}
		}
}

TEST(Optics, PlaneLensAndSensorGiveEachOtherBack)
{
	std::mt19937 random(2);
	std::uniform_real_distribution<double> uniform(-1.0, 1.0);
	for(int i = 0; i < 1000; i++)
	{
		const V q = { 0.5 * uniform(random), 0.5 * uniform(random), uniform(random) };
		const double inverse_w = 1.5 + uniform(random) * 0.4;
		const Lens<double> lens = LensFromPlane(q, inverse_w);
		const V back = PlaneFromLens(lens.normal, lens.power, inverse_w);
		EXPECT_NEAR(Length(back - q), 0.0, Tolerance * 10);
		EXPECT_NEAR(Length(lens.normal), 1.0, Tolerance);
		EXPECT_NEAR(InverseImageDistance(q, lens.power), inverse_w, Tolerance * 100);
		const V tilted = PlaneFromLensTilt(lens.normal, inverse_w, q.z);
		EXPECT_NEAR(Length(tilted - q), 0.0, Tolerance * 10);
		const V P = { uniform(random), uniform(random), 3.0 };
		const V through = PlaneFromLensTilt(lens.normal, inverse_w, InverseDistanceThroughPoint(lens.normal, inverse_w, P));
		EXPECT_NEAR(Dot(through, P), 1.0, 1e-11);
	}
}

TEST(Optics, LensBasisIsOrthonormalAndLiesInTheLensPlane)
{
	for(double tilt : { 0.0, 1e-9, 5.0, 60.0, 89.999 })
		for(double phi : { 0.0, 33.0, 90.0, 200.0 })
		{
			const V n = LensNormalFromTilt(tilt * Deg, phi * Deg);
			const LensBasis<double> b = BasisOfLensPlane(n);
			EXPECT_NEAR(Dot(b.a, n), 0.0, Tolerance);
			EXPECT_NEAR(Dot(b.b, n), 0.0, Tolerance);
			EXPECT_NEAR(Dot(b.a, b.b), 0.0, Tolerance);
			EXPECT_NEAR(Length(b.a), 1.0, Tolerance);
			EXPECT_NEAR(Length(b.b), 1.0, Tolerance);
		}
}

// A point is seen through S in the direction whose ray from S passes the point.
TEST(Optics, PointIsSeenThroughALensPointWhereItsRayComesFrom)
{
	const V q = PlaneAtDistance(FocalPlaneDirection(-62.0 * Deg, 10.0 * Deg), 1.0 / 7.0);
	const Lens<double> lens = LensFromPlane(q, 1.0);
	const LensBasis<double> basis = BasisOfLensPlane(lens.normal);
	const V S = 0.3 * basis.a - 0.2 * basis.b;
	for(const V& P : { V{ 1, 2, 5 }, V{ -2, 0.5, 9 }, V{ 0, 0, 40 } })
	{
		const V v = PixelDirectionThroughLensPoint(P, S, q);
		EXPECT_EQ(v.z, 1.0);
		ExpectSameDirection(RayDirection(v, S, InverseFocusDistance(q, v)), P - S, Tolerance * 10);
	}
}
