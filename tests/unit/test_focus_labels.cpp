// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The numbers on the contours of `show focus`: on their contours, whole within the picture, apart from each other.

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "lens/focus_labels.h"

using namespace tilt_lens;

namespace
{

template<typename Blur>
FocusLabels LabelsOf(int width, int height, Blur blur)
{
	BlurGrid grid = BlurGrid::Of(width, height);
	for(int row = 0; row < grid.rows; row++)
		for(int column = 0; column < grid.columns; column++)
			grid.blur[size_t(row) * grid.columns + column] = blur(column * grid.spacing, row * grid.spacing);
	return FocusLabels(grid);
}

double MiddleX(const FocusLabel& label) { return label.left + 0.5 * (label.columns - 1); }
double MiddleY(const FocusLabel& label) { return label.top + 0.5 * (label.rows - 1); }

}

TEST(FocusLabels, StandOnTheContoursOfAPlane)
{
	std::mt19937 random(3);
	std::uniform_real_distribution<double> slope(-0.5, 0.5);
	int count = 0;
	for(int n = 0; n < 50; n++)
	{
		// The blur of a plane is linear over the picture; interpolation finds it exactly.
		const double across = slope(random), down = slope(random), offset = 30.0 * slope(random);
		const auto blur = [&](double x, double y) { return across * (x - 320.0) + down * (y - 180.0) + offset; };
		const FocusLabels labels = LabelsOf(640, 360, blur);
		for(const FocusLabel& label : labels.Labels())
		{
			// Its middle is rounded to pixels, and of a plate of an even number of them lies between two.
			const double rounding = std::fabs(across) + std::fabs(down);
			EXPECT_NEAR(blur(MiddleX(label), MiddleY(label)), (label.nearer ? 1.0 : -1.0) * std::ldexp(1.0, label.octave), rounding);
			EXPECT_EQ(label.Text(), std::to_string(1 << label.octave));
			count++;
		}
	}
	EXPECT_GT(count, 200);
}

TEST(FocusLabels, LieWithinThePictureAndApart)
{
	for(const auto& size : { std::pair<int, int>{ 1, 1 }, { 7, 300 }, { 33, 17 }, { 320, 180 }, { 1920, 1080 }, { 3840, 2160 } })
	{
		const FocusLabels labels = LabelsOf(size.first, size.second, [&](double x, double y) { return 60.0 * (x / size.first - 0.3) + 5.0 * std::sin(9.0 * y / size.second); });
		const std::vector<FocusLabel>& all = labels.Labels();
		for(size_t i = 0; i < all.size(); i++)
		{
			EXPECT_GE(all[i].left, 0);
			EXPECT_GE(all[i].top, 0);
			EXPECT_LE(all[i].left + all[i].columns, size.first);
			EXPECT_LE(all[i].top + all[i].rows, size.second);
			for(size_t k = 0; k < i; k++)
				EXPECT_TRUE(all[i].left >= all[k].left + all[k].columns || all[k].left >= all[i].left + all[i].columns ||
				            all[i].top >= all[k].top + all[k].rows || all[k].top >= all[i].top + all[i].rows);
		}
		if(size.first >= 320)
		{
			EXPECT_FALSE(all.empty()) << size.first << " x " << size.second;
		}
	}
}

TEST(FocusLabels, AreNotPutOnTheEdgesOfThings)
{
	// Two walls, of 3 and of 40 pixels: between them the blur jumps over four contours that nobody draws.
	EXPECT_TRUE(LabelsOf(640, 360, [](double x, double) { return x < 300.0 ? 3.0 : 40.0; }).Labels().empty());
	// Sharp everywhere, and nothing at all.
	EXPECT_TRUE(LabelsOf(640, 360, [](double x, double) { return 0.5 * x / 640.0; }).Labels().empty());
	EXPECT_TRUE(LabelsOf(640, 360, [](double, double) { return std::numeric_limits<double>::quiet_NaN(); }).Labels().empty());
	EXPECT_TRUE(LabelsOf(640, 360, [](double, double) { return std::numeric_limits<double>::infinity(); }).Labels().empty());
}

TEST(FocusLabels, PaintWhatTheyCoverAlone)
{
	const FocusLabels labels = LabelsOf(320, 180, [](double x, double) { return 0.2 * (x - 160.5); });
	ASSERT_FALSE(labels.Labels().empty());
	for(int y = 0; y < 180; y++)
		for(int x = 0; x < 320; x++)
		{
			bool nearer = false, covered = false;
			const FocusLabels::Paint paint = labels.At(x, y, nearer);
			for(const FocusLabel& label : labels.Labels())
				covered = covered || (x >= label.left && x < label.left + label.columns && y >= label.top && y < label.top + label.rows);
			EXPECT_EQ(paint != FocusLabels::Nothing, covered) << x << ", " << y;
			if(covered)
			{
				EXPECT_EQ(nearer, x > 160);
			}
		}
}
