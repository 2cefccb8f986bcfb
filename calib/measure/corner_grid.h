// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CORNER_GRID_H
#define TILTCAL_CORNER_GRID_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <vector>

namespace tiltcal
{

using Vec2 = Eigen::Vector2d;

/// Corner positions in a picture, px, and where the grid would go on outside of them.
class CornerGrid
{
public:
	CornerGrid(const Photo& photo, const Board& board);

	/// (column, row) of a pixel, in squares from the first inner corner.
	Vec2 Square(const Vec2& pixel) const;

	/// Corner (i, j); outside of the grid as far outside as its mirror image in the outermost corner is inside.
	Vec2 At(int i, int j) const;

	int Columns() const { return board.InnerColumns(); }
	int Rows() const { return board.InnerRows(); }

private:
	size_t Index(int i, int j) const { return static_cast<size_t>(j * board.InnerColumns() + i); }

	Board board;
	std::vector<Vec2> points;
	cv::Matx33d squares_from_pixels;
};

}

#endif
