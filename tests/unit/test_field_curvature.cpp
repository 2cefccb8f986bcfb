// SPDX-License-Identifier: AGPL-3.0-or-later
//
// field_curvature: the formula against its definition by angles and by finite
// differences, what the camera and the statistics do with it, and the refusals.

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/field_curvature.h"
#include "lens/lens_spec.h"
#include "lens/optics.h"
#include "lens/statistics.h"

using namespace tilt_lens;
using testing::HasSubstr;

namespace
{

const Vec3d Q = { 0.0004, -0.0021, 0.0015 };
const double C = -0.0012;
const double Degree = 3.14159265358979323846 / 180.0;

const CameraVectors Camera = { { 0, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 }, { 0, 1, 0 } };

bool Resolve(const LensSpec& spec, TiltLens& lens, std::string& error)
{
	return ResolveTiltLens(spec, Camera, lens, error);
}

}

// Directions at a known angle t from a tilted axis: the depth along the axis at which they
// are in focus is 1/(q.u + C tan^2 t) with u = v/(v.n). Rounding only: 1e-15 of kappa.
TEST(FieldCurvature, IsCTimesTheSquareOfTheTangentOfTheFieldAngle)
{
	const Vec3d n = LensNormalFromTilt(20 * Degree, 30 * Degree);
	const LensBasis<double> basis = BasisOfLensPlane(n);
	for(double t : { 0.0, 1.0, 20.0, 60.0, 89.0 })
		for(double azimuth : { 0.0, 77.0, 200.0 })
		{
			const Vec3d u = std::tan(t * Degree) * (std::cos(azimuth * Degree) * basis.a + std::sin(azimuth * Degree) * basis.b) + n;
			const double wanted = Dot(Q, u) + C * std::pow(std::tan(t * Degree), 2);
			EXPECT_NEAR(InverseFocusDistanceOnBowl(Q, C, n, u), wanted, 1e-15 * (1 + std::fabs(wanted) + std::pow(std::tan(t * Degree), 2)));
		}
}

// q.v, which it stands in for, is homogeneous of degree 1, and the calibrator puts points in.
TEST(FieldCurvature, IsHomogeneousOfDegreeOne)
{
	const Vec3d n = LensNormalFromTilt(-8 * Degree, 75 * Degree);
	const Vec3d v = { 0.3, -0.2, 1.0 };
	const double k = InverseFocusDistanceOnBowl(Q, C, n, v);
	for(double s : { 1e-100, 0.01, 48.2, 1e100 })
		EXPECT_NEAR(InverseFocusDistanceOnBowl(Q, C, n, s * v) / s, k, 1e-14 * std::fabs(k));
}

// The plane touches the bowl on the lens axis: the slopes there are q's, so the tilt of the plane is the lens's.
// Central differences with a step of 1e-4: a quadratic has no truncation error, rounding is 1e-18/1e-4.
TEST(FieldCurvature, PlaneTouchesTheBowlOnTheLensAxis)
{
	const Vec3d n = LensNormalFromTilt(5 * Degree, 30 * Degree);
	const LensBasis<double> basis = BasisOfLensPlane(n);
	const double h = 1e-4;
	EXPECT_DOUBLE_EQ(InverseFocusDistanceOnBowl(Q, C, n, n), Dot(Q, n));
	for(const Vec3d& e : { basis.a, basis.b })
	{
		const double p = InverseFocusDistanceOnBowl(Q, C, n, n + h * e), m = InverseFocusDistanceOnBowl(Q, C, n, n - h * e);
		EXPECT_NEAR((p - m) / (2 * h), Dot(Q, e), 1e-13);
		EXPECT_NEAR((p + m - 2 * Dot(Q, n)) / (h * h), 2 * C, 1e-9);
	}
}

TEST(FieldCurvature, ZeroIsThePlaneToTheLastBit)
{
	std::mt19937 random(3);
	std::uniform_real_distribution<double> u(-0.5, 0.5);
	for(int i = 0; i < 100; i++)
	{
		const Vec3d v = { u(random), u(random), 1.0 };
		EXPECT_EQ(InverseFocusDistanceOnBowl(Q, 0.0, LensNormalFromTilt(u(random), u(random)), v), InverseFocusDistance(Q, v));
	}
}

TEST(FieldCurvature, StatisticsCountTheBowlAndNameTheEffect)
{
	// Untilted, kappa = 1/50 + C r^2 is 0 on the circle r = 0.4, in a frame of -1..1 by -0.5..0.5.
	LensSpec spec;
	spec.enabled = true;
	spec.focal_distance = 50.0;
	spec.aperture_diameter = 0.1;
	spec.field_curvature = -1.0 / (50.0 * 0.16);
	TiltLens lens;
	std::string error;
	ASSERT_TRUE(Resolve(spec, lens, error)) << error;
	const FocusCounts count = CountFocus(lens, Camera, 400, 200, 0, 0, 399, 199);
	const double area = 3.14159265358979 * 0.16 / 2.0;
	// Half a pixel's ring around the circle's 251 pixels may count either way.
	EXPECT_NEAR(double(count.front) / double(count.All()), area, 0.005);
	EXPECT_NEAR(double(count.behind) / double(count.All()), 1 - area, 0.005);
	EXPECT_THAT(StatisticsText(lens, count, {}), HasSubstr("Effects:         field_curvature\n"));
	spec.distortion_given = true;
	ASSERT_TRUE(Resolve(spec, lens, error)) << error;
	EXPECT_THAT(StatisticsText(lens, count, {}), HasSubstr("Effects:         distortion, field_curvature\n"));
	spec.field_curvature = 0.0;
	ASSERT_TRUE(Resolve(spec, lens, error)) << error;
	EXPECT_FALSE(lens.Curves());
	EXPECT_THAT(StatisticsText(lens, count, {}), HasSubstr("Effects:         distortion\n"));
}

TEST(FieldCurvature, WhatCannotBeComputedIsRefused)
{
	LensSpec spec;
	spec.enabled = true;
	spec.focal_distance = 5.0;
	spec.aperture_diameter = 0.1;
	TiltLens lens;
	std::string error;
	spec.field_curvature = NAN;
	EXPECT_FALSE(Resolve(spec, lens, error));
	EXPECT_THAT(error, HasSubstr("field_curvature is not a finite number"));
	spec.field_curvature = 1e200;
	EXPECT_FALSE(Resolve(spec, lens, error));
	EXPECT_THAT(error, HasSubstr("field_curvature 1e+200 is too large"));
	spec.field_curvature = -1e6;
	EXPECT_TRUE(Resolve(spec, lens, error)) << error;
}
