// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs of checkerboards taken by others (../shared/data/real-boards, its README): skipped where they are absent.
// TILTCAL_REAL_BOARDS names another folder.

#include "calibrate.h"
#include "detect.h"
#include "image_io.h"
#include "measure.h"
#include "solve_geometry.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace
{

using namespace tiltcal;

std::string Folder(const std::string& set)
{
	const char* const named = std::getenv("TILTCAL_REAL_BOARDS");
	return (named ? std::string(named) : std::string(REAL_BOARDS_FOLDER)) + "/" + set;
}

bool Absent(const std::string& folder) { return !std::filesystem::is_directory(folder); }

std::vector<std::string> Pictures(const std::string& folder)
{
	std::vector<std::string> files;
	for (const auto& entry : std::filesystem::directory_iterator(folder))
		if (entry.path().extension() == ".jpg")
			files.push_back(entry.path().string());
	std::sort(files.begin(), files.end());
	return files;
}

TEST(RealBoards, MultiDicCornersAreWhereMatlabFindsThem)
{
	const std::string folder = Folder("MultiDIC-201");
	if (Absent(folder))
		GTEST_SKIP() << folder << " is not there";
	std::map<std::string, std::vector<cv::Point2d>> published;
	std::ifstream in(folder + "/corners-matlab.csv");
	std::string line;
	std::getline(in, line);
	while (std::getline(in, line))
	{
		std::replace(line.begin(), line.end(), ',', ' ');
		std::istringstream fields(line);
		std::string file;
		int index;
		cv::Point2d p;
		fields >> file >> index >> p.x >> p.y;
		published[file].push_back(p);
	}
	ASSERT_EQ(published.size(), 12u);
	const Board board = ParseBoard("20x15", 10);
	double all = 0;
	for (const std::string& file : Pictures(folder))
	{
		const Photo photo = MeasurePhoto(file, board, Transfer(), { true }, { 60, 0 });
		const std::vector<cv::Point2d>& theirs = published.at(std::filesystem::path(file).filename().string());
		ASSERT_EQ(photo.corners.size(), 266u) << file;
		double sum = 0, worst = 0;
		for (const Corner& c : photo.corners)
		{
			double nearest = 1e9;
			for (const cv::Point2d& p : theirs)
				nearest = std::min(nearest, std::hypot(p.x - c.x, p.y - c.y));
			sum += nearest;
			worst = std::max(worst, nearest);
		}
		std::printf("%s: mean %.3f px, worst %.3f px; %s\n", std::filesystem::path(file).filename().c_str(), sum / 266, worst, RatioText(photo).c_str());
		all += sum / 266 / 12;
		// The README's margin is an average over the set. One photograph is judged by how far cornerSubPix, a third detector,
		// moves away from MATLAB's corners in it (0.08 to 0.16 px); ours may be as far and what two detectors differ by.
		std::vector<cv::Point2f> refined(theirs.begin(), theirs.end());
		cv::cornerSubPix(cv::imread(file, cv::IMREAD_GRAYSCALE), refined, cv::Size(9, 9), cv::Size(-1, -1),
			cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-4));
		double moved = 0;
		for (size_t k = 0; k < refined.size(); ++k)
			moved += std::hypot(refined[k].x - theirs[k].x, refined[k].y - theirs[k].y) / double(refined.size());
		EXPECT_LT(sum / 266, moved + 0.03) << file;
		EXPECT_LT(worst, 1) << file;
	}
	// README: about 0.1 px on average.
	EXPECT_LT(all, 0.11);
}

struct OpenCvCamera
{
	double fx, fy, cx, cy, k1, k2, sigma[4];
};

/// OpenCV's own calibration from our corners.
OpenCvCamera CalibrateWithOpenCv(const Task& task, int flags)
{
	std::vector<std::vector<cv::Point3f>> board;
	std::vector<std::vector<cv::Point2f>> pixels;
	for (const Photo& photo : task.states[0].photos)
	{
		board.emplace_back();
		pixels.emplace_back();
		for (const Corner& c : photo.corners)
		{
			board.back().emplace_back(float(task.board.X(c.column)), float(-task.board.Y(c.row)), 0.f);
			pixels.back().emplace_back(float(c.x), float(c.y));
		}
	}
	cv::Mat K, d, r, t, sigma, extrinsic, each;
	cv::calibrateCamera(board, pixels, cv::Size(task.width, task.height), K, d, r, t, sigma, extrinsic, each, flags);
	const auto s = [&](int k) { return sigma.at<double>(k); };
	return { K.at<double>(0, 0), K.at<double>(1, 1), K.at<double>(0, 2), K.at<double>(1, 2), d.at<double>(0), d.at<double>(1), { s(0), s(1), s(2), s(3) } };
}

TEST(RealBoards, SonyChessIntrinsics)
{
	const std::string folder = Folder("Sony_DSC-HX5V_Chess");
	if (Absent(folder))
		GTEST_SKIP() << folder << " is not there";
	DetectOptions options{ true };
	// 5 x 7 squares: both odd, all orientations are alike. The pitch only scales.
	const Task task = MeasureAll({ { "untilted", Pictures(folder) } }, ParseBoard("5x7", 30), 0.01, Transfer(), options);
	ASSERT_EQ(task.states[0].photos.size(), 13u);
	const Geometry g = SelectGeometry(task, {});
	std::printf("w %.2f +- %.2f px, principal point %.2f %.2f, k1 %.4f k2 %.4f, %.3f px RMS\n", g.w_px, g.w_px_sigma,
		g.principal_point[0][0], g.principal_point[0][1], g.distortion[0], g.distortion[1], g.rms);
	// intrinsic.yaml, with the model that it has: two focal lengths, k1, k2. Bounds: three of the fit's own sigmas.
	const OpenCvCamera published = CalibrateWithOpenCv(task, cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K3);
	EXPECT_NEAR(published.fx, 701.01, 3 * published.sigma[0]);
	EXPECT_NEAR(published.fy, 698.65, 3 * published.sigma[1]);
	EXPECT_NEAR(published.cx, 308.46, 3 * published.sigma[2]);
	EXPECT_NEAR(published.cy, 246.84, 3 * published.sigma[3]);
	// tiltcal has one focal length, for square pixels. These photographs want two, 0.3 % apart, and with one the principal point
	// moves by 12 px from the published one, in OpenCV too: so tiltcal is held to OpenCV with one focal length and k1.
	const OpenCvCamera same = CalibrateWithOpenCv(task, cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3);
	ASSERT_EQ(g.distortion_terms, 1);
	// The weights of the corners differ, by a part of a sigma.
	EXPECT_NEAR(g.w_px, same.fx, g.w_px_sigma);
	EXPECT_NEAR(g.principal_point[0][0], same.cx, 2);
	EXPECT_NEAR(g.principal_point[0][1], same.cy, 2);
	EXPECT_NEAR(g.distortion[0], same.k1, 0.01);
}

}
