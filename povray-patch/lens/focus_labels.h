// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The numbers on the contours of `show focus`: where they stand and which pixels they cover.
// Free of POV-Ray. Placed once for the whole picture, from a grid of rays that is the same
// whatever part of the picture is rendered, by however many threads.

#ifndef TILT_LENS_FOCUS_LABELS_H
#define TILT_LENS_FOCUS_LABELS_H

#include <string>
#include <vector>

namespace tilt_lens
{

/// Signed blur widths in pixels on a grid over the picture: node (i, j) is pixel
/// (i spacing, j spacing). NaN where there is none.
struct BlurGrid
{
	int width, height;              ///< of the picture
	int spacing, columns, rows;
	std::vector<double> blur;       ///< row by row

	/// The grid of a picture, its values not yet set.
	static BlurGrid Of(int width, int height);
	/// NaN beyond the grid.
	double At(int column, int row) const;
};

/// A number, on the contour of its blur width.
struct FocusLabel
{
	int left, top, columns, rows;   ///< the pixels of its plate
	int scale;                      ///< pixels of a dot of its digits
	int octave;                     ///< the blur is 2^octave pixels wide
	bool nearer;                    ///< than the focus
	std::string Text() const;
};

class FocusLabels
{
	public:
		enum Paint { Nothing, Plate, Ink };

		FocusLabels() {}
		/// Finds the places: on contours, all of a label within the picture, none upon another.
		explicit FocusLabels(const BlurGrid& grid);

		/// What the labels do to the pixel x, y; `nearer` is set unless it is nothing.
		Paint At(double x, double y, bool& nearer) const;
		const std::vector<FocusLabel>& Labels() const { return labels; }
	private:
		std::vector<FocusLabel> labels;
};

}

#endif
