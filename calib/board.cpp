// SPDX-License-Identifier: AGPL-3.0-or-later

#include "board.h"

#include "error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace tiltcal
{

Board ParseBoard(const std::string& text, double square_mm)
{
	Board board;
	char rest = 0;
	if (std::sscanf(text.c_str(), "%3dx%3d%c", &board.columns, &board.rows, &rest) != 2)
		throw UsageError(fmt::format("--board {}: give columns x rows of squares, such as 12x9", text));
	if (board.columns < 4 || board.rows < 4)
		throw UsageError(fmt::format("--board {}: at least 4x4 squares are needed", text));
	if (!(square_mm > 0))
		throw UsageError(fmt::format("--square {}: give the side of a square in mm, above 0", square_mm));
	board.square_mm = square_mm;
	return board;
}

BlurRatios RatiosOf(const Photo& photo)
{
	std::vector<double> ratios;
	for (const Edge& e : photo.edges)
		ratios.push_back(e.BlurRatio());
	if (ratios.empty())
		return {};
	std::sort(ratios.begin(), ratios.end());
	return { ratios.front(), ratios[ratios.size() / 2], ratios.back() };
}

std::string RatioText(const Photo& photo)
{
	const BlurRatios r = RatiosOf(photo);
	return fmt::format("blur radius {:.2f} to {:.2f} of a square, median {:.2f}", r.least, r.most, r.median);
}

}
