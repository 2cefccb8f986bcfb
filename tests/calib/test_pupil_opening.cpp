// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Area and centre of gravity of what discs have in common, against counting and against what is plain.

#include "lens/optics.h"
#include "effects/pupil_opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tiltcal;

namespace
{

/// By a grid of 600 x 600 points over the first disc.
Opening Counted(const std::vector<Disc>& discs)
{
	Opening sum;
	const int points = 600;
	const double step = 2 * discs[0].radius / points;
	for (int i = 0; i < points; ++i)
		for (int j = 0; j < points; ++j)
		{
			const double x = discs[0].x - discs[0].radius + (i + 0.5) * step, y = discs[0].y - discs[0].radius + (j + 0.5) * step;
			bool inside = true;
			for (const Disc& d : discs)
				inside = inside && std::hypot(x - d.x, y - d.y) <= d.radius;
			if (!inside)
				continue;
			sum.area += step * step;
			sum.x += x * step * step;
			sum.y += y * step * step;
		}
	return sum.area > 0 ? Opening{ sum.area, sum.x / sum.area, sum.y / sum.area } : sum;
}

}

// A grid point is wrong along the edges only: some 600 of 280,000 points by half of one, at random, which is 1e-4 of the area. Slivers have more edge.
TEST(PupilOpening, AreaAndCentreAsCounted)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> u(-1, 1);
	int open = 0;
	for (int k = 0; k < 200; ++k)
	{
		std::vector<Disc> discs{ { 0.2 * u(random), 0.2 * u(random), 1 } };
		for (int more = 0; more < 1 + k % 4; ++more)
			discs.push_back({ 1.2 * u(random), 1.2 * u(random), 1.3 + 0.9 * u(random) });
		const Opening found = CommonOpening(discs), counted = Counted(discs);
		EXPECT_NEAR(found.area, counted.area, 0.003) << k;
		if (counted.area < 0.05)
			continue;
		EXPECT_NEAR(found.x, counted.x, 0.005) << k;
		EXPECT_NEAR(found.y, counted.y, 0.005) << k;
		++open;
	}
	EXPECT_GT(open, 120);
}

TEST(PupilOpening, DiscsThatContainEachOtherAreTheSmallest)
{
	const Disc small{ 0.1, 0.2, 0.5 }, large{ 0, 0, 1 }, huge{ 3, -2, 1e4 };
	for (const std::vector<Disc>& discs : { std::vector<Disc>{ small }, { small, large }, { large, small, small }, { huge, large, small, huge, small } })
	{
		const Opening o = CommonOpening(discs);
		EXPECT_NEAR(o.area, M_PI / 4, 1e-7);   // 1e-15 of the largest disc's radius squared, 1e8
		EXPECT_NEAR(o.x, 0.1, 1e-7);
		EXPECT_NEAR(o.y, 0.2, 1e-7);
	}
}

TEST(PupilOpening, NothingInCommonIsNothing)
{
	for (const std::vector<Disc>& discs : { std::vector<Disc>{ { 0, 0, 1 }, { 2.5, 0, 1 } }, { { 0, 0, 1 }, { 1.5, 0, 1 }, { -1.5, 0, 1 } }, { { 0, 0, 1 }, { 0, 0, 2 }, { 5, 5, 1 } } })
	{
		const Opening o = CommonOpening(discs);
		EXPECT_EQ(o.area, 0);
		EXPECT_EQ(o.x, 0);
		EXPECT_EQ(o.y, 0);
	}
}

// Without tilt and focused at infinity, a rim before the lens and one behind it, as far from it, cut opposite sides.
TEST(PupilOpening, RimsBeforeAndBehindCutOppositeSides)
{
	PixelView view;
	view.v = view.pixel = { 0.3, 0, 1 };
	const Opening before = OpeningOf(view, 8, 48, { { 9, 10 } }), behind = OpeningOf(view, 8, 48, { { 8, -10 } }), both = OpeningOf(view, 8, 48, { { 9, 10 }, { 8, -10 } });
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(view.n);
	const double right_before = (before.x * basis.a + before.y * basis.b).x, right_behind = (behind.x * basis.a + behind.y * basis.b).x;
	EXPECT_LT(right_before, -0.3);   // light that comes from the left side of the rim, for a pixel that looks right, passes on the left
	EXPECT_GT(right_behind, 0.1);
	EXPECT_LT(both.area, std::min(before.area, behind.area));
	EXPECT_LT(std::abs((both.x * basis.a + both.y * basis.b).x), std::abs(right_before));
}
