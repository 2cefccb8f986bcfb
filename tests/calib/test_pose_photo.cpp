// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Poses from points that are measured in a picture: a checkered floor, drawn by OpenCV's model of a tilted, distorted camera.

#include <tiltcal/error.h>
#include "measure/find_crossing.h"
#include "camera/pose_photo.h"
#include "camera/pose_weights.h"
#include "support/posed_camera.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace
{

using namespace tiltcal;
using Eigen::Vector3d;

const double TILE = 40;
const PosedScene SCENE = LookAt({ 60, 420, -500 }, { 10, 0, 60 });

/// Floor y = 0 of tiles of 40, and a plain box that hides a part of it. Linear light, noise of an 8-bit photograph.
cv::Mat Floor(const StateCamera& camera, double blur_px)
{
	const int FINE = 4;   // for edges without stairs
	cv::Mat picture(camera.height * FINE, camera.width * FINE, CV_8UC1, cv::Scalar(60));
	const auto draw = [&](const std::vector<Vector3d>& outline, int value)
	{
		std::vector<cv::Point> polygon;
		for (const PosePoint& p : Photographed(camera, SCENE, outline))
			polygon.emplace_back(static_cast<int>(std::lround(((p.u + 0.5) * FINE - 0.5) * 256)), static_cast<int>(std::lround(((p.v + 0.5) * FINE - 0.5) * 256)));
		cv::fillConvexPoly(picture, polygon, cv::Scalar(value), cv::LINE_8, 8);
	};
	for (int i = -6; i < 6; ++i)
		for (int j = -4; j < 8; ++j)
			draw({ { TILE * i, 0, TILE * j }, { TILE * (i + 1), 0, TILE * j }, { TILE * (i + 1), 0, TILE * (j + 1) }, { TILE * i, 0, TILE * (j + 1) } },
				(i + j) % 2 ? 50 : 140);
	draw({ { -100, 0, -20 }, { -20, 0, -20 }, { -20, 90, -20 }, { -100, 90, -20 } }, 100);
	cv::Mat small;
	cv::resize(picture, small, { camera.width, camera.height }, 0, 0, cv::INTER_AREA);
	small.convertTo(small, CV_32FC1, 1 / 255.);
	if (blur_px > 0)
		cv::GaussianBlur(small, small, {}, blur_px);
	std::mt19937 random(3);
	std::normal_distribution<float> gauss(0, 1 / 255.f);
	for (auto at = small.begin<float>(); at != small.end<float>(); ++at)
		*at = std::max(0.f, *at + gauss(random));
	return small;
}

/// The floor's crossings; the first four are clicked on, to within 4 px, the others have no pixel.
std::vector<PosePoint> FourClicks(const StateCamera& camera)
{
	std::vector<Vector3d> places{ { -160, 0, 0 }, { 160, 0, -40 }, { 120, 0, 160 }, { -160, 0, 200 } };
	for (int i = -5; i < 6; ++i)
		for (int j = -3; j < 8; ++j)
			places.emplace_back(TILE * i, 0, TILE * j);
	std::vector<PosePoint> points = Photographed(camera, SCENE, places);
	for (size_t k = 0; k < points.size(); ++k)
	{
		PosePoint& p = points[k];
		if (k < 4)
		{
			p.u = std::round(p.u + (k % 2 ? 3 : -4));
			p.v = std::round(p.v + (k % 3 ? -3 : 2));
			continue;
		}
		p.u = p.v = std::nan("");
		p.placed = Placed::NOWHERE;
	}
	return points;
}

size_t Count(const PhotoPose& solved, Placed placed)
{
	size_t n = 0;
	for (const PosePoint& p : solved.points)
		n += p.placed == placed;
	return n;
}

TEST(PosePhoto, FourClicksFindTheOthers)
{
	const StateCamera camera = TiltedCamera();
	for (const double blur : { 0.7, 2.5 })
	{
		SCOPED_TRACE(blur);
		const PhotoPose solved = SolvePoseInPhoto(camera, Floor(camera, blur), FourClicks(camera), 9, "points.csv");
		EXPECT_EQ(Count(solved, Placed::MEASURED), 4u);
		// 121 with those clicked on; the box hides some, the picture ends before others.
		EXPECT_GT(Count(solved, Placed::FOUND), 60u);
		// fillConvexPoly counts outlines in, up to 1/8 px of this picture; noise moves crossings by some hundredths.
		EXPECT_LT(solved.pose.rms, 0.08);
		EXPECT_EQ(solved.pose.outliers, 0);
		const Vector3d off = solved.pose.location - SCENE.location;
		// 0.1 of 700, a sixth of what one pixel in every point would do: for those outlines.
		for (int k = 0; k < 3; ++k)
			EXPECT_LT(std::abs(off[k]), 4 * solved.pose.location_sigma[k] + 0.1) << k;
		EXPECT_LT(DegreesBetween(solved.pose.camera_from_world, SCENE.camera_from_world), 0.01);
	}
}

// Counts of a 12-bit sensor, and light in another unit: OpenEXR says none. The bounds are those above.
TEST(PosePhoto, FloatsOfAnyUnit)
{
	const StateCamera camera = TiltedCamera();
	for (const double unit : { 4095.0, 1e-4 })
	{
		SCOPED_TRACE(unit);
		const PhotoPose solved = SolvePoseInPhoto(camera, unit * Floor(camera, 0.7), FourClicks(camera), 9, "points.csv");
		EXPECT_EQ(Count(solved, Placed::MEASURED), 4u);
		EXPECT_GT(Count(solved, Placed::FOUND), 60u);
		EXPECT_LT(solved.pose.rms, 0.08);
		EXPECT_LT(DegreesBetween(solved.pose.camera_from_world, SCENE.camera_from_world), 0.01);
		// Shown, not white and not black.
		const cv::Scalar mean = cv::mean(DrawPosePoints(unit * Floor(camera, 0.7), solved));
		EXPECT_GT(mean[0], 70);
		EXPECT_LT(mean[0], 160);
	}
}

TEST(PosePhoto, HiddenPointsAreLeftOutAndSaid)
{
	const StateCamera camera = TiltedCamera();
	const PhotoPose solved = SolvePoseInPhoto(camera, Floor(camera, 0.7), FourClicks(camera), 9, "points.csv");
	const size_t total = solved.points.size() + solved.outside.size() + solved.missing.size() + solved.strange.size();
	EXPECT_EQ(total, FourClicks(camera).size());
	// (-40, 0, 0) stands behind the box.
	for (const PosePoint& p : solved.points)
		EXPECT_FALSE(p.world.x == -40 && p.world.z == 0);
	EXPECT_FALSE(solved.missing.empty());
	EXPECT_NE(PhotoPoseText(solved).find("no crossing where the camera sees them: lines "), std::string::npos);
}

TEST(PosePhoto, WhatIsNoCrossingStaysWhereItWasGiven)
{
	const StateCamera camera = TiltedCamera();
	std::vector<PosePoint> points = FourClicks(camera);
	// The box's upper corner: no crossing.
	std::vector<PosePoint> corner = Photographed(camera, SCENE, { { -20, 90, -20 } });
	corner[0].line = 999;
	points.push_back(corner[0]);
	const PhotoPose solved = SolvePoseInPhoto(camera, Floor(camera, 0.7), points, 9, "points.csv");
	bool seen = false;
	for (const PosePoint& p : solved.points)
		if (p.line == 999)
		{
			seen = true;
			EXPECT_EQ(p.placed, Placed::GIVEN);
			EXPECT_EQ(p.u, corner[0].u);
		}
	EXPECT_TRUE(seen);
}

/// The floor through an aperture; its middle in focus.
StateCamera WideOpen(double aperture_mm)
{
	StateCamera camera = TiltedCamera();
	camera.aperture_diameter_mm = aperture_mm;
	camera.focus_distance_mm = 650;
	return camera;
}

TEST(PosePhoto, BlurredPointsCountAsTheirScatterSays)
{
	const StateCamera camera = WideOpen(20);
	CameraPose pose;
	pose.camera_from_world = SCENE.camera_from_world;
	pose.location = SCENE.location;
	pose.far_off = 100;
	std::vector<Vector3d> places;
	for (int i = -10; i < 10; ++i)
		for (int j = -10; j < 10; ++j)
			places.emplace_back(20 * i, 0, 20 * j);
	for (const double of_blur : { 0.0, 0.2 })
	{
		std::vector<PosePoint> points = Photographed(camera, SCENE, places);
		std::mt19937 random(11);
		std::normal_distribution<double> gauss;
		std::vector<double> true_sigmas;
		double least = 1e9, most = 0;
		pose.residuals.clear();
		for (const PosePoint& p : points)
		{
			const double blur = BlurAt(camera, pose, 1, p.world), sigma = 0.1 * std::hypot(1, of_blur * blur);
			least = std::min(least, blur);
			most = std::max(most, blur);
			true_sigmas.push_back(sigma / 0.1);
			pose.residuals.emplace_back(sigma * gauss(random), sigma * gauss(random));
		}
		ASSERT_LT(least, 2);
		ASSERT_GT(most, 15);
		WeighByBlur(camera, pose, 1, points);
		double mean_log = 0;
		for (size_t i = 0; i < points.size(); ++i)
			mean_log += std::log(points[i].sigma / true_sigmas[i]) / double(points.size());
		// Only ratios matter. 400 points tell a variance to 1/20, that of either half of the blurs' range against the other to 1/10: three times that, of a root half.
		for (size_t i = 0; i < points.size(); ++i)
			EXPECT_NEAR(std::log(points[i].sigma / true_sigmas[i]), mean_log, 0.15) << of_blur;
	}
	// Too few to tell.
	std::vector<PosePoint> few = Photographed(camera, SCENE, { places.begin(), places.begin() + 8 });
	pose.residuals.resize(8);
	WeighByBlur(camera, pose, 1, few);
	for (const PosePoint& p : few)
		EXPECT_EQ(p.sigma, 1);
}

TEST(PosePhoto, BlurredCrossingsAreFoundBetterWhereTheApertureIsKnown)
{
	// Gaussians of 4 px blur as much as discs of 16 px do; an aperture that is not known has none. What smoothing takes from the noise it may not give back otherwise.
	const cv::Mat photo = Floor(TiltedCamera(), 4);
	const double known = SolvePoseInPhoto(WideOpen(60), photo, FourClicks(TiltedCamera()), 9, "points.csv").pose.rms;
	const double unknown = SolvePoseInPhoto(WideOpen(0), photo, FourClicks(TiltedCamera()), 9, "points.csv").pose.rms;
	EXPECT_LT(known, unknown);
	// The same where every crossing was clicked on, and none is left to be looked for.
	std::vector<PosePoint> clicked = SolvePoseInPhoto(WideOpen(60), photo, FourClicks(TiltedCamera()), 9, "points.csv").points;
	ASSERT_GT(clicked.size(), 50u);
	for (PosePoint& p : clicked)
	{
		p.u = std::round(p.u);
		p.v = std::round(p.v);
		p.placed = Placed::GIVEN;
	}
	EXPECT_LT(SolvePoseInPhoto(WideOpen(60), photo, clicked, 9, "points.csv").pose.rms, SolvePoseInPhoto(WideOpen(0), photo, clicked, 9, "points.csv").pose.rms);
}

// It is the caller's: an overlay is drawn over it afterwards.
TEST(PosePhoto, ThePhotographStaysAsItIs)
{
	const cv::Mat photo = Floor(TiltedCamera(), 0.7), before = photo.clone();
	SolvePoseInPhoto(TiltedCamera(), photo, FourClicks(TiltedCamera()), 9, "points.csv");
	EXPECT_EQ(cv::norm(photo, before, cv::NORM_INF), 0);
}

TEST(PosePhoto, AnotherSizeIsRefused)
{
	const StateCamera camera = TiltedCamera();
	EXPECT_THROW(SolvePoseInPhoto(camera, cv::Mat(600, 900, CV_32FC1, cv::Scalar(0.5)), FourClicks(camera), 9, "points.csv"), Error);
}

TEST(FindCrossing, RefusesWhatIsNone)
{
	std::mt19937 random(5);
	std::normal_distribution<float> gauss(0, 1 / 255.f);
	const auto picture = [&](const std::function<bool(int, int)>& bright)
	{
		cv::Mat m(80, 80, CV_32FC1);
		for (int y = 0; y < 80; ++y)
			for (int x = 0; x < 80; ++x)
				m.at<float>(y, x) = (bright(x, y) ? 0.7f : 0.3f) + gauss(random);
		cv::GaussianBlur(m, m, {}, 1);
		return m;
	};
	// A crossing between pixels (39, 40): found from 6 px away, not from beyond its reach.
	const cv::Mat crossing = picture([](int x, int y) { return (x < 40) == (y < 41); });
	const auto found = FindCrossing(crossing, { 34, 43 }, 9, 9);
	ASSERT_TRUE(found.has_value());
	EXPECT_NEAR(found->x, 39.5, 0.05);
	EXPECT_NEAR(found->y, 40.5, 0.05);
	EXPECT_FALSE(FindCrossing(crossing, { 34, 43 }, 9, 4).has_value());
	EXPECT_FALSE(FindCrossing(crossing, { 5, 40 }, 9, 9).has_value());
	EXPECT_FALSE(FindCrossing(picture([](int x, int) { return x < 40; }), { 40, 40 }, 9, 9).has_value()) << "an edge";
	EXPECT_FALSE(FindCrossing(picture([](int x, int y) { return x < 40 && y < 40; }), { 40, 40 }, 9, 9).has_value()) << "a corner";
	EXPECT_FALSE(FindCrossing(picture([](int, int) { return true; }), { 40, 40 }, 9, 9).has_value()) << "plain paper";
	EXPECT_FALSE(FindCrossing(cv::Mat(12, 12, CV_32FC1, cv::Scalar(0.5)), { 6, 6 }, 9, 9).has_value()) << "a picture smaller than the window";
}

}
