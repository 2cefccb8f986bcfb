// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures through a prescription against the photographs, which another program traced through the same glass.

#include "support/traced_picture.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace
{

using namespace tiltcal;
using namespace synthetic;

/// The photographs' board: its radiances, one square of white around it, the origin at the first inner corner.
Pattern PhotographedBoard()
{
	const Pattern board = Checkerboard(12, 9, 25);
	const auto light = [=](double x, double y)
	{
		const float v = board.light(x, y);
		return v > 0.7f ? 0.9f : v < 0.1f ? 0.03f : 0.35f;
	};
	return { light, board.clearance };
}

/// The third board of the photographs' truth.json, through their lens.
TracedScene ThirdBoard(const GlassState& tilted)
{
	TracedScene scene;
	const Prescription printed = ReadPrescription(DOUBLE_GAUSS);
	scene.glass = StoppedTo(printed.Scaled(45 / ParaxialOf(printed).focal_length), 2.8);
	scene.state = tilted;
	scene.state.back_distance = 35.69306725;
	scene.state.pivot = scene.glass.StopHeight();
	scene.camera_from_board << 0.8090169944, 0, 0.5877852523, 0, 1, 0, -0.5877852523, 0, 0.8090169944;
	scene.origin = Eigen::Vector3d(-117.3525492, -110.5, 763.1677878) + scene.camera_from_board * Eigen::Vector3d(25, 25, 0);
	scene.exposure = 0.944444;
	return scene;
}

/// 0..255, sRGB.
cv::Mat Coded(const cv::Mat& linear)
{
	cv::Mat coded = linear.clone();
	for (float& v : cv::Mat_<float>(coded))
		v = 255 * float(v <= 0.0031308f ? 12.92f * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
	return coded;
}

struct Case
{
	const char* file;
	double tilt;
	cv::Rect part;
};

class TracedPicture : public testing::TestWithParam<Case> {};

TEST_P(TracedPicture, IsThePhotograph)
{
	TracedScene scene = ThirdBoard({ "state", GetParam().tilt, 0, 0, 0 });
	scene.part = GetParam().part;
	scene.rays = 800;
	const cv::Mat traced = Coded(TakeTracedPicture(scene, PhotographedBoard()))(scene.part);
	cv::Mat photograph = cv::imread(std::string(PHOTOS) + "/" + GetParam().file, cv::IMREAD_GRAYSCALE);
	ASSERT_FALSE(photograph.empty());
	photograph(scene.part).convertTo(photograph, CV_32F);
	const cv::Mat difference = traced - photograph;
	// The photographs' noise is 0.8 levels where it is brightest, the JPEG's, and that of 800 rays where it is blurred, as much
	// again; in the mean over 3072 pixels little is left of either. Turned, mirrored or untilted it would be tens.
	EXPECT_LT(cv::norm(difference, cv::NORM_L2) / std::sqrt(double(difference.total())), 2.0);
	EXPECT_NEAR(cv::mean(difference)[0], 0, 0.2);
	std::printf("RMS %.3f, mean %.3f of 255\n", cv::norm(difference, cv::NORM_L2) / std::sqrt(double(difference.total())), cv::mean(difference)[0]);
}

INSTANTIATE_TEST_SUITE_P(Parts, TracedPicture, testing::Values(Case{ "untilted-3.jpg", 0, { 900, 600, 64, 48 } }, Case{ "plus5-3.jpg", 5, { 1200, 250, 64, 48 } },
	Case{ "minus5-3.jpg", -5, { 500, 900, 64, 48 } }), [](const auto& tested) { return "case" + std::to_string(tested.index); });

TEST(TracedPixel, SeesCornersWhereTheEdgesCross)
{
	// At a stop so small that nothing is blurred, the edge between two squares is where the ray through the stop's middle says.
	TracedScene scene = ThirdBoard({ "state", 5, 0, 0, 0 });
	scene.glass = StoppedTo(scene.glass, 90);
	const Eigen::Vector2d on_edge = TracedPixelOf(scene, 100, 37.5);
	const int x = int(on_edge.x()), y = int(on_edge.y());
	scene.part = { x - 4, y, 9, 1 };
	scene.rays = 400;
	const cv::Mat picture = TakeTracedPicture(scene, PhotographedBoard());
	// White to the one side, black to the other: the light of the row says where it changes.
	const double left = picture.at<float>(y, x - 4), right = picture.at<float>(y, x + 4);
	double share = 0;
	for (int k = -4; k <= 4; ++k)
		share += (picture.at<float>(y, x + k) - right) / (left - right);
	const Eigen::Vector2d below = TracedPixelOf(scene, 100, 38.5);
	const double lean = (below.x() - on_edge.x()) / (below.y() - on_edge.y()) * (y - on_edge.y());
	EXPECT_NEAR(x - 4.5 + share, on_edge.x() + lean, 0.05);
}

}
