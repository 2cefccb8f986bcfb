// SPDX-License-Identifier: AGPL-3.0-or-later
//
// distortion against OpenCV's projectPoints, its inverse against itself, and the
// refusal where it folds.

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "lens/distortion.h"
#include "lens/lens_spec.h"

using namespace tilt_lens;

namespace
{

const double Coefficients[][DistortionTerms] = {
	{ -0.088, -0.163, 0.0, 0.0, 0.0 },          // photos-45mm
	{ -0.25, 0.1, 0.001, -0.002, -0.01 },
	{ 0.3, -0.05, -0.003, 0.004, 0.02 } };

}

// One pixel is 1/2410 in units of w; 1e-9 px: rounding, not a model of its own.
TEST(Distortion, IsOpenCVsProjectPoints)
{
	const double w = 2410.0;
	const cv::Matx33d K(w, 0, 900, 0, w, 600, 0, 0, 1);
	std::mt19937 random(5);
	std::uniform_real_distribution<double> u(-0.45, 0.45);
	for(const auto& k : Coefficients)
		for(int i = 0; i < 200; i++)
		{
			const double x = u(random), y = u(random);
			std::vector<cv::Point2d> pixel;
			cv::projectPoints(std::vector<cv::Point3d>{ { 700 * x, 700 * y, 700.0 } }, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K,
			                  std::vector<double>(k, k + DistortionTerms), pixel);
			double image[2];
			Distort(k, x, y, image);
			EXPECT_NEAR(900 + w * image[0], pixel[0].x, 1e-9);
			EXPECT_NEAR(600 + w * image[1], pixel[0].y, 1e-9);
		}
}

// Finite differences with a step of 1e-6: truncation near 1e-12, rounding 1e-10.
TEST(Distortion, JacobianIsTheDerivative)
{
	const double h = 1e-6;
	for(const auto& k : Coefficients)
		for(double x : { -0.3, 0.0, 0.2 })
			for(double y : { -0.4, 0.1 })
			{
				double j[4], a[2], b[2];
				DistortJacobian(k, x, y, j);
				Distort(k, x + h, y, a), Distort(k, x - h, y, b);
				EXPECT_NEAR(j[0], (a[0] - b[0]) / (2 * h), 1e-8);
				EXPECT_NEAR(j[2], (a[1] - b[1]) / (2 * h), 1e-8);
				Distort(k, x, y + h, a), Distort(k, x, y - h, b);
				EXPECT_NEAR(j[1], (a[0] - b[0]) / (2 * h), 1e-8);
				EXPECT_NEAR(j[3], (a[1] - b[1]) / (2 * h), 1e-8);
			}
}

TEST(Distortion, UndistortInvertsDistort)
{
	std::mt19937 random(6);
	std::uniform_real_distribution<double> u(-0.45, 0.45);
	for(const auto& k : Coefficients)
		for(int i = 0; i < 1000; i++)
		{
			const double x = u(random), y = u(random);
			double image[2];
			Distort(k, x, y, image);
			double back_x = image[0], back_y = image[1];
			ASSERT_TRUE(Undistort(k, image[0], image[1], back_x, back_y));
			// Newton ends at rounding, which the slope of the inverse (below 3) amplifies.
			EXPECT_NEAR(back_x, x, 1e-14);
			EXPECT_NEAR(back_y, y, 1e-14);
			EXPECT_TRUE(IsInvertible(k, image[0], image[1]));
		}
}

// x (1 + k1 r^2) with k1 = -0.5 has its maximum at r = 0.8165, image radius 0.5443:
// nothing is imaged beyond.
TEST(Distortion, FoldsAreSeen)
{
	const double k[DistortionTerms] = { -0.5, 0, 0, 0, 0 };
	EXPECT_TRUE(IsInvertible(k, 0.54, 0.0));
	EXPECT_FALSE(IsInvertible(k, 0.55, 0.0));
	EXPECT_FALSE(IsInvertible(k, 0.4, 0.4));
}

TEST(Distortion, ACameraThatFoldsIsRefusedAndANarrowerOneIsNot)
{
	LensSpec spec;
	spec.enabled = spec.distortion_given = true;
	spec.distortion[0] = -0.5;
	TiltLens lens;
	std::string error;
	const CameraVectors wide = { { 0, 0, 0 }, { 0, 0, 1 }, { 1.33, 0, 0 }, { 0, 1, 0 } };
	EXPECT_FALSE(ResolveTiltLens(spec, wide, lens, error));
	EXPECT_THAT(error, testing::HasSubstr("folds inside the frame"));
	const CameraVectors narrow = { { 0, 0, 0 }, { 0, 0, 2 }, { 1.33, 0, 0 }, { 0, 1, 0 } };
	EXPECT_TRUE(ResolveTiltLens(spec, narrow, lens, error)) << error;
	spec.distortion[0] = std::nan("");
	EXPECT_FALSE(ResolveTiltLens(spec, narrow, lens, error));
}

// About the tilted axis: the direction along n is not moved, whatever the tilt.
TEST(Distortion, ActsAboutTheLensAxis)
{
	LensSpec spec;
	spec.enabled = spec.distortion_given = true;
	spec.distortion[0] = -0.05;
	spec.lens_tilt = 12.0;
	spec.tilt_direction = 40.0;
	spec.focal_distance = 9.0;
	TiltLens lens;
	std::string error;
	const CameraVectors camera = { { 0, 0, 0 }, { 0, 0, 1 }, { 1.33, 0, 0 }, { 0, 1, 0 } };
	ASSERT_TRUE(ResolveTiltLens(spec, camera, lens, error)) << error;
	const Vec3d along = UndistortDirection(lens.distortion, lens.basis_x, lens.basis_y, lens.normal, 3.0 * lens.normal);
	EXPECT_NEAR(Length(along - 3.0 * lens.normal), 0.0, 1e-15);
	const Vec3d beside = UndistortDirection(lens.distortion, lens.basis_x, lens.basis_y, lens.normal, { 0, 0, 1 });
	EXPECT_GT(Length(Cross(Normalized(beside), Vec3d{ 0, 0, 1 })), 1e-4);
}
