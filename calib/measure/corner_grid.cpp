// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/corner_grid.h"

#include <tiltcal/photo.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>

namespace tiltcal
{

CornerGrid::CornerGrid(const Photo& photo, const Board& b) : board(b), points(photo.corners.size())
{
	std::vector<cv::Point2d> pixels, squares;
	for (const Corner& c : photo.corners)
	{
		points[Index(c.column, c.row)] = Vec2(c.x, c.y);
		pixels.emplace_back(c.x, c.y);
		squares.emplace_back(c.column, c.row);
	}
	squares_from_pixels = cv::Matx33d(cv::findHomography(pixels, squares));
}

Vec2 CornerGrid::Square(const Vec2& pixel) const
{
	const cv::Vec3d p = squares_from_pixels * cv::Vec3d(pixel.x(), pixel.y(), 1);
	return { p[0] / p[2], p[1] / p[2] };
}

Vec2 CornerGrid::At(int i, int j) const
{
	const int ci = std::clamp(i, 0, board.InnerColumns() - 1), cj = std::clamp(j, 0, board.InnerRows() - 1);
	if (ci == i && cj == j)
		return points[Index(i, j)];
	return 2 * points[Index(ci, cj)] - At(2 * ci - i, 2 * cj - j);
}

}
