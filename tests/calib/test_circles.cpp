// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Grids of circles against pictures that are the mean of pinhole pictures (thin_lens_picture.h).

#include <tiltcal/error.h>
#include <tiltcal/photo.h>
#include "measure/find_circles.h"
#include "measure/measure_circles.h"
#include "measure/spread_order.h"
#include "edge/soft_radius.h"
#include "support/thin_lens_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <set>
#include <tuple>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const double SPACING = 25;

Board Symmetric(int columns = 8, int rows = 6) { return MakeBoard(TargetKind::CIRCLES, std::to_string(columns) + "x" + std::to_string(rows), SPACING, 13, ""); }
Board Asymmetric(int columns = 4, int rows = 9) { return MakeBoard(TargetKind::ASYMMETRIC_CIRCLES, std::to_string(columns) + "x" + std::to_string(rows), 20, 14, ""); }

Pattern PatternOf(const Board& b) { return Circles(b.columns, b.rows, b.square_mm, b.circle_diameter_mm, b.kind == TargetKind::ASYMMETRIC_CIRCLES); }

/// Middle of the grid, mm.
Eigen::Vector2d Middle(const Board& b) { return 0.5 * b.square_mm * Eigen::Vector2d(b.CircleColumn(b.columns - 1, b.rows - 1), b.rows - 1); }

struct Errors
{
	double centre = 0, centre_sigmas = 0;   // RMS of x and y: px, and in units of sigma
	double blur = 0, blur_sigmas = 0;       // RMS of the radius: px, sigma
	double blur_mean = 0;
	double ratio = 0;
	size_t arcs = 0, dropped = 0;
	bool bright = false;
};

Errors Measure(const Scene& scene, const Board& board, const cv::Mat& picture, const DetectOptions& options = {})
{
	Photo photo;
	photo.file = "synthetic";
	MeasureCircles(picture, board, options, photo);
	Errors e;
	for (const Corner& c : photo.corners)
	{
		const Eigen::Vector2d d = Eigen::Vector2d(c.x, c.y) - PixelOf(scene, c.column * board.square_mm, c.row * board.square_mm);
		e.centre += d.squaredNorm() / 2;
		e.centre_sigmas += d.squaredNorm() / (2 * c.sigma * c.sigma);
	}
	for (const Edge& k : photo.edges)
	{
		const double nx = k.nx - k.slope * k.ny, ny = k.ny + k.slope * k.nx, length = std::hypot(nx, ny);
		const double d = 0.5 * k.blur - BlurRadius(scene, k.board_column * board.square_mm, k.board_row * board.square_mm, nx / length, ny / length);
		e.blur += d * d;
		e.blur_mean += d;
		e.blur_sigmas += std::pow((SoftDiameter(k.blur) - SoftDiameter(k.blur - 2 * d)) / k.blur_sigma, 2);
		e.ratio += k.BlurRatio();
	}
	const double n = double(photo.corners.size()), m = double(photo.edges.size());
	e.centre = std::sqrt(e.centre / n);
	e.centre_sigmas = std::sqrt(e.centre_sigmas / n);
	e.blur = std::sqrt(e.blur / m);
	e.blur_sigmas = std::sqrt(e.blur_sigmas / m);
	e.blur_mean /= m;
	e.ratio /= m;
	e.arcs = photo.edges.size();
	e.dropped = size_t(photo.edges_dropped);
	e.bright = photo.bright_circles;
	std::printf("ratio %.3f centres %.4f px (%.2f sigma), blur radius %.3f px RMS (%.2f sigma), mean %+.3f, %zu arcs, %zu dropped\n",
		e.ratio, e.centre, e.centre_sigmas, e.blur, e.blur_sigmas, e.blur_mean, e.arcs, e.dropped);
	return e;
}

/// `board` inclined by `incline` towards `direction`, the plane of focus before or behind it so that the blur in its middle is `ratio` of a circle's radius.
Scene Inclined(const Board& board, double ratio, double incline, double direction)
{
	Scene scene;
	scene.aperture = 20;
	const Eigen::Vector2d middle = Middle(board);
	const double distance = 420, radius = 0.5 * board.circle_diameter_mm;   // a circle's radius is 12 px
	Aim(scene, middle.x(), middle.y(), distance, incline, direction, 3);
	// Blur on the board: aperture/2 |1 - distance/focus|.
	scene.focus_point = Eigen::Vector3d(0, 0, distance / (1 - ratio * radius / (0.5 * scene.aperture)));
	scene.noise = 0.006;
	scene.lens_points = 250;
	return scene;
}

struct Case
{
	double ratio, incline, direction;
	bool asymmetric;
};

/// The name of the test.
void PrintTo(const Case& c, std::ostream* out) { *out << c.ratio << "_at_" << c.incline << "_towards_" << c.direction << (c.asymmetric ? "_asymmetric" : ""); }

class CirclesMeasured : public testing::TestWithParam<Case> {};

TEST_P(CirclesMeasured, CentresAndBlur)
{
	const Case& c = GetParam();
	const Board board = c.asymmetric ? Asymmetric() : Symmetric();
	const Scene scene = Inclined(board, c.ratio, c.incline, c.direction);
	const Errors e = Measure(scene, board, TakePicture(scene, PatternOf(board)));
	// The task's bound. Ellipses' middles are up to 0.3 px beside the centres in the inclined pictures.
	EXPECT_LT(e.centre, 0.05);
	// Sigmas hold the noise; 250 lens points are grainy, and neighbouring arcs share no pixel.
	EXPECT_LT(e.centre_sigmas, 1.5);
	EXPECT_GT(e.centre_sigmas, 0.6);
	// Below a pixel the blur hides behind the pixel.
	EXPECT_LT(e.blur, c.ratio < 0.1 ? 0.3 : 0.15);
	EXPECT_LT(std::abs(e.blur_mean), c.ratio < 0.1 ? 0.15 : 0.05);
	EXPECT_LT(e.blur_sigmas, 1.8);
	EXPECT_LT(e.dropped, e.arcs / 10);
}

INSTANTIATE_TEST_SUITE_P(Poses, CirclesMeasured, testing::Values(Case{ 0.05, 40, 30, false }, Case{ 0.25, 0, 0, false }, Case{ 0.25, 40, 30, false },
	Case{ 0.25, 35, 200, true }, Case{ 0.45, 30, 290, false }));

std::string Refusal(const cv::Mat& picture, const Board& board)
{
	Photo photo;
	photo.file = "synthetic";
	try
	{
		MeasureCircles(picture, board, {}, photo);
	}
	catch (const Error& e)
	{
		return e.what();
	}
	return "";
}

TEST(Circles, WhiteOnDarkVignettedAndSmall)
{
	const Board board = Symmetric();
	Scene scene = Inclined(board, 0.2, 30, 120);
	scene.vignetting = 3;
	scene.eight_bit = true;
	const Pattern dark = PatternOf(board);
	const Errors e = Measure(scene, board, TakePicture(scene, { [&](double x, double y) { return 0.85f - dark.light(x, y); } }));
	EXPECT_TRUE(e.bright);
	EXPECT_LT(e.centre, 0.05);
	EXPECT_LT(std::abs(e.blur_mean), 0.05);
	// Two thirds of the size: 7 to 9 px of radius are measured in four arcs.
	scene.width = 427;
	scene.height = 320;
	scene.w_px = 533;
	const Errors small = Measure(scene, board, TakePicture(scene, dark));
	EXPECT_FALSE(small.bright);
	EXPECT_LE(small.arcs, 4u * 48);
	EXPECT_LT(small.dropped, 20u);
	EXPECT_LT(small.centre, 0.05);
	scene.width = 256;
	scene.height = 192;
	scene.w_px = 320;
	EXPECT_NE(Refusal(TakePicture(scene, dark), board).find("pixels across"), std::string::npos);
}

/// A picture of few lens points, good enough to find the grid in.
cv::Mat Sketch(const Board& board)
{
	Scene scene = Inclined(board, 0.1, 20, 60);
	scene.lens_points = 24;
	return TakePicture(scene, PatternOf(board));
}

TEST(Circles, WrongGridsAreRefused)
{
	const Board board = Symmetric();
	const cv::Mat picture = Sketch(board);
	ASSERT_EQ(Refusal(picture, board), "");
	for (const auto& [columns, rows] : { std::pair{ 7, 6 }, std::pair{ 8, 7 } })
		EXPECT_NE(Refusal(picture, Symmetric(columns, rows)), "") << columns << "x" << rows;
	EXPECT_NE(Refusal(picture, Asymmetric(4, 7)), "");
	// 16 mm instead of 13.
	EXPECT_NE(Refusal(picture, MakeBoard(TargetKind::CIRCLES, "8x6", SPACING, 16, "")).find("`circle_diameter` 13"), std::string::npos);
	cv::Mat covered = picture.clone();
	covered(cv::Rect(0, 0, covered.cols / 2, covered.rows / 2)).setTo(0.3);
	EXPECT_NE(Refusal(covered, board).find("no grid of 8x6 circles"), std::string::npos);
}

TEST(Circles, WhereThePictureEndsTheGridDoesToo)
{
	// The paper ends 0.76 of a spacing below the last row, and what lies below it is as dark as a circle beside it. Wherever the picture ends there, no row goes on, and a row that is whole does.
	for (const bool asymmetric : { false, true })
	{
		const Board board = asymmetric ? Asymmetric() : Symmetric(), fewer = asymmetric ? Asymmetric(4, 7) : Symmetric(8, 5);
		const cv::Mat picture = Sketch(board);
		const FoundCircles found = FindCircles(picture, board, {}, "whole");
		double last = 0, step = 0;
		for (int i = 0; i < board.columns; ++i)
		{
			const Corner &below = found.centres[size_t((board.rows - 1) * board.columns + i)], &above = found.centres[size_t((board.rows - 3) * board.columns + i)];
			last = std::max(last, below.y);
			step = std::max(step, (below.y - above.y) / 2);
		}
		for (double beyond = 0.4; beyond < 1.8; beyond += 0.1)
		{
			const int height = std::min(picture.rows, int(std::lround(last + beyond * step)));
			EXPECT_EQ(Refusal(picture.rowRange(0, height), board), "") << beyond << (asymmetric ? " asymmetric" : "");
		}
		for (const double beyond : { 0.4, 0.8 })
			EXPECT_NE(Refusal(picture.rowRange(0, int(std::lround(last + beyond * step))), fewer), "") << beyond << (asymmetric ? " asymmetric" : "");
	}
}

TEST(Circles, MirroredAsymmetricGridsAreRefused)
{
	const Board board = Asymmetric();
	const cv::Mat picture = Sketch(board);
	EXPECT_EQ(Refusal(picture, board), "");
	cv::Mat mirrored, turned;
	cv::flip(picture, mirrored, 1);
	EXPECT_NE(Refusal(mirrored, board).find("mirrored"), std::string::npos);
	cv::flip(picture, turned, -1);
	EXPECT_NE(Refusal(turned, board).find("upside down"), std::string::npos);
	const FoundCircles found = FindCircles(turned, board, { true }, "turned");
	EXPECT_GT(found.centres.front().x, found.centres.back().x);
	EXPECT_NE(Refusal(picture, Asymmetric(4, 8)).find("odd number"), std::string::npos);
}

TEST(Circles, GridsThatLookTheSameTurnedBeginAtThePicturesTopLeft)
{
	const Board board = Symmetric(6, 6);
	for (const double turn : { 20.0, 110.0, 200.0, -70.0 })
	{
		Scene scene = Inclined(board, 0.1, 15, 60);
		scene.lens_points = 24;
		const Eigen::Vector2d middle = Middle(board);
		Aim(scene, middle.x(), middle.y(), 420, 15, 60, turn);
		const FoundCircles found = FindCircles(TakePicture(scene, PatternOf(board)), board, {}, "turned");
		const Corner &first = found.centres.front(), &last = found.centres.back(), &right = found.centres[5];
		EXPECT_LT(first.x + first.y, last.x + last.y) << turn;
		EXPECT_GT(right.x - first.x, std::abs(right.y - first.y)) << turn;
		EXPECT_GT((right.x - first.x) * (last.y - right.y) - (right.y - first.y) * (last.x - right.x), 0) << turn;
	}
}

TEST(Circles, TooBlurredIsRefusedWithTheRatio)
{
	const Board board = Symmetric();
	for (const double ratio : { 0.75, 0.95 })
	{
		Scene scene = Inclined(board, ratio, 10, 60);
		scene.lens_points = 60;
		const std::string text = Refusal(TakePicture(scene, PatternOf(board)), board);
		EXPECT_NE(text.find("blur"), std::string::npos) << ratio << ": " << text;
		std::printf("%.2f: %s\n", ratio, text.c_str());
	}
}

TEST(Circles, FewArcsAreSpread)
{
	const Board board = Symmetric();
	std::set<std::tuple<int, int, int>> all;
	for (const ArcPlace& p : SpreadArcs(board, 8, 0))
		all.emplace(p.index, p.row, p.arc);
	EXPECT_EQ(all.size(), 8u * 48);
	const Scene scene = Inclined(board, 0.25, 30, 60);
	const cv::Mat picture = TakePicture(scene, PatternOf(board));
	Photo photo;
	photo.file = "few";
	MeasureCircles(picture, board, {}, photo, { 24, 0 });
	EXPECT_EQ(photo.edges.size() + size_t(photo.edges_dropped), 24u);
	std::set<int> arcs, quarters;
	for (const Edge& e : photo.edges)
	{
		arcs.insert(e.arc);
		quarters.insert((e.column >= 4) + 2 * (e.row >= 3));
	}
	EXPECT_GE(arcs.size(), 6u);   // the farthest circles have four
	EXPECT_EQ(quarters.size(), 4u);
	// Centres without arcs are the blobs', moved to where perspective puts them: 0.1 px is their sigma.
	double sum = 0;
	for (const Corner& c : photo.corners)
		sum += (Eigen::Vector2d(c.x, c.y) - PixelOf(scene, c.column * SPACING, c.row * SPACING)).squaredNorm() / 2;
	EXPECT_LT(std::sqrt(sum / double(photo.corners.size())), 0.15);
}

}
