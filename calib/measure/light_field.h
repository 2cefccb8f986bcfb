// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_LIGHT_FIELD_H
#define TILTCAL_LIGHT_FIELD_H

#include <tiltcal/photo.h>
#include "edge/edge_fit.h"
#include "measure/corner_grid.h"
#include "measure/grid_map.h"

#include <opencv2/core.hpp>

#include <vector>

namespace tiltcal
{

/// How the light changes over the board in a picture: every cell of the pattern has the same mean, however it is blurred, so that a difference between
/// cells is the lamp's or the lens's.
class LightField
{
public:
	/// Cells around the inner corners, of a quarter of each square there.
	LightField(const cv::Mat& grey, const CornerGrid& grid);
	/// Cells around the circles.
	LightField(const cv::Mat& grey, const Board& board, const GridMap& map, const std::vector<Corner>& centres);

	/// Around `place` (column, row): relative change per pixel to the right and downwards. 0 where fewer than 4 cells tell it.
	Vec2 Change(const Vec2& place) const;

private:
	struct Cell
	{
		Vec2 place, at;      // board, picture
		double log_light;
	};

	double reach;            // of cells that tell the change at a place, units of the board
	std::vector<Cell> cells;
};

/// Of an edge with this unit normal in the picture, dark to bright, y down.
inline EdgeShading ShadingOfEdge(const Vec2& change, const Vec2& normal) { return { change.dot(normal), change.dot(Vec2(normal.y(), -normal.x())) }; }

}

#endif
