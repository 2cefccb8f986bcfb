// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The checkerboard and what is measured on it.

#ifndef TILTCAL_BOARD_H
#define TILTCAL_BOARD_H

#include "exif.h"

#include <string>
#include <vector>

namespace tiltcal
{

/// Counts squares, as the command line does: 12 x 9 squares have 11 x 8 inner corners.
/// Board frame (left-handed, as POV-Ray's): origin at the first inner corner, x along
/// the columns, y up the rows, z into the board; inner corner (i, j) is (i s, -j s, 0).
struct Board
{
	int columns = 0, rows = 0;
	double square_mm = 0;

	int InnerColumns() const { return columns - 1; }
	int InnerRows() const { return rows - 1; }
	int CornerCount() const { return InnerColumns() * InnerRows(); }
	double X(double column) const { return column * square_mm; }
	double Y(double row) const { return -row * square_mm; }
};

/// "12x9". Throws UsageError.
Board ParseBoard(const std::string& text, double square_mm);

/// An inner corner in a picture, pixels.
struct Corner
{
	int column = 0, row = 0;
	double x = 0, y = 0;
	double sigma = 0;   ///< standard deviation of x and of y
};

/// Brightness of an edge in a narrow strip along it (binned_profile.h).
struct ProfileBin
{
	float x = 0;       ///< distance from the edge, px, dark side negative
	float value = 0;   ///< mean, linear light, shading taken out
	float count = 0;   ///< pixels
};

/// One edge between neighbouring inner corners, measured in its middle portion.
struct Edge
{
	int column = 0, row = 0;     ///< its first corner
	bool along_columns = true;   ///< to (column + 1, row), else to (column, row + 1)
	double board_column = 0, board_row = 0; ///< where on the board it was measured, in squares
	double x = 0, y = 0;         ///< the same place in the picture, pixels
	double nx = 0, ny = 0;       ///< unit normal in the picture (y down), dark to bright
	double slope = 0;            ///< the edge's direction is (ny, -nx) + slope (nx, ny)
	double blur = 0;             ///< diameter of the blur disc, pixels
	double blur_sigma = 0;
	double offset_sigma = 0, slope_sigma = 0;
	double low = 0, high = 0;    ///< linear light on both sides
	double noise = 0;            ///< RMS residual of a pixel, linear light
	std::vector<ProfileBin> profile;   ///< of an edge that was measured alone, else empty
	double square_px = 0;        ///< what lies between edges here: the square's shorter side in the picture

	/// Blur radius over the side of a square.
	double BlurRatio() const { return 0.5 * blur / square_px; }
};

/// Everything measured in one photograph. Corners row by row: index row * InnerColumns + column.
struct Photo
{
	std::string file;
	int width = 0, height = 0;
	PhotographFacts facts;       ///< EXIF, nominal
	std::vector<Corner> corners;
	std::vector<Edge> edges;
	int edges_dropped = 0;       ///< blurred beyond measuring, or not fitted
	double saturated_share = 0;  ///< edges whose bright side is clipped
};

/// Blur radius over the square's side in the edges of a photograph; all 0 when it has none.
struct BlurRatios
{
	double least = 0, median = 0, most = 0;
};
BlurRatios RatiosOf(const Photo& photo);

/// "blur radius 0.02 to 0.31 of a square, median 0.15".
std::string RatioText(const Photo& photo);

}

#endif
