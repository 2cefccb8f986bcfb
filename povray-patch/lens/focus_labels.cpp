// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <limits>

#include "lens/focus_labels.h"

namespace tilt_lens
{

namespace
{

// Digits of 3 x 5 dots, rows from the top, the left dot in the highest bit.
const int DigitColumns = 3, DigitRows = 5;
const unsigned char Digits[10][DigitRows] = {
	{ 7, 5, 5, 5, 7 }, { 2, 6, 2, 2, 7 }, { 7, 1, 7, 4, 7 }, { 7, 1, 7, 1, 7 }, { 5, 5, 7, 1, 1 },
	{ 7, 4, 7, 1, 7 }, { 7, 4, 7, 5, 7 }, { 7, 1, 1, 2, 2 }, { 7, 5, 7, 5, 7 }, { 7, 5, 7, 1, 7 } };

/// A crossing of a contour with the grid.
struct Candidate
{
	double x, y;
	int octave;
	bool nearer;
};

/// Whether b - a is a step of one surface: about as large as a step beside it. At the edge of a thing it is not, and the
/// blur jumps over contours that are not there. Of a plane all steps are equal: 1/z is linear over the picture.
bool IsOfOneSurface(double before, double a, double b, double after)
{
	const double step = b - a;
	return std::fabs(a - before - step) <= 0.3 * std::fabs(step) || std::fabs(after - b - step) <= 0.3 * std::fabs(step);
}

/// The contours between a node and the next one in its row or column.
void AddCrossings(const BlurGrid& grid, int column, int row, int right, int down, std::vector<Candidate>& found)
{
	const double a = grid.At(column, row), b = grid.At(column + right, row + down);
	if(!std::isfinite(a) || !std::isfinite(b))
		return;
	if(!IsOfOneSurface(grid.At(column - right, row - down), a, b, grid.At(column + 2 * right, row + 2 * down)))
		return;
	for(int octave = 1; octave <= 30; octave++)
		for(double width : { -std::ldexp(1.0, octave), std::ldexp(1.0, octave) })
		{
			if((a < width) == (b < width))
				continue;
			const double part = (width - a) / (b - a);
			found.push_back({ (column + part * right) * grid.spacing, (row + part * down) * grid.spacing, octave, width > 0.0 });
		}
}

/// Pixels of a dot; digits are some 3 % of the picture's height.
int ScaleFor(int height)
{
	return std::max(1, (height + 90) / 180);
}

bool Overlaps(const FocusLabel& a, const FocusLabel& b, int gap)
{
	return a.left < b.left + b.columns + gap && b.left < a.left + a.columns + gap &&
	       a.top < b.top + b.rows + gap && b.top < a.top + a.rows + gap;
}

}

BlurGrid BlurGrid::Of(int width, int height)
{
	// One ray for 64 pixels of a small picture, for 256 and more of a large one.
	const int spacing = std::max(8, 8 * ((std::max(width, height) + 320) / 640));
	BlurGrid grid = { width, height, spacing, (width - 1) / spacing + 1, (height - 1) / spacing + 1, {} };
	grid.blur.assign(size_t(grid.columns) * grid.rows, std::numeric_limits<double>::quiet_NaN());
	return grid;
}

double BlurGrid::At(int column, int row) const
{
	const bool inside = column >= 0 && row >= 0 && column < columns && row < rows;
	return inside ? blur[size_t(row) * columns + column] : std::numeric_limits<double>::quiet_NaN();
}

std::string FocusLabel::Text() const
{
	return std::to_string(1L << octave);
}

FocusLabels::FocusLabels(const BlurGrid& grid)
{
	std::vector<Candidate> found;
	for(int row = 0; row < grid.rows; row++)
		for(int column = 0; column < grid.columns; column++)
		{
			AddCrossings(grid, column, row, 1, 0, found);
			AddCrossings(grid, column, row, 0, 1, found);
		}
	// From the middle of the picture outwards: that is where it is looked at.
	const auto off_centre = [&](const Candidate& c) { return std::hypot(c.x - 0.5 * grid.width, c.y - 0.5 * grid.height); };
	std::stable_sort(found.begin(), found.end(), [&](const Candidate& a, const Candidate& b) { return off_centre(a) < off_centre(b); });

	const int scale = ScaleFor(grid.height);
	// Again on the same contour after a third of the picture.
	const double again = std::max(grid.width, grid.height) / 3.0;
	for(const Candidate& c : found)
	{
		FocusLabel label = { 0, 0, 0, 0, scale, c.octave, c.nearer };
		label.columns = scale * (int(label.Text().size()) * (DigitColumns + 1) + 1);
		label.rows = scale * (DigitRows + 2);
		label.left = int(std::floor(c.x + 0.5)) - label.columns / 2;
		label.top = int(std::floor(c.y + 0.5)) - label.rows / 2;
		if(label.left < 0 || label.top < 0 || label.left + label.columns > grid.width || label.top + label.rows > grid.height)
			continue;
		const bool free = std::none_of(labels.begin(), labels.end(), [&](const FocusLabel& other)
		{
			const bool same = other.octave == label.octave && other.nearer == label.nearer;
			return Overlaps(label, other, 4 * scale) || (same && std::hypot(other.left - label.left, other.top - label.top) < again);
		});
		if(free)
			labels.push_back(label);
	}
}

FocusLabels::Paint FocusLabels::At(double x, double y, bool& nearer) const
{
	for(const FocusLabel& label : labels)
	{
		// A pixel reaches half a pixel to all sides of x, y.
		const double across = x + 0.5 - label.left, down = y + 0.5 - label.top;
		if(!(across >= 0.0 && down >= 0.0 && across < label.columns && down < label.rows))
			continue;
		nearer = label.nearer;
		const int dot = int(across) / label.scale - 1, line = int(down) / label.scale - 1;
		if(dot < 0 || line < 0 || line >= DigitRows || dot % (DigitColumns + 1) == DigitColumns)
			return Plate;
		const int digit = label.Text()[size_t(dot / (DigitColumns + 1))] - '0';
		return (Digits[digit][line] >> (DigitColumns - 1 - dot % (DigitColumns + 1))) & 1 ? Ink : Plate;
	}
	return Nothing;
}

}
