// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/board.h>

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tiltcal
{

TargetKind ParseTargetKind(const std::string& text, const std::string& option)
{
	for (const TargetKind kind : { TargetKind::CHECKERBOARD, TargetKind::CIRCLES, TargetKind::ASYMMETRIC_CIRCLES })
		if (text == NameOf(kind))
			return kind;
	throw UsageError(fmt::format("{} {}: there is checkerboard, circles and asymmetric-circles", option, text));
}

std::string NameOf(TargetKind kind)
{
	return kind == TargetKind::CHECKERBOARD ? "checkerboard" : kind == TargetKind::CIRCLES ? "circles" : "asymmetric-circles";
}

Board ParseBoard(const std::string& text, double square_mm)
{
	return MakeBoard(TargetKind::CHECKERBOARD, text, square_mm, 0, "");
}

Board MakeBoard(TargetKind kind, const std::string& text, double square_mm, double circle_diameter_mm, const std::string& kind_option)
{
	Board board;
	board.kind = kind;
	const char* const what = board.IsCheckerboard() ? "squares" : "circles";
	char rest = 0;
	if (std::sscanf(text.c_str(), "%3dx%3d%c", &board.columns, &board.rows, &rest) != 2)
		throw UsageError(fmt::format("`board` {}: give columns x rows of {}, such as {}", text, what, board.IsCheckerboard() ? "12x9" : "4x11"));
	if (board.columns < 4 || board.rows < 4)
		throw UsageError(fmt::format("`board` {}: at least 4x4 {} are needed", text, what));
	if (!(square_mm > 0) || !std::isfinite(square_mm))
		throw UsageError(fmt::format("`square` {}: give the {} in mm, above 0", square_mm, board.IsCheckerboard() ? "side of a square" : "spacing of the circles"));
	board.square_mm = square_mm;
	if (board.IsCheckerboard())
	{
		if (circle_diameter_mm != 0)
			throw UsageError(fmt::format("`circle_diameter`: a checkerboard has no circles; leave it out or give {} circles", kind_option));
		return board;
	}
	const double neighbour = board.CirclePitch() * square_mm;
	board.circle_diameter_mm = circle_diameter_mm == 0 ? 0.5 * neighbour : circle_diameter_mm;
	if (!(board.circle_diameter_mm > 0 && board.circle_diameter_mm < neighbour))
		throw UsageError(fmt::format("`circle_diameter` {}: give mm above 0 and below {:.4g}, the distance of neighbouring centres",
			circle_diameter_mm, neighbour));
	return board;
}

std::string Describe(const Board& b)
{
	if (b.IsCheckerboard())
		return fmt::format("checkerboard, {} x {} squares of {:g} mm", b.columns, b.rows, b.square_mm);
	return fmt::format("{}, {} x {}, spacing {:g} mm, diameter {:.6g} mm", NameOf(b.kind), b.columns, b.rows, b.square_mm, b.circle_diameter_mm);
}

}
