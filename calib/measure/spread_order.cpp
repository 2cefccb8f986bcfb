// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/spread_order.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Index of (x, y) on the Hilbert curve through size x size cells, size a power of two:
/// places that are near each other on the curve are near each other on the board.
long HilbertIndex(int size, int x, int y)
{
	long index = 0;
	for (int s = size / 2; s > 0; s /= 2)
	{
		const bool right = x & s, down = y & s;
		index += long(s) * s * ((3 * right) ^ down);
		if (!down)
		{
			if (right)
			{
				x = size - 1 - x;
				y = size - 1 - y;
			}
			std::swap(x, y);
		}
	}
	return index;
}

/// Places of a grid along the Hilbert curve through at least `span` x `span` cells.
std::vector<EdgePlace> AlongCurve(int span, int columns, int rows, bool along_columns)
{
	int size = 1;
	while (size < span)
		size *= 2;
	std::vector<EdgePlace> places;
	for (int j = 0; j < rows; ++j)
		for (int i = 0; i < columns; ++i)
			places.push_back({ i, j, along_columns });
	std::sort(places.begin(), places.end(), [size](const EdgePlace& a, const EdgePlace& b)
		{ return HilbertIndex(size, a.column, a.row) < HilbertIndex(size, b.column, b.row); });
	return places;
}

/// `places` in the order in which steps of the golden ratio visit them: any number of
/// such steps leaves gaps of similar length.
std::vector<EdgePlace> GoldenOrder(const std::vector<EdgePlace>& places, double phase)
{
	const double golden = 0.61803398874989485;
	std::vector<EdgePlace> order;
	std::vector<char> taken(places.size(), false);
	for (size_t k = 0; k < places.size(); ++k)
	{
		const double at = phase + double(k) * golden;
		size_t index = std::min(size_t((at - std::floor(at)) * double(places.size())), places.size() - 1);
		while (taken[index])
			index = (index + 1) % places.size();
		taken[index] = true;
		order.push_back(places[index]);
	}
	return order;
}

}

std::vector<EdgePlace> SpreadOrder(const Board& board, double phase)
{
	const int i = board.InnerColumns(), j = board.InnerRows(), span = std::max(i, j);
	const std::vector<EdgePlace> across = GoldenOrder(AlongCurve(span, i - 1, j, true), phase), down = GoldenOrder(AlongCurve(span, i, j - 1, false), phase);
	std::vector<EdgePlace> order;
	for (size_t k = 0; k < std::max(across.size(), down.size()); ++k)
	{
		if (k < across.size())
			order.push_back(across[k]);
		if (k < down.size())
			order.push_back(down[k]);
	}
	return order;
}

std::vector<ArcPlace> SpreadArcs(const Board& board, int arcs, double phase)
{
	const std::vector<EdgePlace> circles = GoldenOrder(AlongCurve(std::max(board.columns, board.rows), board.columns, board.rows, true), phase);
	std::vector<ArcPlace> order;
	for (int pass = 0; pass < arcs; ++pass)
		for (size_t k = 0; k < circles.size(); ++k)
			// 3 has no factor in common with 4 and 8.
			order.push_back({ circles[k].column, circles[k].row, int((3 * (k + size_t(pass))) % size_t(arcs)) });
	return order;
}

}
