// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How the light changes over a board, told from patterns that are blurred.

#include "measure/light_field.h"

#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tiltcal;

const Vec2 CHANGE(6e-4, -4e-4);   // the light halves over some 1200 px

/// `at(column, row)`: 0 or 1; 40 px a unit from (120, 120) on, turned by 10 degrees, blurred, and lit by CHANGE.
template<typename Function>
cv::Mat Picture(const Function& at, double blur, Photo& photo, int columns, int rows, const Board& board)
{
	const double cosine = std::cos(0.1745), sine = std::sin(0.1745);
	cv::Mat picture(560, 640, CV_32F), large(picture.rows * 4, picture.cols * 4, CV_32F);
	for (int y = 0; y < large.rows; ++y)
		for (int x = 0; x < large.cols; ++x)
		{
			const double u = ((x + 0.5) / 4 - 0.5 - 160) / 40, v = ((y + 0.5) / 4 - 0.5 - 100) / 40;
			large.at<float>(y, x) = float(0.05 + 0.75 * at(cosine * u + sine * v, -sine * u + cosine * v));
		}
	cv::resize(large, picture, picture.size(), 0, 0, cv::INTER_AREA);
	cv::GaussianBlur(picture, picture, cv::Size(), blur);
	for (int y = 0; y < picture.rows; ++y)
		for (int x = 0; x < picture.cols; ++x)
			picture.at<float>(y, x) *= float(std::exp(CHANGE.x() * x + CHANGE.y() * y));
	for (int j = 0; j < rows; ++j)
		for (int i = 0; i < columns; ++i)
		{
			const int column = board.IsCheckerboard() ? i : board.CircleColumn(i, j);
			photo.corners.push_back({ column, j, 160 + 40 * (cosine * column - sine * j), 100 + 40 * (sine * column + cosine * j), 0 });
		}
	return picture;
}

/// 1e-4 a pixel: over an edge's reach of 20 px 0.2 % of the light, which moves a blur of 20 px by some 0.05.
void ExpectTheChange(const LightField& light, const Board& board, double columns, double rows, double step)
{
	for (double row = 0; row < rows; row += step)
		for (double column = 0; column < columns; column += step)
		{
			const Vec2 found = light.Change(Vec2(column, row));
			EXPECT_LT((found - CHANGE).norm(), 1e-4) << Describe(board) << ", " << column << " " << row << ": " << found.transpose();
		}
}

TEST(LightField, IsToldFromABlurredBoard)
{
	const Board board = ParseBoard("10x8", 25);
	const auto checker = [](double x, double y) { return double((int(std::floor(x)) + int(std::floor(y))) & 1); };
	for (const double blur : { 0.5, 8.0 })
	{
		Photo photo;
		const cv::Mat picture = Picture(checker, blur, photo, board.InnerColumns(), board.InnerRows(), board);
		ExpectTheChange(LightField(picture, CornerGrid(photo, board)), board, board.InnerColumns() - 0.5, board.InnerRows() - 0.5, 0.5);
	}
}

TEST(LightField, IsToldFromBlurredCircles)
{
	for (const TargetKind kind : { TargetKind::CIRCLES, TargetKind::ASYMMETRIC_CIRCLES })
	{
		const bool asymmetric = kind == TargetKind::ASYMMETRIC_CIRCLES;
		const Board board = MakeBoard(kind, asymmetric ? "5x7" : "9x7", 25, 0);
		const auto circles = [&](double x, double y)
		{
			double nearest = 1e9;
			for (int j = 0; j < board.rows; ++j)
				for (int i = 0; i < board.columns; ++i)
					nearest = std::min(nearest, std::hypot(x - board.CircleColumn(i, j), y - j));
			return nearest < board.CircleRadius() ? 0.0 : 1.0;
		};
		for (const double blur : { 0.5, 4.0 })
		{
			Photo photo;
			const cv::Mat picture = Picture(circles, blur, photo, board.columns, board.rows, board);
			const LightField light(picture, board, GridMap(photo.corners), photo.corners);
			// Where there are circles all round: at the outline what the blur takes from the last ones' cells does not come back.
			for (const Corner& c : photo.corners)
			{
				if (c.column <= 1 || c.row <= 1 || c.row >= board.rows - 2 || c.column >= board.CircleColumn(board.columns - 1, c.row) - 1)
					continue;
				EXPECT_LT((light.Change(Vec2(c.column, c.row)) - CHANGE).norm(), 1e-4) << Describe(board) << ", " << c.column << " " << c.row;
			}
		}
	}
}

TEST(LightField, SaysNothingWhereTooLittleIsSeen)
{
	const Board board = ParseBoard("10x8", 25);
	Photo photo;
	const cv::Mat picture = Picture([](double, double) { return 1.0; }, 0.5, photo, board.InnerColumns(), board.InnerRows(), board);
	EXPECT_EQ(LightField(picture, CornerGrid(photo, board)).Change(Vec2(100, 100)), Vec2(0, 0));
	EXPECT_EQ(LightField(cv::Mat::zeros(picture.size(), CV_32F), CornerGrid(photo, board)).Change(Vec2(3, 3)), Vec2(0, 0)) << "there is no light";
}

}
