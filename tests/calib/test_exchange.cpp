// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras for other programs. The oracle of all pixels is OpenCV's own tilted model (cv::projectPoints).

#include "base/csv_rows.h"
#include "camera/opencv_yaml.h"
#include "exchange/colmap.h"
#include "exchange/maps.h"
#include "exchange/point_lists.h"
#include "exchange/undistort.h"
#include "exchange/view.h"
#include "picture/exr_io.h"
#include "picture/image_io.h"
#include "support/in_temporary_folder.h"
#include "support/posed_camera.h"

#include <tiltcal/error.h>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <opencv2/calib3d.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

/// As TiltedCamera, focused and open; k1 of a wide lens.
StateCamera Camera(double tilt_deg = 8)
{
	StateCamera c = TiltedCamera();
	c.state = "plus5";
	c.model = "curved";
	c.lens_tilt_deg = tilt_deg;
	c.distortion = { -0.12, 0.03, 0.001, -0.002, -0.004 };
	c.focus_distance_mm = 650;
	c.aperture_diameter_mm = 16;
	c.field_curvature_per_mm = 2e-4;
	return c;
}

/// Where OpenCV sees the direction v of our camera frame.
cv::Point2d SeenByOpenCv(const StateCamera& c, const Vec3<double>& v)
{
	const OpenCvCamera o = ToOpenCv(c);
	const cv::Matx33d K(o.fx, 0, o.centre[0], 0, o.fy, o.centre[1], 0, 0, 1);
	const std::vector<double> coefficients{ o.distortion[0], o.distortion[1], o.distortion[2], o.distortion[3], o.distortion[4], 0, 0, 0, 0, 0, 0, 0, o.tau_x, o.tau_y };
	const Eigen::Vector3d p = OpenCvFromCamera(c.LensNormal()) * Eigen::Vector3d(v.x, v.y, v.z);
	std::vector<cv::Point2d> pixels;
	cv::projectPoints(std::vector<cv::Point3d>{ { p.x(), p.y(), p.z() } }, cv::Vec3d(), cv::Vec3d(), K, coefficients, pixels);
	return pixels[0];
}

/// What a pinhole with its principal point there sees at a pixel.
Vec3<double> PinholeDirection(const StateCamera& c, double x, double y)
{
	const double w = c.image_distance_mm / c.pitch_mm;
	return { (x - c.principal_point[0]) / w, -(y - c.principal_point[1]) / w, 1 };
}

class Exchange : public InTemporaryFolder {};

TEST_F(Exchange, TheMapOfTheFlatViewIsOpenCvs)
{
	const StateCamera c = Camera();
	const Margins margins{ 40, 30 };
	const cv::Mat map = PixelMap(FlatView(c, margins), c);
	ASSERT_EQ(map.size(), cv::Size(c.width + 80, c.height + 60));
	for (int y = 0; y < map.rows; y += 111)
		for (int x = 0; x < map.cols; x += 111)
		{
			const cv::Point2d place = SeenByOpenCv(c, PinholeDirection(c, x - margins.x, y - margins.y));
			// Floats of up to 2^11 px have steps of 2^-12.
			EXPECT_NEAR(map.at<cv::Vec2f>(y, x)[0], place.x, std::ldexp(1, -12));
			EXPECT_NEAR(map.at<cv::Vec2f>(y, x)[1], place.y, std::ldexp(1, -12));
		}
}

TEST_F(Exchange, StMapsCountFromTheBottomLeftCorner)
{
	StateCamera c = Camera(0);
	c.distortion = {};
	FileSet set;
	WriteStMaps(c, {}, At("a"), set);
	set.Commit();
	for (const char* file : { "a-undistort.exr", "a-redistort.exr" })
	{
		const cv::Mat map = ReadLinear(At(file), {});   // blue, green, red
		ASSERT_EQ(map.size(), cv::Size(c.width, c.height));
		for (const cv::Point p : { cv::Point(0, 0), cv::Point(c.width - 1, 0), cv::Point(7, c.height - 1) })
		{
			// Floats below 1 have steps of 2^-24; the pixel itself is one of 2^-12 px.
			EXPECT_NEAR(map.at<cv::Vec3f>(p)[2], (p.x + 0.5) / c.width, 2e-7);
			EXPECT_NEAR(map.at<cv::Vec3f>(p)[1], 1 - (p.y + 0.5) / c.height, 2e-7);
		}
	}
}

TEST_F(Exchange, OneMapUndoesTheOther)
{
	const StateCamera c = Camera();
	const Margins margins = MarginsOfAll(c);
	const StateCamera flat = FlatView(c, margins);
	const cv::Mat there = PixelMap(c, flat);
	for (int y = 0; y < c.height; y += 37)
		for (int x = 0; x < c.width; x += 37)
		{
			const cv::Vec2f place = there.at<cv::Vec2f>(y, x);
			ASSERT_FALSE(std::isnan(place[0]));
			// The overscan shows it all.
			EXPECT_GE(place[0], 0);
			EXPECT_LE(place[0], flat.width - 1);
			EXPECT_GE(place[1], 0);
			EXPECT_LE(place[1], flat.height - 1);
			const cv::Point2d back = SeenByOpenCv(c, PinholeDirection(flat, place[0], place[1]));
			// Two roundings to 2^-12.
			EXPECT_NEAR(back.x, x, std::ldexp(1, -11));
			EXPECT_NEAR(back.y, y, std::ldexp(1, -11));
		}
	EXPECT_EQ(SharePictured(c, margins), 1);
	EXPECT_LT(SharePictured(c, {}), 1);   // barrel distortion: the undistorted corners are outside
}

TEST_F(Exchange, WhatTheLensNeverShowsIsNowhere)
{
	StateCamera c = Camera(0);
	c.distortion = { -0.5, 0, 0, 0, 0 };   // turns back at r = sqrt(1 / 1.5) = 0.816 by its derivative 1 - 1.5 r^2
	const Margins margins{ c.width, 0 };
	const StateCamera flat = FlatView(c, margins);
	const cv::Mat map = PixelMap(flat, c);
	const double w = c.ImageDistancePx();
	const int row = int(std::lround(flat.principal_point[1]));
	for (int x = 0; x < map.cols; x += 50)
	{
		const double r = std::hypot((x - flat.principal_point[0]) / w, (row - flat.principal_point[1]) / w);
		EXPECT_TRUE((r >= 0.8 && r <= 0.83) || std::isnan(map.at<cv::Vec2f>(row, x)[0]) == (r > 0.83)) << r;
	}
}

TEST_F(Exchange, RaysAndWhatIsInFocusOnThem)
{
	const StateCamera c = Camera();
	for (const double u : { 0.0, 500.5, 1799.0 })
		for (const double v : { 0.0, 700.25 })
		{
			std::ofstream(At("pixels.csv")) << "u_px,v_px\n" << u << "," << v << "\n";
			const std::string text = UnprojectedPixels(c, At("pixels.csv"));
			EXPECT_THAT(text, testing::StartsWith("u_px,v_px,x,y,z,focus_z_mm\n"));
			const auto values = NumbersBetweenCommas(text.substr(text.find('\n') + 1, text.size() - text.find('\n') - 2), 6);
			ASSERT_TRUE(values) << text;
			const Vec3<double> ray{ (*values)[2], (*values)[3], (*values)[4] };
			EXPECT_NEAR(Dot(ray, ray), 1, 1e-14);
			const cv::Point2d pixel = SeenByOpenCv(c, ray);
			EXPECT_NEAR(pixel.x, u, 1e-8);
			EXPECT_NEAR(pixel.y, v, 1e-8);
			// The point in focus has no blur: that is rounding times w d / z, some 1e3 px. Twelve digits of z.
			const Vec3<double> P = ((*values)[5] / ray.z) * ray;
			EXPECT_LT(BlurWidth(c, P), 1e-8);
		}
	FileSet set;
	WriteRayMap(c, At("rays.exr"), set);
	set.Commit();
	Imf::InputFile map(At("rays.exr").c_str());
	const Imath::Box2i window = map.header().dataWindow();
	ASSERT_EQ(window.size(), Imath::V2i(c.width - 1, c.height - 1));
	const char* const names[] = { "ray.X", "ray.Y", "ray.Z", "focus.Z" };
	cv::Mat planes[4];
	Imf::FrameBuffer buffer;
	for (int k = 0; k < 4; ++k)
	{
		planes[k] = cv::Mat(c.height, c.width, CV_32FC1);
		buffer.insert(names[k], Imf::Slice::Make(Imf::FLOAT, planes[k].data, window, sizeof(float), planes[k].step));
	}
	map.setFrameBuffer(buffer);
	map.readPixels(window.min.y, window.max.y);
	for (const int u : { 0, 500, c.width - 1 })
		for (const int v : { 0, 700, c.height - 1 })
		{
			const Vec3<double> ray{ planes[0].at<float>(v, u), planes[1].at<float>(v, u), planes[2].at<float>(v, u) };
			// 24 bits of a direction are 1e-7 of the image distance, some 1e-4 px.
			EXPECT_NEAR(std::sqrt(Dot(ray, ray)), 1, 1e-6);
			const cv::Point2d pixel = SeenByOpenCv(c, ray);
			EXPECT_NEAR(pixel.x, u, 1e-3);
			EXPECT_NEAR(pixel.y, v, 1e-3);
			EXPECT_LT(BlurWidth(c, (planes[3].at<float>(v, u) / ray.z) * ray), 1e-3);
		}
}

TEST_F(Exchange, ProjectsLists)
{
	const StateCamera c = Camera();
	std::ofstream(At("points.csv")) << "# mm\nx, y, z\n\n30,-20,700\n0,0,-5\n";
	const std::string text = ProjectedPoints(c, At("points.csv"));
	const cv::Point2d pixel = SeenByOpenCv(c, { 30, -20, 700 });
	EXPECT_EQ(text, fmt::format("x,y,z,u_px,v_px,blur_px\n30,-20,700,{:.9f},{:.9f},{:.9f}\n0,0,-5,,,\n", pixel.x, pixel.y, BlurWidth(c, { 30, -20, 700 })));
	std::ofstream(At("bad.csv")) << "x,y,z\n1,2,3\n1,2\n";
	try
	{
		ProjectedPoints(c, At("bad.csv"));
		FAIL();
	}
	catch (const Error& e)
	{
		EXPECT_THAT(e.what(), HasSubstr("bad.csv:3: '1,2' is not 3 numbers x,y,z"));
	}
}

TEST_F(Exchange, ColmapOfAnUntiltedLensIsExact)
{
	const StateCamera c = Camera(0);
	const ColmapCamera o = ToColmap(c);
	EXPECT_LT(o.worst_px, 1e-8);
	EXPECT_EQ(o.centre[0], c.principal_point[0] + 0.5);
	EXPECT_THAT(ColmapText(c), HasSubstr(fmt::format("\n1 FULL_OPENCV {} {} ", c.width, c.height)));
}

TEST_F(Exchange, ColmapOfATiltedLensSaysHowNearItIs)
{
	const StateCamera c = Camera();
	const ColmapCamera o = ToColmap(c);
	const cv::Matx33d K(o.fx, 0, o.centre[0] - 0.5, 0, o.fy, o.centre[1] - 0.5, 0, 0, 1);
	double worst = 0, sum = 0, unfitted = 0;
	int count = 0;
	for (int j = 0; j <= 32; ++j)
		for (int i = 0; i <= 32; ++i, ++count)
		{
			const Point pixel{ i / 32.0 * (c.width - 1), j / 32.0 * (c.height - 1) };
			const Vec3<double> v = Unproject(c, pixel).value();
			const auto error = [&](const cv::Matx33d& matrix, const Distortion& d)
			{
				std::vector<cv::Point2d> seen;
				cv::projectPoints(std::vector<cv::Point3d>{ { v.x, -v.y, v.z } }, cv::Vec3d(), cv::Vec3d(), matrix, std::vector<double>(d.begin(), d.end()), seen);
				return std::hypot(seen[0].x - pixel[0], seen[0].y - pixel[1]);
			};
			const double off = error(K, o.distortion), w = c.ImageDistancePx();
			worst = std::max(worst, off);
			sum += off * off;
			unfitted = std::max(unfitted, error({ w, 0, c.principal_point[0], 0, w, c.principal_point[1], 0, 0, 1 }, c.distortion));
		}
	EXPECT_NEAR(o.worst_px, worst, 1e-6);
	EXPECT_NEAR(o.rms_px, std::sqrt(sum / count), 1e-6);
	EXPECT_GT(o.worst_px, 1e-3);           // it is another model
	EXPECT_LT(o.worst_px, unfitted);
}

TEST_F(Exchange, ThePlaneOfFocusIsWhatRenderersGet)
{
	for (const double tilt : { 0.0, 8.0, -3.0 })
	{
		const StateCamera c = Camera(tilt);
		const View view = ViewOf(c);
		ASSERT_TRUE(view.has_plane);
		const Vec3<double> q = c.PlaneOfFocus();
		for (const Vec3<double>& P : { view.square[0], view.square[1], view.square[2], view.square[3], view.in_focus[0], view.in_focus[1], view.in_focus[2] })
			EXPECT_NEAR(Dot(q, P), 1, 1e-12);
		// The first point is seen in the picture's centre; the bowl's focus there is what a flat camera gets.
		EXPECT_NEAR(view.in_focus[0].x / view.in_focus[0].z, (0.5 * (c.width - 1) - c.principal_point[0]) * c.pitch_mm / c.image_distance_mm, 1e-12);
		EXPECT_LT(BlurWidth(c, view.focus_depth_mm * view.centre), 1e-9);
		const Vec3<double> a = view.in_focus[1] - view.in_focus[0], b = view.in_focus[2] - view.in_focus[0];
		EXPECT_NEAR(Dot(a, b), 0, 1e-6);
		EXPECT_GT(std::sqrt(Dot(a, a)), 1);
	}
	StateCamera far = Camera(0);
	far.focus_distance_mm = std::numeric_limits<double>::infinity();
	EXPECT_FALSE(ViewOf(far).has_plane);
}

/// Smooth light by direction: what every picture of these tests shows.
double Light(const Vec3<double>& v) { return 0.5 + 0.2 * std::sin(60 * v.x / v.z) + 0.2 * std::cos(60 * v.y / v.z); }

template<typename Direction>
cv::Mat Picture(const StateCamera& c, Direction direction)
{
	cv::Mat picture(c.height, c.width, CV_32FC1);
	for (int y = 0; y < c.height; ++y)
		for (int x = 0; x < c.width; ++x)
			picture.at<float>(y, x) = float(Light(direction(x, y)));
	return picture;
}

TEST_F(Exchange, PicturesAreResampled)
{
	const StateCamera c = Camera();
	const Margins margins = MarginsOfAll(c);
	const StateCamera flat = FlatView(c, margins);
	const cv::Mat photo = Picture(c, [&](int x, int y) { return Unproject(c, { double(x), double(y) }).value(); });
	const cv::Mat straight = Picture(flat, [&](int x, int y) { return PinholeDirection(flat, x, y); });
	// Keys: a = -1/2 is off by the third derivative times (2 s^3 - 3 s^2 + s) / 6, 0.01604 at most, and 1/384 of the fourth, each way. Places
	// are floats, off by 2^-12 px each way. The lens stretches by less than 1.25; light below 1 in floats is off by 2^-24, in some 32 products.
	const double rate = 1.25 * 60 / c.ImageDistancePx();
	const double bound = 2 * 0.2 * (0.01604 * std::pow(rate, 3) + std::pow(rate, 4) / 384 + rate * std::ldexp(1, -12)) + 32 * std::ldexp(1, -24);
	const cv::Mat made = Resampling(c, margins, Direction::UNDISTORT).Of(photo, "photo");
	const cv::Mat back = Resampling(c, margins, Direction::REDISTORT).Of(straight, "straight");
	ASSERT_EQ(made.size(), straight.size());
	ASSERT_EQ(back.size(), photo.size());
	const cv::Mat map = PixelMap(flat, c);
	for (int y = 3; y + 3 < photo.rows; y += 7)
		for (int x = 3; x + 3 < photo.cols; x += 7)
			EXPECT_NEAR(back.at<float>(y, x), photo.at<float>(y, x), bound);
	int inside = 0;
	for (int y = 0; y < made.rows; y += 7)
		for (int x = 0; x < made.cols; x += 7)
		{
			const cv::Vec2f place = map.at<cv::Vec2f>(y, x);
			if (!(place[0] > 3 && place[1] > 3 && place[0] < float(c.width - 4) && place[1] < float(c.height - 4)))
				continue;
			EXPECT_NEAR(made.at<float>(y, x), straight.at<float>(y, x), bound);
			++inside;
		}
	EXPECT_GT(inside, 0.8 * c.width * c.height / 49);
	EXPECT_THROW(Resampling(c, {}, Direction::REDISTORT).Of(straight, "straight"), Error);
}

TEST_F(Exchange, PicturesComeBackFromTheirFiles)
{
	const cv::Mat picture = Picture(Camera(), [&](int x, int y) { return Vec3<double>{ 0.001 * x, 0.001 * y, 1 }; });
	const Transfer gamma = ParseTransfer("2.2");
	FileSet set;
	WriteLinear(picture, gamma, At("a.png"), set);
	WriteLinear(picture, gamma, At("a.exr"), set);
	EXPECT_THROW(WriteLinear(picture, gamma, At("a.jpg"), set), Error);
	set.Commit();
	// Half a step of 16 bits, times the curve's greatest slope, 2.2.
	EXPECT_LE(cv::norm(ReadLinear(At("a.png"), gamma), picture, cv::NORM_INF), 2.2 * 0.5 / 65535 + 1e-6);
	EXPECT_EQ(cv::norm(ReadLinear(At("a.exr"), gamma), picture, cv::NORM_INF), 0);
}

TEST_F(Exchange, FootprintsAreWhatTheLensPointsSee)
{
	const StateCamera c = Camera();
	const Vec3<double> n = c.LensNormal(), q = c.PlaneOfFocus();
	for (const Vec3<double> P : { Vec3<double>{ 0, 0, 400 }, Vec3<double>{ 200, -150, 900 }, Vec3<double>{ -90, 60, 3000 } })
	{
		const std::vector<Point> outline = *Footprint(c, P, 8);
		ASSERT_EQ(outline.size(), 8u);
		for (const Point& pixel : outline)
		{
			// MODEL.md: from S on the rim, the pixel's ray has the direction v - kappa(v) S, and P lies on it. S is where the line through P
			// meets the rim: S = (P - t v) / (1 - t kappa), in the lens plane and 8 mm from its centre.
			const Vec3<double> v = Unproject(c, pixel).value();
			const double kappa = Dot(q, v) + c.field_curvature_per_mm * Dot(v, n) * Dot((1 / Dot(v, n)) * v - n, (1 / Dot(v, n)) * v - n);
			const double t = Dot(P, n) / Dot(v, n);   // S.n = 0
			const Vec3<double> S = (1 / (1 - t * kappa)) * (P - t * v);
			// Unproject's 1e-9 of some thousand pixels, times w / pixel.
			EXPECT_NEAR(std::sqrt(Dot(S, S)), 8, 1e-6);
		}
	}
	// Untilted, flat and without distortion it is the paper's circle, (2).
	StateCamera plain = Camera(0);
	plain.distortion = {};
	plain.field_curvature_per_mm = 0;
	const Vec3<double> P{ 50, 20, 1200 };
	const Point centre = *Project(plain, P);
	const std::vector<Point> circle = *Footprint(plain, P, 5);
	for (const Point& pixel : circle)
		EXPECT_NEAR(std::hypot(pixel[0] - centre[0], pixel[1] - centre[1]), 0.5 * plain.ImageDistancePx() * 16 * std::abs(1 / 1200.0 - 1 / 650.0), 1e-9);
	EXPECT_FALSE(Footprint(plain, { 0, 0, -5 }));
}

}
