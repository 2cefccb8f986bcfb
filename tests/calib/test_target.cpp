// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Targets to print, measured on the page. Poppler (pdftocairo) reads the PDF; pdftoppm would
// snap axis-parallel edges to whole pixels.

#include "program/process.h"
#include "measure/detect.h"
#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "target/target.h"
#include "support/in_temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

const double DPI = 150;

/// Page millimetres of a pixel whose centre is at integers.
double Mm(double pixel) { return (pixel + 0.5) * 25.4 / DPI; }

class Print : public InTemporaryFolder
{
protected:
	/// Writes the page as PDF and reads what poppler makes of it.
	cv::Mat Printed(const TargetPage& page)
	{
		const std::string pdf = At("page.pdf"), png = At("page");
		WriteTarget(page, pdf);
		const ProcessResult converted = RunProcess({ { "pdftocairo", "-r", fmt::format("{}", DPI), "-gray", "-png", "-singlefile", pdf, png } });
		EXPECT_EQ(converted.exit_code, 0) << "pdftocairo (package poppler-utils): " << converted.said;
		const cv::Mat picture = cv::imread(png + ".png", cv::IMREAD_GRAYSCALE);
		EXPECT_FALSE(picture.empty());
		// Whole pixels, rounded up.
		EXPECT_NEAR(picture.cols, page.width / 25.4 * DPI, 1);
		EXPECT_NEAR(picture.rows, page.height / 25.4 * DPI, 1);
		return picture;
	}
};

// A printer of 600 dpi places dots to 0.04 mm; the page is drawn to 0.001 mm, and what is measured
// here at 150 dpi is good to 0.1 px or 0.02 mm.
const double TRUE_MM = 0.05;

TEST_F(Print, CheckerboardHasItsTrueSize)
{
	const TargetPage page = LayOut(MakeBoard(TargetKind::CHECKERBOARD, "8x5", 17, 0, ""), "a4", 10);
	EXPECT_EQ(page.paper, "a4 portrait");
	cv::Mat light;
	Printed(page).convertTo(light, CV_32F, 1 / 255.0);
	const std::vector<Corner> corners = DetectCorners(light, { 8, 5, 17 }, {}, "page.pdf");
	ASSERT_EQ(corners.size(), 28u);
	// In the middle of the width; from the top, of what margin (10) and strip (20 + 10) leave.
	const double left = (210 - 8 * 17) / 2.0, top = (10 + 297 - 30 - 5 * 17) / 2.0;
	for (const Corner& c : corners)
	{
		EXPECT_NEAR(Mm(c.x), left + (c.column + 1) * 17, TRUE_MM);
		EXPECT_NEAR(Mm(c.y), top + (c.row + 1) * 17, TRUE_MM);
	}
}

TEST_F(Print, ScaleBarIsAsLongAsItSays)
{
	const TargetPage page = LayOut(MakeBoard(TargetKind::CHECKERBOARD, "8x5", 17, 0, ""), "a4", 10);
	const cv::Mat picture = Printed(page);
	// Along the bar's middle: five black fields of 10 mm and the line of 0.2 mm that closes it. Each by its centre of ink.
	const int row = static_cast<int>(std::lround((page.strip.y + 1 + 1.25) / 25.4 * DPI - 0.5));
	std::vector<double> centres;
	double ink = 0, moment = 0;
	for (int x = static_cast<int>((page.strip.x + 12) / 25.4 * DPI); x < picture.cols; ++x)
	{
		const double dark = 255 - picture.at<uchar>(row, x);
		ink += dark;
		moment += dark * x;
		if (dark == 0 && ink > 0)
		{
			centres.push_back(Mm(moment / ink));
			ink = moment = 0;
		}
	}
	ASSERT_EQ(centres.size(), 6u);
	for (size_t k = 0; k < 6; ++k)
		EXPECT_NEAR(centres[k] - (page.strip.x + 14), k < 5 ? 20.0 * static_cast<double>(k) + 5 : 99.9, TRUE_MM);
}

TEST_F(Print, CirclesAreWhereOpenCvFindsThem)
{
	for (const bool asymmetric : { false, true })
	{
		const TargetPage page = LayOut(MakeBoard(asymmetric ? TargetKind::ASYMMETRIC_CIRCLES : TargetKind::CIRCLES, asymmetric ? "4x11" : "7x6", 18, 0, ""), "a4", 10);
		std::vector<cv::Point2f> found;
		ASSERT_TRUE(cv::findCirclesGrid(Printed(page), asymmetric ? cv::Size(4, 11) : cv::Size(7, 6), found,
			asymmetric ? cv::CALIB_CB_ASYMMETRIC_GRID : cv::CALIB_CB_SYMMETRIC_GRID));
		// OpenCV's own formula for the asymmetric grid: ((2 j + i % 2) square, i square). Its order of a symmetric
		// grid is free, so every found centre is compared with the nearest one.
		std::vector<cv::Point2d> expected;
		const double diameter = asymmetric ? 9 * std::sqrt(2.0) : 9;
		const double width = (asymmetric ? 7 : 6) * 18 + diameter, height = (asymmetric ? 10 : 5) * 18 + diameter;
		for (int i = 0; i < (asymmetric ? 11 : 6); ++i)
			for (int j = 0; j < (asymmetric ? 4 : 7); ++j)
				expected.emplace_back((210 - width) / 2 + diameter / 2 + (asymmetric ? 2 * j + i % 2 : j) * 18, (10 + 267 - height) / 2 + diameter / 2 + i * 18);
		ASSERT_EQ(found.size(), expected.size());
		for (const cv::Point2f& p : found)
		{
			double nearest = 1e9;
			for (const cv::Point2d& e : expected)
				nearest = std::min(nearest, std::hypot(Mm(p.x) - e.x, Mm(p.y) - e.y));
			EXPECT_LT(nearest, TRUE_MM);
		}
	}
}

TEST_F(Print, SvgIsInMillimetres)
{
	const std::string file = At("page.svg");
	WriteTarget(LayOut(MakeBoard(TargetKind::CHECKERBOARD, "12x9", 25, 0, ""), "auto", 10), file);
	std::ostringstream text;
	text << std::ifstream(file).rdbuf();
	EXPECT_THAT(text.str(), HasSubstr("width=\"420mm\" height=\"297mm\" viewBox=\"0 0 420 297\""));
	// The first black square: 60 to 85 mm from the left, 26 to 51 from the top.
	EXPECT_THAT(text.str(), HasSubstr("M 60 26 L 85 26 L 85 51 L 60 51"));
}

TEST_F(Print, UnwritableFileIsNamed)
{
	EXPECT_THROW(WriteTarget(LayOut(MakeBoard(TargetKind::CIRCLES, "7x6", 18, 0, ""), "a4", 10), At("nowhere/page.pdf")), Error);
}

std::string Refusal(const std::string& board, double square, const std::string& paper)
{
	try
	{
		LayOut(MakeBoard(TargetKind::CHECKERBOARD, board, square, 0, ""), paper, 10);
	}
	catch (const Error& e)
	{
		return e.what();
	}
	return "accepted";
}

TEST(TargetLayout, RefusesWhatDoesNotFitAndSaysWhatDoes)
{
	EXPECT_THAT(Refusal("12x9", 25, "a4"), HasSubstr("--paper a3 holds it"));
	EXPECT_THAT(Refusal("12x9", 25, "letter"), HasSubstr("--paper a3 holds it"));
	EXPECT_THAT(Refusal("12x9", 100, "a0"), HasSubstr("--paper 1320x1040"));
	EXPECT_EQ(Refusal("12x9", 100, "1320x1040"), "accepted");
	EXPECT_EQ(Refusal("12x9", 25, "345x290"), "accepted");
	EXPECT_THAT(Refusal("12x9", 25, "344.9x290"), HasSubstr("345 x 290"));
	EXPECT_THAT(Refusal("12x9", 25, "foolscap"), HasSubstr("letter"));
}

TEST(TargetLayout, KeepsTheQuietZoneClear)
{
	for (const char* const paper : { "a3", "a2", "345x290" })
	{
		const TargetPage p = LayOut(MakeBoard(TargetKind::CHECKERBOARD, "12x9", 25, 0, ""), paper, 10);
		EXPECT_GE(p.pattern.x, 12.5 + 10 - 1e-9);
		EXPECT_GE(p.pattern.y, 12.5 + 10 - 1e-9);
		EXPECT_LE(p.pattern.y + p.pattern_height + 12.5, p.strip.y + 1e-9);
	}
}

TEST(TargetLayout, KnowsWhatLooksTheSameTurned)
{
	const auto same = [](TargetKind kind, const char* board) { return LooksTheSameTurned(MakeBoard(kind, board, 10, 0, "")); };
	EXPECT_FALSE(same(TargetKind::CHECKERBOARD, "12x9"));
	EXPECT_TRUE(same(TargetKind::CHECKERBOARD, "12x8"));
	EXPECT_TRUE(same(TargetKind::CHECKERBOARD, "11x9"));
	EXPECT_TRUE(same(TargetKind::CIRCLES, "7x6"));
	EXPECT_FALSE(same(TargetKind::ASYMMETRIC_CIRCLES, "4x11"));
	EXPECT_TRUE(same(TargetKind::ASYMMETRIC_CIRCLES, "4x10"));
}

}
