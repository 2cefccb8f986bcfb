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
		// README: cornerSubPix stays within about 0.1 px of them on average.
		EXPECT_LT(sum / 266, 0.15) << file;
		EXPECT_LT(worst, 1) << file;
	}
}

TEST(RealBoards, SonyChessGivesThePublishedIntrinsics)
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
	// intrinsic.yaml: fx 701.01, fy 698.65, cx 308.46, cy 246.84, radial -0.2556, 0.1000. Their two focal lengths differ by 0.3 %,
	// ours is one; their k1 and k2 stand for our k1, k2 and k3.
	EXPECT_NEAR(g.w_px, 0.5 * (701.01 + 698.65), 4);
	EXPECT_NEAR(g.principal_point[0][0], 308.46, 4);
	EXPECT_NEAR(g.principal_point[0][1], 246.84, 4);
	EXPECT_NEAR(g.distortion[0], -0.2556, 0.04);
	EXPECT_LT(g.rms, 0.4);
}

}
