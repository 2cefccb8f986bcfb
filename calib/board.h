// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The target, a checkerboard or a grid of circles, and what is measured on it.

#ifndef TILTCAL_BOARD_H
#define TILTCAL_BOARD_H

#include "exif.h"

#include <array>
#include <string>
#include <vector>

namespace tiltcal
{

enum class TargetKind
{
	CHECKERBOARD,
	CIRCLES,              ///< rows and columns at right angles
	ASYMMETRIC_CIRCLES    ///< every other row moved by half a column, as in OpenCV
};

/// "checkerboard", "circles", "asymmetric-circles". `option` is named in the UsageError.
TargetKind ParseTargetKind(const std::string& text, const std::string& option);
std::string NameOf(TargetKind kind);

/// Counts squares or circles, as the command line does: 12 x 9 squares have 11 x 8 inner corners.
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

/// Checkerboard "12x9". Throws UsageError.
Board ParseBoard(const std::string& text, double square_mm);

/// Any target. A circle_diameter of 0 becomes half the distance of neighbouring centres; checkerboards have none.
/// `kind_option` is named in the UsageError.
Board MakeBoard(TargetKind kind, const std::string& text, double square_mm, double circle_diameter_mm, const std::string& kind_option);

/// An inner corner, or the image of a circle's centre, in a picture, pixels.
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

/// One edge between neighbouring inner corners, measured in its middle portion, or a part of a circle's outline.
struct Edge
{
	int column = 0, row = 0;     ///< its first corner, or its circle
	int arc = -1;                ///< which part of its circle, from the columns' direction towards the rows'; -1: of a checkerboard
	bool along_columns = true;   ///< to (column + 1, row), else to (column, row + 1)
	double board_column = 0, board_row = 0; ///< where on the board it was measured, in squares or spacings
	double x = 0, y = 0;         ///< the same place in the picture, pixels
	double nx = 0, ny = 0;       ///< unit normal in the picture (y down), dark to bright
	double slope = 0;            ///< the edge's direction is (ny, -nx) + slope (nx, ny)
	double blur = 0;             ///< diameter of the blur disc, pixels
	double blur_sigma = 0;
	double offset_sigma = 0, slope_sigma = 0;
	double low = 0, high = 0;    ///< linear light on both sides
	double noise = 0;            ///< RMS residual of a pixel, linear light
	std::vector<ProfileBin> profile;   ///< of a straight edge that was measured alone, else empty
	double square_px = 0;        ///< what lies between edges here: the square's shorter side in the picture; of a circle the smaller radius

	/// Blur radius over the side of a square, or over the circle's radius.
	double BlurRatio() const { return 0.5 * blur / square_px; }
	/// Whether it begins or ends at the feature (c, r), or is of that circle.
	bool Touches(int c, int r) const
	{
		return (column == c && row == r) || (arc < 0 && column + along_columns == c && row + !along_columns == r);
	}
};

/// A part of a photograph that is evenly bright: no blurred edge reaches it.
struct BrightPatch
{
	double u = 0, v = 0;               ///< its centre, px
	double value = 0, sigma = 0;       ///< mean brightness, linear light
	double board_column = 0, board_row = 0;   ///< the same place on the board, in squares or spacings
};

/// The same part of an edge in the three colours.
struct ColourEdge
{
	Edge green;                        ///< without its profile
	std::array<double, 2> shift{}, shift_sigma{};     ///< red's and blue's place minus green's along green's normal, px
	std::array<double, 2> widening{}, widening_sigma{};   ///< red's and blue's blur minus green's, px
};

/// Everything measured in one photograph. Corners row by row: index row * InnerColumns + column;
/// circles: j * columns + i.
struct Photo
{
	std::string file;
	int width = 0, height = 0;
	PhotographFacts facts;       ///< EXIF, nominal
	std::vector<Corner> corners;
	std::vector<Edge> edges;
	bool bright_circles = false; ///< white on dark
	int edges_dropped = 0;       ///< blurred beyond measuring, or not fitted
	double saturated_share = 0;  ///< edges whose bright side is clipped
	std::vector<BrightPatch> white;   ///< of the board (bright_patches.h)
	int white_saturated = 0;     ///< patches left out because they are clipped
	bool coloured = false;       ///< the channels differ
	std::vector<ColourEdge> colours;   ///< of some edges (measure_colours.h)
};

/// Edge::BlurRatio of the edges of a photograph; all 0 when it has none.
struct BlurRatios
{
	double least = 0, median = 0, most = 0;
};
BlurRatios RatiosOf(const Photo& photo);

/// "blur radius 0.02 to 0.31 of a square, median 0.15".
std::string RatioText(const Photo& photo);

/// "88 corners, 157 edges" or "80 dark circles, 640 arcs".
std::string CountText(const Photo& photo);

}

#endif
