// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/spread_order.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace
{

using namespace tiltcal;

std::set<std::tuple<int, int, bool>> Set(const std::vector<EdgePlace>& order, size_t n)
{
	std::set<std::tuple<int, int, bool>> set;
	for (size_t k = 0; k < n; ++k)
		set.insert({ order[k].column, order[k].row, order[k].along_columns });
	return set;
}

TEST(SpreadOrder, HasEveryEdgeOnce)
{
	for (const char* const size : { "12x9", "9x12", "4x5", "30x5" })
	{
		const Board board = ParseBoard(size, 25);
		const int columns = board.InnerColumns(), rows = board.InnerRows();
		const std::vector<EdgePlace> order = SpreadOrder(board, 0);
		EXPECT_EQ(order.size(), size_t((columns - 1) * rows + columns * (rows - 1))) << size;
		EXPECT_EQ(Set(order, order.size()).size(), order.size()) << size;
		for (const EdgePlace& e : order)
		{
			EXPECT_TRUE(e.column >= 0 && e.column + e.along_columns < columns);
			EXPECT_TRUE(e.row >= 0 && e.row + !e.along_columns < rows);
		}
	}
}

TEST(SpreadOrder, EveryBeginningIsEvenOverQuartersAndDirections)
{
	const Board board = ParseBoard("12x9", 25);
	for (const double phase : { 0.0, 0.2, 0.45, 0.7 })
	{
		const std::vector<EdgePlace> order = SpreadOrder(board, phase);
		for (size_t n = 12; n <= 120; ++n)
		{
			int along = 0, quarter[2][4] = {};
			for (size_t k = 0; k < n; ++k)
			{
				along += order[k].along_columns;
				++quarter[order[k].along_columns][2 * (order[k].row >= 4) + (order[k].column >= 5)];
			}
			EXPECT_NEAR(along, n / 2.0, 0.5) << n;
			// Steps of the golden ratio leave at most two too many or too few in a quarter of
			// the curve; the board's quarters are not exactly the curve's.
			for (const auto& direction : quarter)
				for (const int count : direction)
				{
					EXPECT_GE(count, 1) << n << " phase " << phase;
					EXPECT_NEAR(count, n / 8.0, 2 + 0.08 * n) << n << " phase " << phase;
				}
		}
	}
}

TEST(SpreadOrder, PhasesGiveOtherSubsets)
{
	const Board board = ParseBoard("12x9", 25);
	EXPECT_EQ(Set(SpreadOrder(board, 0), 20), Set(SpreadOrder(board, 0), 20));
	std::set<std::tuple<int, int, bool>> both = Set(SpreadOrder(board, 0), 10);
	both.merge(Set(SpreadOrder(board, 0.07), 10));
	EXPECT_GT(both.size(), 15u);
}

}
