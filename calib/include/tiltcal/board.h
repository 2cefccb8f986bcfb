// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The target: a checkerboard or a grid of circles.

#ifndef TILTCAL_BOARD_H
#define TILTCAL_BOARD_H

#include <tiltcal/api.h>

#include <string>

namespace tiltcal
{

enum class TargetKind
{
	CHECKERBOARD,
	CIRCLES,              ///< rows and columns at right angles
	ASYMMETRIC_CIRCLES    ///< every other row moved by half a column, as in OpenCV
};

/// "checkerboard", "circles", "asymmetric-circles". Throws UsageError, which calls it `input`.
TILTCAL_API TargetKind ParseTargetKind(const std::string& text, const std::string& input = "`target`");
TILTCAL_API std::string NameOf(TargetKind kind);

/// Counts squares or circles: 12 x 9 squares have 11 x 8 inner corners.
/// Features are inner corners, or centres of circles. Their (column, row) is their place in units of `square_mm`:
/// circle i of row j of an asymmetric grid is at column 2 i + j mod 2.
/// Board frame (left-handed, as POV-Ray's): origin at the first feature, x along
/// the columns, y up the rows, z into the board; (column, row) is (column s, -row s, 0).
struct Board
{
	int columns = 0, rows = 0;
	/// Side of a square; distance of circles in a row and of rows. Asymmetric: distance of
	/// rows, half the distance of circles in a row (OpenCV's squareSize).
	double square_mm = 0;
	double square_sigma_mm = 0;   ///< how well it is known
	TargetKind kind = TargetKind::CHECKERBOARD;
	double circle_diameter_mm = 0;

	bool IsCheckerboard() const { return kind == TargetKind::CHECKERBOARD; }
	/// Column of circle i of row j; any integers, also outside of the grid.
	int CircleColumn(int i, int j) const { return kind == TargetKind::CIRCLES ? i : 2 * i + (j & 1); }
	/// Between centres of the nearest circles, in units of square_mm.
	double CirclePitch() const { return kind == TargetKind::CIRCLES ? 1 : 1.4142135623730951; }
	double CircleRadius() const { return 0.5 * circle_diameter_mm / square_mm; }   ///< in units of square_mm

	int InnerColumns() const { return columns - 1; }
	int InnerRows() const { return rows - 1; }
	int CornerCount() const { return InnerColumns() * InnerRows(); }
	double X(double column) const { return column * square_mm; }
	double Y(double row) const { return -row * square_mm; }
};

/// "checkerboard, 12 x 9 squares of 25 mm".
TILTCAL_API std::string Describe(const Board& board);

/// Checkerboard "12x9". Throws UsageError.
TILTCAL_API Board ParseBoard(const std::string& text, double square_mm);

/// Any target. A circle_diameter of 0 becomes half the distance of neighbouring centres; checkerboards have none.
/// Throws UsageError, which calls the kind `kind_input`.
TILTCAL_API Board MakeBoard(TargetKind kind, const std::string& text, double square_mm, double circle_diameter_mm, const std::string& kind_input = "`target`");

}

#endif
