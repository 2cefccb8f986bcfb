// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Detection and blur measurement on a board painted analytically: every pixel is the
// mean over sub-pixels, each moved over the points of a blur disc.

#include "measure/detect.h"
#include <tiltcal/error.h>
#include <tiltcal/calibrate.h>
#include "picture/image_io.h"
#include "measure/measure.h"
#include "simulated_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace
{

using namespace tiltcal;

struct Painted
{
	cv::Mat image;
	cv::Matx33d pixels_from_squares;   // (column, row) from the first inner corner
};

/// A board of `columns` x `rows` squares in light perspective, white margin, grey around.
Painted Paint(int columns, int rows, double blur_radius)
{
	const cv::Matx33d H(52, 4, 110, -3, 50, 105, 2e-5, 1e-4, 1);
	const cv::Matx33d inverse = H.inv();
	const int over = 4;   // sub-pixels a side
	cv::Mat fine(560 * over, 760 * over, CV_32FC1);
	for (int y = 0; y < fine.rows; ++y)
		for (int x = 0; x < fine.cols; ++x)
		{
			const cv::Vec3d p = inverse * cv::Vec3d((x + 0.5) / over - 0.5, (y + 0.5) / over - 0.5, 1);
			const double i = p[0] / p[2] + 1, j = p[1] / p[2] + 1;
			float value = 0.3f;
			if (i >= -1 && j >= -1 && i <= columns + 1 && j <= rows + 1)
				value = 0.8f;
			if (i >= 0 && j >= 0 && i < columns && j < rows && (int(i) + int(j)) % 2 == 0)
				value = 0.05f;
			fine.at<float>(y, x) = value;
		}
	// The disc as a kernel of sub-pixels; its own pixelation is 1/4 px, averaged over angles.
	const int r = static_cast<int>(std::ceil(blur_radius * over));
	cv::Mat kernel(2 * r + 1, 2 * r + 1, CV_32FC1, cv::Scalar(0));
	for (int y = -r; y <= r; ++y)
		for (int x = -r; x <= r; ++x)
			kernel.at<float>(y + r, x + r) = std::hypot(x, y) <= blur_radius * over ? 1.f : 0.f;
	kernel /= cv::sum(kernel)[0];
	cv::Mat blurred;
	cv::filter2D(fine, blurred, -1, kernel);
	Painted painted;
	cv::resize(blurred, painted.image, cv::Size(), 1.0 / over, 1.0 / over, cv::INTER_AREA);
	painted.pixels_from_squares = H;
	return painted;
}

TEST(Detect, CornersAndBlurOfAPaintedBoard)
{
	const double radius = 4;
	const Painted painted = Paint(12, 9, radius);
	Photo photo;
	const Board board = ParseBoard("12x9", 25);
	photo.corners = DetectCorners(painted.image, board, {}, "painted");
	MeasureEdges(painted.image, board, photo);
	ASSERT_EQ(photo.corners.size(), 88u);
	for (const Corner& c : photo.corners)
	{
		const cv::Vec3d p = painted.pixels_from_squares * cv::Vec3d(c.column, c.row, 1);
		// No noise: what is left is the sampling at a quarter pixel.
		EXPECT_NEAR(c.x, p[0] / p[2], 0.05) << c.column << " " << c.row;
		EXPECT_NEAR(c.y, p[1] / p[2], 0.05);
	}
	EXPECT_EQ(photo.edges_dropped, 0);
	for (const Edge& e : photo.edges)
		// The kernel's rim is rough by one sub-pixel of 1/4 px on the radius.
		EXPECT_NEAR(e.blur, 2 * radius, 0.15) << e.column << " " << e.row;
}

TEST(Detect, ChosenEdgesAreTheSameEdges)
{
	const Painted painted = Paint(12, 9, 4);
	const Board board = ParseBoard("12x9", 25);
	Photo all, some;
	all.corners = some.corners = DetectCorners(painted.image, board, {}, "painted");
	MeasureEdges(painted.image, board, all);
	for (const int most : { 8, 41, 157, 1000 })
	{
		MeasureEdges(painted.image, board, some, { most, 0 });
		EXPECT_EQ(some.edges.size(), size_t(std::min(most, 157)));
		for (const Edge& e : some.edges)
		{
			const auto same = std::find_if(all.edges.begin(), all.edges.end(), [&](const Edge& a)
				{ return a.column == e.column && a.row == e.row && a.along_columns == e.along_columns; });
			ASSERT_NE(same, all.edges.end());
			// Each call starts from corners that the one before has refined, by some 0.05 px.
			EXPECT_NEAR(e.blur, same->blur, 0.05);
		}
		EXPECT_EQ(some.corners.size(), 88u);
	}
}

TEST(Detect, MirroredAndTurnedBoards)
{
	const Painted painted = Paint(12, 9, 1.5);
	const Board board = ParseBoard("12x9", 25);
	cv::Mat mirrored, turned;
	cv::flip(painted.image, mirrored, 1);
	EXPECT_THROW(DetectCorners(mirrored, board, {}, "mirrored"), Error);
	cv::rotate(painted.image, turned, cv::ROTATE_180);
	EXPECT_THROW(DetectCorners(turned, board, {}, "turned"), Error);
	// Asked to accept it, the board's own first corner comes first: now at the bottom right.
	const std::vector<Corner> corners = DetectCorners(turned, board, { true }, "turned");
	const cv::Vec3d p = painted.pixels_from_squares * cv::Vec3d(0, 0, 1);
	EXPECT_NEAR(corners[0].x, turned.cols - 1 - p[0] / p[2], 0.1);
	EXPECT_NEAR(corners[0].y, turned.rows - 1 - p[1] / p[2], 0.1);
}

/// The words of a refusal; empty where there is none.
std::string WordsOf(const cv::Mat& picture, const std::string& board, bool any_orientation = false)
{
	try
	{
		DetectCorners(picture, ParseBoard(board, 25), { any_orientation }, "painted");
		return "";
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_REFUSED);
		return e.what();
	}
}

TEST(Detect, ABoardOnItsSideIsSaidToBeAndNotMirrored)
{
	// Counted the other way round, or a camera turned to portrait whose pixels were not: which of its two ways is upright
	// would be told by a hair. Odd and even boards alike.
	for (const auto& [columns, rows] : { std::pair(12, 9), std::pair(12, 8), std::pair(11, 9) })
	{
		const Painted painted = Paint(columns, rows, 1.5);
		const std::string right = std::to_string(columns) + "x" + std::to_string(rows), swapped = std::to_string(rows) + "x" + std::to_string(columns);
		EXPECT_THAT(WordsOf(painted.image, swapped), testing::AllOf(testing::HasSubstr("`board` " + right), testing::Not(testing::HasSubstr("mirrored"))));
		for (const int turn : { cv::ROTATE_90_CLOCKWISE, cv::ROTATE_90_COUNTERCLOCKWISE })
		{
			cv::Mat portrait;
			cv::rotate(painted.image, portrait, turn);
			EXPECT_THAT(WordsOf(portrait, right), testing::HasSubstr("on its side"));
		}
	}
}

TEST(Detect, AnEvenBoardShowsItsMirrorImage)
{
	// 12 x 8: the black corners lie on one diagonal, in the mirror on the other.
	const Painted painted = Paint(12, 8, 1.5);
	const Board board = ParseBoard("12x8", 25);
	EXPECT_EQ(DetectCorners(painted.image, board, {}, "painted").size(), 77u);
	cv::Mat mirrored;
	cv::flip(painted.image, mirrored, 1);
	EXPECT_THROW(DetectCorners(mirrored, board, {}, "mirrored"), Error);
}

// CALIBRATING.md, Limits: nothing tells it from its mirror image.
TEST(Detect, AnOddByOddBoardIsTakenInTheMirrorToo)
{
	const Painted painted = Paint(11, 9, 1.5);
	const Board board = ParseBoard("11x9", 25);
	cv::Mat mirrored;
	cv::flip(painted.image, mirrored, 1);
	EXPECT_EQ(DetectCorners(painted.image, board, {}, "painted").size(), 80u);
	EXPECT_EQ(DetectCorners(mirrored, board, {}, "mirrored").size(), 80u);
}

TEST(Detect, WrongSizesAreRefused)
{
	const Painted painted = Paint(12, 9, 1.5);
	for (const char* const size : { "11x8", "13x10", "9x12", "12x8", "10x9", "8x6" })
		EXPECT_THROW(DetectCorners(painted.image, ParseBoard(size, 25), {}, "painted"), Error) << size;
}

TEST(Detect, PhotographsOfTwoSizesAreRefused)
{
	const Painted painted = Paint(12, 9, 1.5);
	const std::string a = testing::TempDir() + "tiltcal-size-a.png", b = testing::TempDir() + "tiltcal-size-b.png", c = testing::TempDir() + "tiltcal-size-c.png";
	WritePng(a, ToDisplay(painted.image));
	WritePng(c, ToDisplay(0.99 * painted.image));
	WritePng(b, ToDisplay(painted.image(cv::Rect(0, 0, painted.image.cols - 2, painted.image.rows))));
	EXPECT_THROW(MeasureAll({ { "untilted", { a, b } } }, ParseBoard("12x9", 25), 0.02), Error);
	EXPECT_EQ(MeasureAll({ { "untilted", { a, c } } }, ParseBoard("12x9", 25), 0.02).states[0].photos.size(), 2u);
	// Twice the same, under any name.
	std::filesystem::copy_file(a, b, std::filesystem::copy_options::overwrite_existing);
	EXPECT_THROW(MeasureAll({ { "untilted", { a } }, { "tilted", { b } } }, ParseBoard("12x9", 25), 0.02), Error);
	std::filesystem::remove(a);
	std::filesystem::remove(c);
	std::filesystem::remove(b);
}

TEST(Detect, NoBoardIsRefused)
{
	cv::Mat noise(400, 600, CV_32FC1);
	cv::theRNG().state = 1;
	cv::randu(noise, 0.1, 0.9);
	EXPECT_THROW(DetectCorners(noise, ParseBoard("12x9", 25), {}, "noise"), Error);
	EXPECT_THROW(DetectCorners(cv::Mat(400, 600, CV_32FC1, cv::Scalar(0)), ParseBoard("12x9", 25), {}, "black"), Error);
	EXPECT_THROW(DetectCorners(cv::Mat(3, 2, CV_32FC1, cv::Scalar(0.5)), ParseBoard("12x9", 25), {}, "tiny"), Error);
}

TEST(Detect, APlainBoardIsFoundWhateverItsSize)
{
	// Of closed_loop: OpenCV's detector finds this board in pictures of 0.5 to 0.9 of this size and misses it in this one.
	cameras::Camera camera = cameras::Quick(cameras::RandomCamera(1041), 0.3);
	synthetic::Scene scene = cameras::PhotographAll(camera, 1041)[1][4];
	scene.noise = 0.005;
	const Board& board = camera.board;
	const cv::Mat picture = synthetic::TakePicture(scene, synthetic::Checkerboard(board.columns, board.rows, board.square_mm));
	for (const double scale : { 0.6, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0 })
	{
		cv::Mat sized;
		cv::resize(picture, sized, cv::Size(), scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
		const std::vector<Corner> corners = DetectCorners(sized, board, {}, "sized");
		ASSERT_EQ(corners.size(), size_t(board.CornerCount())) << scale;
		for (const Corner& c : corners)
		{
			const Eigen::Vector2d p = synthetic::PixelOf(scene, c.column * board.square_mm, c.row * board.square_mm);
			// Another corner would be a square, 38 px and more, away; a tenth of one is what the first guess may miss a blurred corner by.
			EXPECT_NEAR(c.x, (p.x() + 0.5) * scale - 0.5, 3.8 * scale) << scale;
			EXPECT_NEAR(c.y, (p.y() + 0.5) * scale - 0.5, 3.8 * scale) << scale;
		}
	}
}

TEST(Detect, EdgesBlurredIntoEachOther)
{
	// Radius 24 on squares of 50: the blur of one edge reaches the next.
	const Painted painted = Paint(12, 9, 24);
	const Painted sharp = Paint(12, 9, 1);
	Photo photo;
	const Board board = ParseBoard("12x9", 25);
	photo.corners = DetectCorners(sharp.image, board, {}, "sharp");
	MeasureEdges(painted.image, board, photo);
	for (const Edge& e : photo.edges)
		EXPECT_NEAR(e.blur, 48, 0.5) << "a wrong width must not be reported";   // no noise; the kernel is rough by 1/4 px on the radius
	EXPECT_GT(photo.edges.size(), 120u);
}

TEST(Detect, SquaresTooSmallToMeasureAreRefused)
{
	// Squares of 50 px made 6.5.
	const double scale = 0.13;
	const Painted painted = Paint(12, 9, 1);
	const Board board = ParseBoard("12x9", 25);
	Photo photo;
	photo.file = "small";
	photo.corners = DetectCorners(painted.image, board, {}, "painted");
	for (Corner& c : photo.corners)
	{
		c.x = (c.x + 0.5) * scale - 0.5;
		c.y = (c.y + 0.5) * scale - 0.5;
	}
	cv::Mat small;
	cv::resize(painted.image, small, cv::Size(), scale, scale, cv::INTER_AREA);
	try
	{
		MeasureEdges(small, board, photo);
		FAIL() << photo.edges.size() << " edges";
	}
	catch (const Error& e)
	{
		EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("small: "), testing::HasSubstr("at least 8 px")));
	}
}

TEST(Detect, BlurBeyondMeasuringIsRefused)
{
	const Painted sharp = Paint(12, 9, 1);
	const Board board = ParseBoard("12x9", 25);
	// 0.7 of a square, and 0.96, where black and white have changed places.
	for (const double radius : { 35.0, 48.0 })
	{
		const Painted painted = Paint(12, 9, radius);
		Photo photo;
		photo.corners = DetectCorners(sharp.image, board, {}, "sharp");
		try
		{
			MeasureEdges(painted.image, board, photo);
			ADD_FAILURE() << radius << ": " << photo.edges.size() << " edges";
			// What is left out need not make the photograph useless; what is reported must be true.
			for (const Edge& e : photo.edges)
				EXPECT_NEAR(e.blur, 2 * radius, 3) << radius;
			EXPECT_LT(photo.edges.size(), 40u) << radius;
		}
		catch (const Error& e)
		{
			EXPECT_NE(std::string(e.what()).find("of a square"), std::string::npos);
		}
	}
}

}
