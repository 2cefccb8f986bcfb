// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Poses from points that cv::projectPoints put into the picture.

#include <tiltcal/error.h>
#include "program/temporary_folder.h"
#include "camera/pose.h"
#include "support/posed_camera.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

namespace
{

using namespace tiltcal;
using Eigen::Vector3d;
using testing::HasSubstr;

/// `n` points in a box of 300 x 200 x `depth` about the origin.
std::vector<Vector3d> Box(size_t n, double depth, unsigned seed = 7)
{
	std::mt19937 random(seed);
	std::uniform_real_distribution<double> unit(-0.5, 0.5);
	std::vector<Vector3d> points;
	for (size_t i = 0; i < n; ++i)
	{
		const double x = unit(random), y = unit(random), z = unit(random);
		points.emplace_back(300 * x, 200 * y, depth * z);
	}
	return points;
}

const PosedScene SCENE = LookAt({ 250, 180, -700 }, { 10, -5, 0 });

std::string Refusal(const StateCamera& camera, const std::vector<PosePoint>& points)
{
	try
	{
		SolvePose(camera, points, "points.csv");
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_REFUSED);
		return e.what();
	}
	return "accepted";
}

TEST(Pose, IsExactWithoutNoise)
{
	for (const size_t n : { 4, 5, 6, 20 })
	{
		const CameraPose pose = SolvePose(TiltedCamera(), Photographed(TiltedCamera(), SCENE, Box(n, 200)), "points.csv");
		// The solver stops at rounding: 1e-13 of the parameters, times the condition of the problem.
		EXPECT_LT((pose.location - SCENE.location).norm(), 1e-6) << n;
		EXPECT_LT(DegreesBetween(pose.camera_from_world, SCENE.camera_from_world), 1e-6) << n;
		EXPECT_EQ(std::isfinite(pose.location_sigma.x()), n >= 6);
	}
}

TEST(Pose, IsExactFromAPlane)
{
	const CameraPose pose = SolvePose(TiltedCamera(), Photographed(TiltedCamera(), SCENE, Box(12, 0)), "points.csv");
	EXPECT_LT((pose.location - SCENE.location).norm(), 1e-6);
}

TEST(Pose, DoesNotDependOnTheUnit)
{
	for (const double unit : { 1e-7, 1e7 })
	{
		std::vector<PosePoint> points = Photographed(TiltedCamera(), SCENE, Box(10, 200));
		// Far from the origin too, where differences lose 3 digits.
		for (PosePoint& p : points)
			p.world = { unit * (p.world.x + 1e5), unit * p.world.y, unit * p.world.z };
		const CameraPose pose = SolvePose(TiltedCamera(), points, "points.csv");
		EXPECT_LT((pose.location / unit - SCENE.location - Vector3d(1e5, 0, 0)).norm(), 1e-5) << unit;
	}
}

/// Over many noisy photographs the errors are as large as the sigmas say.
TEST(Pose, SigmasAreHonest)
{
	const int trials = 200;
	double location = 0, rotation = 0;
	for (unsigned seed = 1; seed <= trials; ++seed)
	{
		const CameraPose pose = SolvePose(TiltedCamera(), Photographed(TiltedCamera(), SCENE, Box(20, 200), 0.3, seed), "points.csv");
		location += (pose.location - SCENE.location).cwiseQuotient(pose.location_sigma).squaredNorm() / 3 / trials;
		// Small: the rotation vector about the camera's axes.
		const Eigen::AngleAxisd error(pose.camera_from_world * SCENE.camera_from_world.transpose());
		const Vector3d vector = error.angle() * 180 / 3.14159265358979323846 * error.axis();
		rotation += vector.cwiseQuotient(pose.rotation_sigma_deg).squaredNorm() / 3 / trials;
		EXPECT_LT(pose.rms, 0.6);
	}
	// Mean of t squared with 34 degrees of freedom is 1.06; the mean of 200 scatters by 0.1 even if the three
	// components were one.
	EXPECT_NEAR(location, 1.06, 0.35);
	EXPECT_NEAR(rotation, 1.06, 0.35);
}

/// Cameras all around, sets of points of all kinds: found, or refused as ambiguous, never taken for another.
TEST(Pose, RandomScenesAreSolvedOrRefused)
{
	std::mt19937 random(3);
	std::uniform_real_distribution<double> unit(-1, 1);
	int solved = 0, refused = 0;
	for (unsigned seed = 1; seed <= 150; ++seed)
	{
		const size_t n = 6 + seed % 7;
		const bool flat = seed % 2 == 0;
		Vector3d from(unit(random), unit(random), unit(random));
		if (std::abs(from.normalized().y()) > 0.95 || from.norm() < 0.2)
			continue;   // LookAt's own pole
		// Not edge-on to a flat set.
		if (flat && std::abs(from.normalized().z()) < 0.3)
			continue;
		const PosedScene scene = LookAt((600 + 300 * std::abs(unit(random))) * from.normalized(), { 5, 10, -3 });
		const std::vector<PosePoint> points = Photographed(TiltedCamera(), scene, Box(n, flat ? 0 : 150, seed), 0.2, seed);
		try
		{
			const CameraPose pose = SolvePose(TiltedCamera(), points, "points.csv");
			++solved;
			// 10 sigma: with 6 points the sigma itself, of 6 degrees of freedom, may be 3 times too small. Another camera
			// that fits is hundreds of sigmas away.
			EXPECT_LT((pose.location - scene.location).cwiseQuotient(pose.location_sigma).cwiseAbs().maxCoeff(), 10) << seed << ", " << n << " points";
		}
		catch (const Error& e)
		{
			++refused;
			EXPECT_THAT(e.what(), testing::AnyOf(HasSubstr("two camera places"), HasSubstr("outside the calibrated picture"))) << seed;
		}
	}
	EXPECT_GT(solved, 90);
	EXPECT_LT(refused, 10);
}

TEST(Pose, NamesTheWorstPointAndStandsIt)
{
	std::vector<PosePoint> points = Photographed(TiltedCamera(), SCENE, Box(12, 200), 0.2);
	points[4].u += 60;
	const CameraPose pose = SolvePose(TiltedCamera(), points, "points.csv");
	EXPECT_EQ(pose.worst, 4u);
	EXPECT_EQ(pose.outliers, 1);
	// The other eleven leave some 0.3 mm; the false point alone would pull by tens.
	EXPECT_LT((pose.location - SCENE.location).norm(), 1.5);
	EXPECT_THAT(PoseText(pose, points), HasSubstr("in line 6"));
}

TEST(Pose, RefusesTooFewAndOnALine)
{
	EXPECT_THAT(Refusal(TiltedCamera(), Photographed(TiltedCamera(), SCENE, Box(3, 200))), HasSubstr("at least 4"));
	std::vector<Vector3d> twice = Box(3, 200);
	twice.push_back(twice[0]);
	EXPECT_THAT(Refusal(TiltedCamera(), Photographed(TiltedCamera(), SCENE, twice)), HasSubstr("at least 4"));
	std::vector<Vector3d> line;
	for (const double t : { -1., -0.5, 0., 0.3, 0.8, 1. })
		line.emplace_back(100 * t, 30 * t, 20 * t);
	EXPECT_THAT(Refusal(TiltedCamera(), Photographed(TiltedCamera(), SCENE, line)), HasSubstr("on one line"));
}

TEST(Pose, RefusesAMirroredWorld)
{
	std::vector<PosePoint> points = Photographed(TiltedCamera(), SCENE, Box(12, 200), 0.2);
	for (PosePoint& p : points)
		p.world.z = -p.world.z;
	EXPECT_THAT(Refusal(TiltedCamera(), points), HasSubstr("mirrored"));
}

TEST(Pose, RefusesPointsThatAreNotThoseOfThePicture)
{
	std::vector<PosePoint> points = Photographed(TiltedCamera(), SCENE, Box(12, 200));
	for (size_t i = 0; i < 12; ++i)
		std::swap(points[i].world, points[(5 * i + 3) % 12].world);
	EXPECT_THAT(Refusal(TiltedCamera(), points), testing::AnyOf(HasSubstr("no camera fits"), HasSubstr("behind the camera")));
	points = Photographed(TiltedCamera(), SCENE, Box(12, 200));
	points[2].u = 1900;
	EXPECT_THAT(Refusal(TiltedCamera(), points), HasSubstr("points.csv:4: pixel (1900"));
}

TEST(Pose, RefusesPointsBehindTheCamera)
{
	// A camera amid its points: the plain projection puts those behind it into the picture too.
	StateCamera camera = TiltedCamera();
	camera.lens_tilt_deg = 0;
	camera.distortion = {};
	camera.principal_point = { 900, 600 };
	std::vector<PosePoint> points;
	for (const Vector3d& p : Box(14, 0))
		for (const double z : { 700., -600. })
			if (points.size() < 12)
				points.push_back({ 900 + 2416 * p.x() / z, 600 - 2416 * p.y() / z, { p.x(), p.y(), z }, static_cast<int>(points.size()) + 2 });
	EXPECT_THAT(Refusal(camera, points), HasSubstr("line 3, 5, 7, 9, 11, 13 would lie behind the camera"));
}

TEST(Pose, SaysWhenAPlaneLeavesTwoCameras)
{
	// A small square seen from twenty times its size: both tilts of it look the same but for 0.05 px.
	std::vector<Vector3d> square;
	for (const double x : { -30., 30. })
		for (const double y : { -30., 30. })
			square.emplace_back(x, y, 0);
	const PosedScene far = LookAt({ 150, 100, -2400 }, { 0, 0, 0 });
	EXPECT_THAT(Refusal(TiltedCamera(), Photographed(TiltedCamera(), far, square, 0.05)), HasSubstr("two camera places"));
}

class Points : public testing::Test
{
protected:
	std::string Refusal(const std::string& text)
	{
		std::ofstream(file, std::ios::binary) << text;
		try
		{
			ReadPosePoints(file);
		}
		catch (const Error& e)
		{
			EXPECT_EQ(e.Code(), EXIT_FILE);
			return e.what();
		}
		return "accepted";
	}
	const TemporaryFolder folder{ "tiltcal-points" };
	const std::string file = folder.File("points.csv");
};

TEST_F(Points, AreReadWithTheirLines)
{
	EXPECT_EQ(Refusal("\xEF\xBB\xBFu_px,v_px,x,y,z\r\n# by hand\r\n\r\n1, 2, 3, -4e1, 5\r\n"), "accepted");
	const std::vector<PosePoint> points = ReadPosePoints(file);
	ASSERT_EQ(points.size(), 1u);
	EXPECT_EQ(points[0].world.y, -40);
	EXPECT_EQ(points[0].line, 4);
}

TEST_F(Points, NameFileAndLineOfWhatIsWrong)
{
	EXPECT_THAT(Refusal("u,v,x,y,z\n"), HasSubstr(file + ":1"));
	EXPECT_THAT(Refusal(""), HasSubstr(file + ":1"));
	EXPECT_THAT(Refusal("u_px,v_px,x,y,z\n1,2,3,4\n"), HasSubstr(file + ":2"));
	EXPECT_THAT(Refusal("u_px,v_px,x,y,z\n1,2,3,4,5\n1,2,3,4,5,6\n"), HasSubstr(file + ":3"));
	EXPECT_THAT(Refusal("u_px,v_px,x,y,z\n1,2,3,nan,5\n"), HasSubstr(file + ":2"));
	EXPECT_THAT(Refusal("u_px,v_px,x,y,z\n1,2,3,,5\n"), HasSubstr(file + ":2"));
}

}
