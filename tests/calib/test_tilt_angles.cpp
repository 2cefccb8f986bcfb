// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/tilt_angles.h"

#include <gtest/gtest.h>
#include "lens/optics.h"

#include <cmath>

namespace
{

using namespace tiltcal;
const double RAD = 3.14159265358979323846 / 180;

struct Case
{
	double tilt, direction, reported_tilt, reported_direction;
};

class Convention : public testing::TestWithParam<Case> {};

TEST_P(Convention, FoldsIntoHalfATurn)
{
	const Case& c = GetParam();
	const Vec3<double> n = tilt_lens::LensNormalFromTilt(c.tilt * RAD, c.direction * RAD);
	const Vec3<double> q = tilt_lens::PlaneFromLensTilt(n, 1 / 48.0, 1 / 620.0);
	const TiltAngles a = AnglesFromPlane(q, 48);
	// Only rounding: 1e-9 degrees.
	EXPECT_NEAR(a.lens_tilt, c.reported_tilt, 1e-9);
	EXPECT_NEAR(a.tilt_direction, c.reported_direction, 1e-9);
	EXPECT_NEAR(a.focus_distance, 620, 1e-9);
	// The paper's (1).
	EXPECT_NEAR(std::tan(a.lens_tilt * RAD), 48 * std::tan(a.focal_plane_tilt * RAD) / (620 + 48), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Directions, Convention, testing::Values(Case{ 5, 0, 5, 0 }, Case{ -5, 0, -5, 0 }, Case{ 5, 180, -5, 0 }, Case{ 5, 90, 5, 90 },
	Case{ -5, 90, -5, 90 }, Case{ 5, -60, 5, -60 }, Case{ 5, 120, -5, -60 }),
	[](const auto& tested) { return "case" + std::to_string(tested.index); });

TEST(TiltAngles, SigmaDoesNotJumpAtTheFold)
{
	// At 90 degrees a tilt of 2 and one of -2 at -90 are neighbours.
	Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
	covariance(1, 1) = 1e-12;
	StateLens lens;
	FillStateLens(tilt_lens::PlaneFromLensTilt(tilt_lens::LensNormalFromTilt(2 * RAD, 90 * RAD), 1 / 48.0, 1 / 620.0), 48, covariance, lens);
	// q_y turns the direction by s / |q_xy| and changes the tilt in second order only.
	EXPECT_LT(lens.lens_tilt.sigma, 1e-4);
	EXPECT_NEAR(lens.tilt_direction.sigma, 1e-6 / std::hypot(lens.q.x, lens.q.y) / RAD, 1e-3);
}

TEST(TiltAngles, PlanesOnBothSidesOfParallelToTheAxisAreNeighbours)
{
	// Of one lens tilt, focused on both sides of infinity.
	const auto at = [](double qz)
	{
		const TiltAngles a = AnglesFromPlane({ 0, -0.0018, qz }, 48);
		StateLens lens;
		lens.lens_tilt.value = a.lens_tilt;
		lens.focal_plane_tilt.value = a.focal_plane_tilt;
		lens.tilt_direction.value = a.tilt_direction;
		return lens;
	};
	const StateLens before = at(3e-5), beyond = at(-2e-5);
	ASSERT_GT(before.focal_plane_tilt.value, 89);
	ASSERT_LT(beyond.focal_plane_tilt.value, -89);
	// The angles between the planes: of 3 and 2 in 180.
	const double apart = (std::atan(3e-5 / 0.0018) + std::atan(2e-5 / 0.0018)) / RAD;
	EXPECT_NEAR(std::abs(DifferenceOfTilts(before, beyond, &StateLens::focal_plane_tilt).along), apart, 1e-9);
	EXPECT_LT(std::abs(DifferenceOfTilts(before, beyond, &StateLens::lens_tilt).along), 0.1);
}

TEST(TiltAngles, SigmaIsPropagated)
{
	// Untilted about x, q_y uncertain by s: the tilt is uncertain by s / (1/U + 1/w).
	Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
	const double s = 1e-6;
	covariance(1, 1) = s * s;
	StateLens lens;
	FillStateLens({ 0, -0.002, 1 / 620.0 }, 48, covariance, lens);
	const double p = 1 / 620.0 + 1 / 48.0;
	// d atan(y / p) = p / (p^2 + y^2) dy; central differences are exact to 1e-6 of it.
	EXPECT_NEAR(lens.lens_tilt.sigma, s * p / (p * p + 0.002 * 0.002) / RAD, 1e-5 * lens.lens_tilt.sigma);
	EXPECT_NEAR(lens.focus_distance.sigma, 0, 1e-9);
}

}
