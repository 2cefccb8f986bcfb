// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The optics header where it is hard: random cameras of all sizes, the plane of
// focus passing through infinity, and the limits of what doubles can say.

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "lens/optics.h"

using namespace tilt_lens;

namespace
{

template<typename T>
struct Camera
{
	T tilt, phi, inverse_U, inverse_w, radius, r, angle, vx, vy;
};

template<typename T>
struct Result
{
	Vec3<T> q, v, S, R;
};

/// The whole chain from the words of a scene to a ray.
template<typename T>
Result<T> Trace(const Camera<T>& c)
{
	using std::cos;
	using std::sin;
	Result<T> o;
	o.q = PlaneAtDistance(FocalPlaneDirection(c.tilt, c.phi), c.inverse_U);
	const Lens<T> lens = LensFromPlane(o.q, c.inverse_w);
	const LensBasis<T> basis = BasisOfLensPlane(lens.normal);
	o.S = (c.radius * c.r) * (cos(c.angle) * basis.a + sin(c.angle) * basis.b);
	o.v = { c.vx, c.vy, T(1) };
	o.R = RayDirection(o.v, o.S, InverseFocusDistance(o.q, o.v));
	return o;
}

Camera<long double> Exactly(const Camera<double>& c)
{
	return { c.tilt, c.phi, c.inverse_U, c.inverse_w, c.radius, c.r, c.angle, c.vx, c.vy };
}

/// A camera at a random scale between 1e-7 and 1e7, with any plane of focus.
Camera<double> RandomCamera(std::mt19937_64& random)
{
	std::uniform_real_distribution<double> u(0.0, 1.0);
	const double scale = std::pow(10.0, 14.0 * u(random) - 7.0);
	Camera<double> c;
	c.tilt = (u(random) - 0.5) * M_PI * (1.0 - std::pow(10.0, -10.0 * u(random)));
	c.phi = 2.0 * M_PI * u(random);
	c.inverse_U = (u(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, 4.0 * u(random) - 4.0) / scale;
	c.inverse_w = std::pow(10.0, 2.0 * u(random)) / scale;
	c.radius = std::pow(10.0, -3.0 * u(random)) * scale;
	c.r = std::sqrt(u(random));
	c.angle = 2.0 * M_PI * u(random);
	c.vx = 2.0 * u(random) - 1.0;
	c.vy = 2.0 * u(random) - 1.0;
	return c;
}

/// How much a relative change of the inputs is magnified in the direction of R:
/// the sizes of what is added, over the size of the sum.
double Condition(const Result<long double>& o)
{
	const long double terms = Length(o.v) + Length(o.q) * Length(o.v) * Length(o.S);
	return double(terms / Length(o.R));
}

}

// A million cameras in double against long double. "Well conditioned" is a
// condition number below 1000: twenty roundings of 1.1e-16, magnified by 1000,
// could reach 2e-12 if they all conspired; the bound asked for is 1e-12.
TEST(OpticsHard, MillionRandomCamerasAgreeWithLongDouble)
{
	std::mt19937_64 random(20240607);
	double worst = 0.0;
	int well = 0;
	for(int i = 0; i < 1000000; i++)
	{
		const Camera<double> c = RandomCamera(random);
		const Result<double> d = Trace(c);
		const Result<long double> l = Trace(Exactly(c));
		ASSERT_TRUE(std::isfinite(d.R.x) && std::isfinite(d.R.y) && std::isfinite(d.R.z)) << "camera " << i;
		if(Condition(l) > 1000.0)
			continue;
		well++;
		const Vec3<double> a = Normalized(d.R);
		const Vec3<long double> b = Normalized(l.R);
		const Vec3<long double> e = Vec3<long double>{ a.x, a.y, a.z } - b;
		worst = std::max(worst, double(Length(e)));
	}
	RecordProperty("well_conditioned", well);
	std::printf("well conditioned: %d of 1000000, worst relative error %.3g\n", well, worst);
	EXPECT_GT(well, 500000);
	EXPECT_LE(worst, 1e-12);
}

// R.n = v.n is why a ray never turns back. Relative to the sizes involved.
TEST(OpticsHard, RaysNeverTurnBack)
{
	std::mt19937_64 random(3);
	for(int i = 0; i < 100000; i++)
	{
		const Camera<double> c = RandomCamera(random);
		const Result<double> d = Trace(c);
		const Vec3<double> n = LensFromPlane(d.q, c.inverse_w).normal;
		ASSERT_NEAR(Dot(d.R, n), Dot(d.v, n), 1e-13 * (Length(d.v) + Length(d.q) * Length(d.v) * Length(d.S)));
	}
}

// kappa through 0 in steps of one ulp of the tilt: the direction may move from one
// step to the next by the true slope (a few ulps) and rounding, never by a jump.
TEST(OpticsHard, KappaThroughZeroInUlpsShowsNoJump)
{
	const Vec3<double> S = { 0.3, -0.2, 0.05 };
	const double vy = 0.4;
	double t = 1.0 / vy;                 // tan theta_F at which kappa = 0
	for(int i = 0; i < 200; i++)
		t = std::nextafter(t, 0.0);
	bool positive = false, negative = false;
	Vec3<double> before = {};
	for(int i = 0; i < 400; i++, t = std::nextafter(t, 10.0))
	{
		const Vec3<double> q = PlaneAtDistance(Vec3<double>{ 0.0, -t, 1.0 }, 1.0 / 5.0);
		const Vec3<double> v = { 0.1, vy, 1.0 };
		const double kappa = InverseFocusDistance(q, v);
		const Vec3<double> R = Normalized(RayDirection(v, S, kappa));
		(kappa > 0.0 ? positive : negative) = true;
		if(i > 0)
		{
			EXPECT_LE(MaxAbs(R - before), 4.0 * std::numeric_limits<double>::epsilon());
		}
		before = R;
	}
	EXPECT_TRUE(positive);
	EXPECT_TRUE(negative);
}

TEST(OpticsHard, PlanesThatOneDistanceCannotSay)
{
	const Vec3<double> v = { 0.2, -0.5, 1.0 };
	const Vec3<double> S = { 0.1, 0.05, 0.0 };
	// The ground y = -h, parallel to the axis: no finite U, a finite q.
	const Vec3<double> ground = PlaneThroughPoint(Vec3<double>{ 0, 1, 0 }, Vec3<double>{ 7, -1.5, 30 });
	EXPECT_DOUBLE_EQ(ground.y, -1.0 / 1.5);
	EXPECT_EQ(ground.z, 0.0);
	// The pixel looks down at 0.5 per unit of depth: it meets the ground at depth 3.
	EXPECT_DOUBLE_EQ(InverseFocusDistance(ground, v), 1.0 / 3.0);
	// Infinity, by itself, and as a number too large to divide by twice.
	for(double U : { std::numeric_limits<double>::infinity(), 1e300 })
	{
		const Vec3<double> q = PlaneAtDistance(FocalPlaneDirection(0.5, 0.3), 1.0 / U);
		const Vec3<double> R = RayDirection(v, S, InverseFocusDistance(q, v));
		EXPECT_EQ(R.x, v.x);
		EXPECT_EQ(R.y, v.y);
		EXPECT_EQ(R.z, 1.0);
	}
	// A virtual focus nearer than f: the lens is still a lens, only a stronger one.
	const Lens<double> strong = LensFromPlane(PlaneAtDistance(Vec3<double>{ 0, 0, 1 }, 1.0 / 0.01), 1.0);
	EXPECT_DOUBLE_EQ(strong.power, 101.0);
	// A plane 1e-7 behind the lens, nearer than the sensor: a diverging lens.
	const Lens<double> diverging = LensFromPlane(PlaneAtDistance(Vec3<double>{ 0, 0, 1 }, -1e7), 1.0);
	EXPECT_LT(diverging.power, 0.0);
	EXPECT_EQ(diverging.normal.z, 1.0);
}

// 1/w = -q_z + sqrt(1/f^2 - q_xy^2) next to its bound |q_xy| = 1/f: the product form
// against long double; the difference of squares would be off by 1e-8 here.
TEST(OpticsHard, ImageDistanceNearTheHingeBound)
{
	const double power = 1.0 / 45.0;
	for(double gap : { 1e-3, 1e-8, 1e-12, 1e-15 })
	{
		const double qxy = power * (1.0 - gap);
		const long double p = power, x = qxy;
		const long double expected = std::sqrt((p - x) * (p + x));
		EXPECT_NEAR(InverseImageDistance(Vec3<double>{ 0.0, qxy, 0.0 }, power), double(expected), 1e-15 * double(expected) * 4);
	}
	EXPECT_EQ(InverseImageDistance(Vec3<double>{ power, 0.0, 0.0 }, power), 0.0);
}
