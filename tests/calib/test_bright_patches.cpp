// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How bright white squares and flat fields are read, and what is no flat field.

#include "measure/bright_patches.h"
#include "measure/measure.h"
#include <tiltcal/photo.h>
#include "support/code_of.h"
#include "support/thin_lens_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using namespace tiltcal;

TEST(BrightPatches, ASceneIsNoFlatField)
{
	std::mt19937 random(3);
	std::normal_distribution<float> noise(0, 0.05f);
	cv::Mat wall(480, 640, CV_32FC1), board = wall.clone();
	for (int y = 0; y < wall.rows; ++y)
		for (int x = 0; x < wall.cols; ++x)
		{
			// 60 degrees of field, lit from one side, SNR 10 to 20, and a rim that takes all light of the corners within a tenth of the height.
			const double r = std::hypot(x - 319.5, y - 239.5) / 400, rim = std::clamp((1.0 - r) / 0.12, 0.05, 1.0);
			const double fall_off = std::pow(1 + 0.33 * r * r, -2);
			wall.at<float>(y, x) = float(0.8 * fall_off * rim * (1 + 0.2 * (x - 320) / 640)) + noise(random);
			board.at<float>(y, x) = float(((x / 40 + y / 40) % 2 ? 0.8 : 0.05) * fall_off) + noise(random);
		}
	EXPECT_EQ(MeasureFlatField(wall, "wall").size(), 40u * 30u);
	EXPECT_EQ(CodeOf([&] { MeasureFlatField(board, "board"); }), EXIT_REFUSED);
}

// A wall of `light` under a fall-off, with noise of 1 % of it, cut at `white`.
cv::Mat Wall(double light, double white)
{
	std::mt19937 random(4);
	std::normal_distribution<float> noise(0, float(0.01 * light));
	cv::Mat wall(300, 400, CV_32FC1);
	for (int y = 0; y < wall.rows; ++y)
		for (int x = 0; x < wall.cols; ++x)
		{
			const double r = std::hypot(x - 199.5, y - 149.5) / 250;
			wall.at<float>(y, x) = std::min(float(light * std::pow(1 + 0.33 * r * r, -2)) + noise(random), float(white));
		}
	return wall;
}

TEST(BrightPatches, ClippedAndDarkFlatFieldsAreRefused)
{
	const auto code = [](const cv::Mat& picture) { return CodeOf([&] { MeasureFlatField(picture, "x"); }); };
	const cv::Mat good = Wall(0.7, 1);
	EXPECT_EQ(MeasureFlatField(good, "x").size(), 40u * 30u);
	EXPECT_EQ(code(Wall(3, 1)), EXIT_REFUSED);
	EXPECT_EQ(code(0.001 * good), EXIT_REFUSED);
	// Floating point has no full scale to be dark beside.
	EXPECT_EQ(MeasureFlatField(0.001 * good, "x", true).size(), 40u * 30u);
	EXPECT_EQ(CodeOf([&] { MeasureFlatField(cv::Mat::zeros(300, 400, CV_32FC1), "x", true); }), EXIT_REFUSED);
	// One channel that is clipped spoils the colour, and with it the luminance.
	cv::Mat red;
	cv::merge(std::vector<cv::Mat>{ 0.4 * good, 0.4 * good, Wall(3, 1) }, red);
	EXPECT_EQ(code(red), EXIT_REFUSED);
	cv::Mat partly = good.clone();
	partly.colRange(0, 100).setTo(1);
	EXPECT_EQ(MeasureFlatField(partly, "x").size(), 30u * 30u);
}

// The white level is the file's own: 12 bits in a file of 16, floats in counts of a sensor.
TEST(BrightPatches, FlatFieldsOfAnyUnit)
{
	EXPECT_EQ(MeasureFlatField(Wall(3000, 4095), "x").size(), 40u * 30u);
	for (const double white : { 4095.0, 4095 / 65535.0 })
		EXPECT_EQ(CodeOf([&] { MeasureFlatField(Wall(3 * white, white), "x"); }), EXIT_REFUSED) << white;
}

// The light of the pattern's white, 0.8, times what TakePicture darkens; blurred edges must not reach into a patch. 0.3 %: the noise is 1 % a pixel, and
// patches have 100 pixels and more.
TEST(BrightPatches, WhiteSquaresAreAsBrightAsTheyWerePainted)
{
	const Board board = ParseBoard("9x7", 30);
	synthetic::Scene scene;
	scene.aperture = 12;
	scene.noise = 0.01;
	scene.vignetting = 1.5;
	scene.lens_points = 150;
	synthetic::Aim(scene, 105, 75, 520, 30, 40, 0);
	const cv::Mat picture = synthetic::TakePicture(scene, synthetic::Checkerboard(9, 7, 30));
	Photo photo;
	for (int j = 0; j < board.InnerRows(); ++j)
		for (int i = 0; i < board.InnerColumns(); ++i)
		{
			const Eigen::Vector2d p = synthetic::PixelOf(scene, 30 * i, 30 * j);
			photo.corners.push_back({ i, j, p.x(), p.y(), 0.05 });
		}
	MeasureEdges(picture, board, photo);
	MeasureWhite(picture, board, photo);
	ASSERT_GE(photo.white.size(), 20u);   // of 31, some outside of the picture
	Photo counts = photo;
	MeasureWhite(4095 * picture, board, counts);
	EXPECT_EQ(counts.white.size(), photo.white.size()) << "in counts of a sensor";
	double squares = 0;
	for (const BrightPatch& p : photo.white)
	{
		const double dx = (p.u + 0.5) / scene.width - 0.5, dy = (p.v + 0.5) / scene.height - 0.5;
		const double truth = 0.8 * (1 - (1 - 1 / scene.vignetting) * 2 * (dx * dx + dy * dy));
		EXPECT_NEAR(p.value / truth, 1, 0.003) << p.board_column << " " << p.board_row;
		squares += std::pow((p.value - truth) / p.sigma, 2) / double(photo.white.size());
	}
	EXPECT_GT(std::sqrt(squares), 0.4);
	EXPECT_LT(std::sqrt(squares), 1.6);   // the brightness falls within a patch too
}

}
