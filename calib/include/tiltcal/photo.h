// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is measured in one photograph of the target.

#ifndef TILTCAL_PHOTO_H
#define TILTCAL_PHOTO_H

#include <tiltcal/api.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// What the camera wrote beside the pixels (EXIF), nominal: the focal length is the engraved one, the f-number a marked stop.
struct PhotographFacts
{
	std::optional<double> focal_length_mm;   ///< FocalLength, as engraved
	std::optional<double> f_number;          ///< FNumber, else from ApertureValue
	std::optional<double> pitch_mm;          ///< from FocalPlaneXResolution; only when it holds for these pixels
	int orientation = 1;                     ///< 1 to 8; 1: as the sensor had it
	std::string make, model, lens;
	bool subsampled_colour = false;          ///< a JPEG, or a TIFF with one inside, that stores colour at less than full size; not from EXIF
	bool floating_point = false;             ///< light in any unit, without a full scale; not from EXIF
	std::string left_out;                    ///< channels of the file that are not in the picture: alpha, and OpenEXR's further ones

	TILTCAL_API bool Empty() const;
};

/// An inner corner, or the image of a circle's centre, in a picture, pixels.
struct Corner
{
	int column = 0, row = 0;
	double x = 0, y = 0;
	double sigma = 0;   ///< standard deviation of x and of y
};

/// Brightness of an edge in a narrow strip along it.
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
	/// Diameter of the blur disc, pixels. Negative where the edge is steeper than its pixels make it, by noise or by sharpening: minus the root of the excess.
	double blur = 0;
	double blur_sigma = 0;       ///< of the blur where it is large beside a pixel, of half its square where it is not (edge/soft_radius.h)
	double offset_sigma = 0, slope_sigma = 0;
	double low = 0, high = 0;    ///< linear light on both sides
	double noise = 0;            ///< RMS residual of a pixel, linear light
	std::vector<ProfileBin> profile;   ///< of a straight edge that was measured alone, else empty
	double reach = 0, span = 0;  ///< of the pixels that were used: how far they lie across and along, from its middle, px
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
	std::array<double, 2> widening{}, widening_sigma{};   ///< red's and blue's soft blur (edge/soft_radius.h) minus green's, px
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
	std::vector<BrightPatch> white;   ///< of the board
	int white_saturated = 0;     ///< patches left out because they are clipped
	bool coloured = false;       ///< the channels differ
	std::vector<ColourEdge> colours;   ///< of some edges
	std::optional<double> f_number;    ///< as told with the photograph
	size_t stop = 0;             ///< which of Task::stops
};

/// Up to here, for a square, what blur tells of the lens is wrong by less than its sigma; beyond, the discs of an edge reach into the next one's (exact pictures of a thin lens,
/// test_calibrate_blurred.cpp: at 0.33 the tilt is 0.3 % off).
const double MOST_BLUR_RATIO = 0.25;

/// Edge::BlurRatio of the edges of a photograph; all 0 when it has none.
struct BlurRatios
{
	double least = 0, median = 0, most = 0;
};
TILTCAL_API BlurRatios RatiosOf(const Photo& photo);

/// "blur radius 0.02 to 0.31 of a square, median 0.15".
TILTCAL_API std::string RatioText(const Photo& photo);

/// "88 corners, 157 edges" or "80 dark circles, 640 arcs".
TILTCAL_API std::string CountText(const Photo& photo);

}

#endif
