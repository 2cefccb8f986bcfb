// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The map of a real lens: what it must be by construction, and the lens of a textbook, by Seidel's sums and by rays traced
// through its spheres (support/sphere_tracer.h).

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/aberrations.h"
#include "lens/optics.h"
#include "support/sphere_tracer.h"

using namespace tilt_lens;
using sphere_tracer::Real;

namespace
{

typedef PupilRay<Real> R4;

std::mt19937_64 Generator(uint64_t seed)
{
	return std::mt19937_64(seed);
}

double Uniform(std::mt19937_64& random, double low, double high)
{
	return std::uniform_real_distribution<double>(low, high)(random);
}

R4 RandomRay(std::mt19937_64& random, Real radius)
{
	return { radius * Uniform(random, -0.7, 0.7), radius * Uniform(random, -0.7, 0.7), Uniform(random, -0.4, 0.4), Uniform(random, -0.4, 0.4) };
}

/// All numbers, of a size that does not fold.
Aberrations<Real> RandomAberrations(std::mt19937_64& random, double size)
{
	Aberrations<Real> a;
	a.radius = Uniform(random, 1, 10);
	for(Real& c : a.c)
		c = a.radius * Uniform(random, -size, size);
	return a;
}

Real Get(const R4& ray, int i, Real radius)
{
	return i == 0 ? ray.x / radius : i == 1 ? ray.y / radius : i == 2 ? ray.slope_x : ray.slope_y;
}

R4 Moved(R4 ray, int i, Real by, Real radius)
{
	(i == 0 ? ray.x : i == 1 ? ray.y : i == 2 ? ray.slope_x : ray.slope_y) += by * (i < 2 ? radius : 1);
	return ray;
}

/// The derivative by central differences, with an error of h^2 and of rounding over h.
void Differences(const Aberrations<Real>& a, const R4& ray, Real J[4][4])
{
	const Real h = 1e-6L;
	for(int j = 0; j < 4; j++)
	{
		const R4 plus = Aberrate(a, Moved(ray, j, h, a.radius)), minus = Aberrate(a, Moved(ray, j, -h, a.radius));
		for(int i = 0; i < 4; i++)
			J[i][j] = (Get(plus, i, a.radius) - Get(minus, i, a.radius)) / (2 * h);
	}
}

/// Largest element of J^T W J - W, W the symplectic form of (q, b).
Real SymplecticError(const Real J[4][4])
{
	Real worst = 0;
	for(int i = 0; i < 4; i++)
		for(int j = 0; j < 4; j++)
		{
			Real sum = 0;
			for(int k = 0; k < 2; k++)
				sum += J[k][i] * J[k + 2][j] - J[k + 2][i] * J[k][j];
			worst = std::max(worst, std::fabs(sum - (j == i + 2 ? 1 : i == j + 2 ? -1 : 0)));
		}
	return worst;
}

}

// A pixel v of a camera with the plane of focus q sees R = v - kappa S: by the real lens with all numbers 0, m = 1 and the power of
// the vector lens equation, from the sensor's point -w v, in the lens's own axes. To 1e-15 of numbers of the size of 1.
TEST(Aberrations, WithoutNumbersItIsTheTiltedThinLens)
{
	std::mt19937_64 random = Generator(1);
	for(int i = 0; i < 1000; i++)
	{
		const Vec3<Real> q = { Uniform(random, -0.1, 0.1), Uniform(random, -0.1, 0.1), Uniform(random, -0.1, 0.3) };
		const Real w = Uniform(random, 0.8, 1.5);
		const Lens<Real> thin = LensFromPlane<Real>(q, 1 / w);
		const LensBasis<Real> basis = BasisOfLensPlane(thin.normal);
		const Vec3<Real> v = { Uniform(random, -0.5, 0.5), Uniform(random, -0.5, 0.5), 1 };
		const Real x = Uniform(random, -0.2, 0.2), y = Uniform(random, -0.2, 0.2);
		const Vec3<Real> S = x * basis.a + y * basis.b, R = RayDirection(v, S, InverseFocusDistance(q, v));

		RealLens<Real> lens = { 1, thin.power, { {}, 0.2L } };
		const Vec3<Real> sensor = -w * v;
		const R4 image = RayToSensor(x, y, Dot(sensor, basis.a), Dot(sensor, basis.b), -Dot(sensor, thin.normal));
		const R4 ray = ObjectSideRay(lens, image);
		EXPECT_EQ(ray.x, x);
		EXPECT_EQ(ray.y, y);
		const Real depth = Dot(v, thin.normal);
		EXPECT_NEAR(double(depth * ray.slope_x - Dot(R, basis.a)), 0, 1e-15);
		EXPECT_NEAR(double(depth * ray.slope_y - Dot(R, basis.b)), 0, 1e-15);
		EXPECT_NEAR(double(Dot(R, thin.normal) - depth), 0, 1e-15);

		// And as the renderer steps: nothing at all changes a ray that has R already, nor in double.
		const PupilRay<double> step = { double(x), double(y), double(image.slope_x), double(image.slope_y) };
		const PupilRay<double> same = Aberrate<false>(Aberrations<double>{ {}, 0.2 }, step);
		EXPECT_EQ(same.x, step.x);
		EXPECT_EQ(same.slope_y, step.slope_y);
	}
}

// The closed formulas of MODEL.md, one number at a time, for q = (x, y), b = (t, 0).
TEST(Aberrations, EachClassicalTermIsItsFormula)
{
	const double r = 5, c = 0.02, x = 0.6, y = -0.3, t = 0.35;
	const double P = t * t, R = t * x, Q = x * x + y * y;
	const struct { AberrationTerm term; double S_x, S_y, b_x, b_y; } formulas[] =
	{
		{ Spherical, 0, 0, 4 * c * Q * x / r, 4 * c * Q * y / r },
		{ Coma, -c * Q * x, -c * Q * y, c * (Q * t + 2 * R * x) / r, c * 2 * R * y / r },
		{ Astigmatism, -2 * c * R * x, -2 * c * R * y, 2 * c * R * t / r, 0 },
		{ Curvature, -2 * c * Q * t, 0, 2 * c * P * x / r, 2 * c * P * y / r },
		{ Distortion, -c * (2 * R * t + P * x), -c * P * y, c * P * t / r, 0 },
		{ PupilAberration, -4 * c * P * t, 0, 0, 0 }
	};
	for(const auto& f : formulas)
	{
		Aberrations<double> a = { {}, r };
		a.c[f.term] = c;
		const PupilRay<double> ray = Aberrate(a, PupilRay<double>{ r * x, r * y, t, 0 });
		EXPECT_NEAR(ray.x - r * x, f.S_x, 1e-15) << f.term;
		EXPECT_NEAR(ray.y - r * y, f.S_y, 1e-15) << f.term;
		EXPECT_NEAR(ray.slope_x - t, f.b_x, 1e-15) << f.term;
		EXPECT_NEAR(ray.slope_y, f.b_y, 1e-15) << f.term;
	}
}

// g is the sum that the table of powers says; its gradient, its second derivatives and the map's Jacobian are its differences.
TEST(Aberrations, DerivativesAreThoseOfTheSum)
{
	std::mt19937_64 random = Generator(2);
	for(int i = 0; i < 100; i++)
	{
		const Aberrations<Real> a = RandomAberrations(random, 0.1);
		const Real v[3] = { Uniform(random, 0, 0.3), Uniform(random, -0.3, 0.3), Uniform(random, 0, 1) };
		Real sum = 0;
		for(int k = 0; k < AberrationTerms; k++)
			sum += a.c[k] * std::pow(v[0], AberrationPowers[k][0]) * std::pow(v[1], AberrationPowers[k][1]) * std::pow(v[2], AberrationPowers[k][2]);
		EXPECT_NEAR(double(AberrationFunction(a.c, v[0], v[1], v[2]) - sum), 0, 1e-17);

		const auto gradient = [&](Real P, Real R, Real Q) -> Vec3<Real>
		{
			const AberrationGradient<Real> third = ThirdOrderGradient(a.c, P, R, Q), fifth = FifthOrderGradient(a.c, P, R, Q);
			return { third.P + fifth.P, third.R + fifth.R, third.Q + fifth.Q };
		};
		const AberrationHessian<Real> h = HessianOfAberrations(a.c, v[0], v[1], v[2]);
		const Real second[3][3] = { { h.PP, h.PR, h.PQ }, { h.PR, h.RR, h.RQ }, { h.PQ, h.RQ, h.QQ } };
		const Vec3<Real> g = gradient(v[0], v[1], v[2]);
		const Real first[3] = { g.x, g.y, g.z }, step = 1e-5L;
		for(int k = 0; k < 3; k++)
		{
			const Real dP = k == 0 ? step : 0, dR = k == 1 ? step : 0, dQ = k == 2 ? step : 0;
			// Cubic: the difference's error is step^2 times the third derivative, below 6 c.
			const Real difference = (AberrationFunction(a.c, v[0] + dP, v[1] + dR, v[2] + dQ) - AberrationFunction(a.c, v[0] - dP, v[1] - dR, v[2] - dQ)) / (2 * step);
			EXPECT_NEAR(double(difference - first[k]), 0, 1e-9);
			const Vec3<Real> change = (1 / (2 * step)) * (gradient(v[0] + dP, v[1] + dR, v[2] + dQ) - gradient(v[0] - dP, v[1] - dR, v[2] - dQ));
			EXPECT_NEAR(double(change.x - second[k][0]), 0, 1e-9);
			EXPECT_NEAR(double(change.y - second[k][1]), 0, 1e-9);
			EXPECT_NEAR(double(change.z - second[k][2]), 0, 1e-9);
		}
		const R4 ray = RandomRay(random, a.radius);
		Real J[4][4], differences[4][4];
		AberrationJacobian(a, ray, J);
		Differences(a, ray, differences);
		for(int k = 0; k < 16; k++)
			EXPECT_NEAR(double(J[k / 4][k % 4] - differences[k / 4][k % 4]), 0, 1e-10);
	}
}

// The map is linear in c: its derivative by one of them is the map of that one alone, less the identity, wherever the others stand.
TEST(Aberrations, DerivativeByCoefficientsIsOfTheMap)
{
	std::mt19937_64 random = Generator(5);
	for(int i = 0; i < 100; i++)
	{
		Aberrations<Real> a = RandomAberrations(random, 0.05), alone = a;
		const R4 ray = RandomRay(random, a.radius);
		PupilRay<Real> by[AberrationTerms];
		AberrateByCoefficients(a, ray, by);
		for(int term = 0; term < AberrationTerms; term++)
		{
			for(int k = 0; k < AberrationTerms; k++)
				alone.c[k] = k == term ? 1.0L : 0.0L;
			const R4 seen = Aberrate<true>(alone, ray);
			// Some ten operations of long double on numbers up to 10, and what is left of their difference.
			EXPECT_NEAR(double(seen.x - ray.x - by[term].x), 0, 1e-16) << term;
			EXPECT_NEAR(double(seen.y - ray.y - by[term].y), 0, 1e-16) << term;
			EXPECT_NEAR(double(seen.slope_x - ray.slope_x - by[term].slope_x), 0, 1e-16) << term;
			EXPECT_NEAR(double(seen.slope_y - ray.slope_y - by[term].slope_y), 0, 1e-16) << term;
		}
	}
}

// Twice the numbers, four times the error, for every term and for all of them: symplectic but for g squared.
TEST(Aberrations, IsSymplecticToItsOrder)
{
	std::mt19937_64 random = Generator(3);
	for(int term = -1; term < AberrationTerms; term++)
		for(int i = 0; i < 20; i++)
		{
			Aberrations<Real> a = RandomAberrations(random, 0.01);
			for(int k = 0; k < AberrationTerms; k++)
				a.c[k] *= term < 0 || k == term;
			const R4 ray = RandomRay(random, a.radius);
			Real J[4][4];
			Differences(a, ray, J);
			const Real once = SymplecticError(J);
			for(Real& c : a.c)
				c *= 2;
			Differences(a, ray, J);
			const Real twice = SymplecticError(J);
			// The differences themselves err by 1e-11. Fourth powers stand beside the squares: a percent.
			EXPECT_NEAR(double(twice), double(4 * once), 0.01 * double(twice) + 1e-10) << term;
			EXPECT_LT(double(once), 0.02) << "squares of some hundredths at most";
		}
	// Not so where the shift is no gradient.
	Real J[4][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0.01L, 0, 1, 0 }, { 0.02L, 0.01L, 0, 1 } };
	EXPECT_GT(double(SymplecticError(J)), 0.01);
}

TEST(Aberrations, NewtonGoesBack)
{
	std::mt19937_64 random = Generator(4);
	int folded = 0;
	for(int i = 0; i < 300; i++)
	{
		const Aberrations<Real> wide = RandomAberrations(random, 0.04);
		RealLens<double> lens = { Uniform(random, 0.5, 2), Uniform(random, 0.01, 1), { {}, double(wide.radius) }, i % 2 == 1 };
		for(int k = 0; k < AberrationTerms; k++)
			lens.aberrations.c[k] = double(wide.c[k]);
		if(FindFold(lens.aberrations, 0.6, 1).folds)
		{
			folded++;
			continue;
		}
		const R4 r = RandomRay(random, wide.radius);
		const PupilRay<double> image = BehindLinearLens(lens.pupil_magnification, lens.power, PupilRay<double>{ double(r.x), double(r.y), double(r.slope_x), double(r.slope_y) });
		PupilRay<double> back;
		ASSERT_TRUE(ImageSideRay(lens, ObjectSideRay(lens, image), back));
		// 1e-9 is asked for; it goes to rounding, which the etendue's way back from a sine to its tangent t multiplies by (1 + t^2)^(3/2).
		const double t = lens.etendue ? std::hypot(image.slope_x, image.slope_y) : 0;
		const double scale = (std::fabs(image.x) + std::fabs(image.y) + std::fabs(image.slope_x) + std::fabs(image.slope_y) + 1) * std::pow(1 + t * t, 1.5);
		EXPECT_LT(std::fabs(back.x - image.x) + std::fabs(back.y - image.y), 1e-12 * scale);
		EXPECT_LT(std::fabs(back.slope_x - image.slope_x) + std::fabs(back.slope_y - image.slope_y), 1e-12 * scale);
	}
	EXPECT_LT(folded, 60) << "most do not";
}

// Any lens, of any size of numbers: never a NaN; where the inverse says that it has found the ray, it has.
TEST(Aberrations, AMillionRandomLensesGiveNumbers)
{
	std::mt19937_64 random = Generator(5);
	const auto magnitude = [&](double low, double high) { return std::pow(10.0, Uniform(random, low, high)); };
	int found = 0, lost = 0;
	for(int i = 0; i < 1000000; i++)
	{
		RealLens<double> lens = { magnitude(-2, 2), magnitude(-6, 6), { {}, magnitude(-6, 6) }, i % 2 == 1 };
		if(lens.etendue)
			lens.power = magnitude(-6, 0) / lens.aberrations.radius;   // up to f/0.5, where a sine is 1
		const double size = lens.aberrations.radius * magnitude(-6, 0);
		for(double& c : lens.aberrations.c)
			c = size * Uniform(random, -1, 1);
		const double r = lens.aberrations.radius;
		const PupilRay<double> linear = { r * Uniform(random, -1, 1), r * Uniform(random, -1, 1), Uniform(random, -1, 1), Uniform(random, -1, 1) };
		const PupilRay<double> image = BehindLinearLens(lens.pupil_magnification, lens.power, linear), object = ObjectSideRay(lens, image);
		ASSERT_TRUE(std::isfinite(object.x) && std::isfinite(object.y) && std::isfinite(object.slope_x) && std::isfinite(object.slope_y));
		// Without the linear part, whose slopes of up to 1e12 would take the digits.
		PupilRay<double> upright = object, back;
		if((lens.etendue && !UprightPupil(lens.pupil_magnification, lens.power, object, upright)) || !Unaberrate(lens.aberrations, upright, back))
		{
			lost++;
			continue;
		}
		found++;
		ASSERT_TRUE(std::isfinite(back.x) && std::isfinite(back.y) && std::isfinite(back.slope_x) && std::isfinite(back.slope_y));
		PupilRay<double> again = Aberrate(lens.aberrations, back);
		if(lens.etendue)
			again = ObliquePupil(lens.pupil_magnification, lens.power, again);
		ASSERT_LT(std::fabs(again.x - object.x) + std::fabs(again.y - object.y), 1e-9 * (r + std::fabs(object.x) + std::fabs(object.y)));
		ASSERT_LT(std::fabs(again.slope_x - object.slope_x) + std::fabs(again.slope_y - object.slope_y), 1e-9 * (1 + std::fabs(object.slope_x) + std::fabs(object.slope_y)));
	}
	// Numbers as large as the radius fold often, those below a hundredth never.
	EXPECT_GT(found, 600000);
	EXPECT_GT(lost, 10000);
}

// Distortion alone, at q = 0: the determinant of the radial part is (1 + 3 p)(1 - 3 p), p = P c / r, by hand; it folds at p = 1/3 either way.
TEST(Aberrations, FoldsWhereTheFormulaSays)
{
	for(double sign : { -1.0, 1.0 })
	{
		Aberrations<double> a = { {}, 2.0 };
		a.c[Distortion] = sign * 2.0;       // folds at P = 1/3 on the chief rays
		EXPECT_FALSE(FindFold(a, 0.99 * std::sqrt(1 / 3.0), 0).folds);
		EXPECT_TRUE(FindFold(a, 1.01 * std::sqrt(1 / 3.0), 0).folds);
		EXPECT_GT(AberrationDeterminant(a, PupilRay<double>{ 0, 0, 0.57, 0 }), 0);
		EXPECT_LT(AberrationDeterminant(a, PupilRay<double>{ 0, 0, 0.58, 0 }), 0);
		// Nor does Newton pretend to have found what the centre's branch does not reach.
		PupilRay<double> ray;
		EXPECT_TRUE(Unaberrate(a, Aberrate(a, PupilRay<double>{ 0, 0, 0.5, 0 }), ray));
		EXPECT_NEAR(ray.slope_x, 0.5, 1e-12);
	}
	// Spherical aberration of any size shears, and never folds.
	const Aberrations<double> sphere = { { 1000.0 }, 2.0 };
	EXPECT_FALSE(FindFold(sphere, 1, 1).folds);
	EXPECT_TRUE(FindFold({ { HUGE_VAL }, 2.0 }, 1, 1).folds) << "no number";
}
