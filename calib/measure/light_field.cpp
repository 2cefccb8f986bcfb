// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/light_field.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const int ACROSS = 24;       // points of a cell: their mean has a 24th of the noise
const double REACH = 1.6;    // cells

/// Mean over (-0.5, 0.5)^2 of the light at `pixel(x, y)`.
template<typename Function>
double MeanLight(const cv::Mat& grey, const Function& pixel)
{
	double sum = 0;
	for (int j = 0; j < ACROSS; ++j)
		for (int i = 0; i < ACROSS; ++i)
		{
			const Vec2 p = pixel((i + 0.5) / ACROSS - 0.5, (j + 0.5) / ACROSS - 0.5);
			sum += grey.at<float>(std::clamp(int(std::lround(p.y())), 0, grey.rows - 1), std::clamp(int(std::lround(p.x())), 0, grey.cols - 1));
		}
	return sum / (ACROSS * ACROSS);
}

}

LightField::LightField(const cv::Mat& grey, const CornerGrid& grid) : reach(REACH)
{
	for (int j = 0; j < grid.Rows(); ++j)
		for (int i = 0; i < grid.Columns(); ++i)
		{
			const Vec2 at = grid.At(i, j);
			const Vec2 columns[] = { at - grid.At(i - 1, j), grid.At(i + 1, j) - at }, rows[] = { at - grid.At(i, j - 1), grid.At(i, j + 1) - at };
			const double light = MeanLight(grey, [&](double x, double y) -> Vec2 { return at + x * columns[x > 0] + y * rows[y > 0]; });
			if (light > 0)
				cells.push_back({ Vec2(i, j), at, std::log(light) });
		}
}

LightField::LightField(const cv::Mat& grey, const Board& board, const GridMap& map, const std::vector<Corner>& centres) : reach(REACH * board.CirclePitch())
{
	// A cell's sides: in an asymmetric grid the way to two neighbours, which lie diagonally.
	const Vec2 a = board.kind == TargetKind::CIRCLES ? Vec2(1, 0) : Vec2(1, 1), b(-a.y(), a.x());
	for (const Corner& c : centres)
	{
		const Vec2 place(c.column, c.row);
		const double light = MeanLight(grey, [&](double x, double y) { return map.Pixel(place + x * a + y * b); });
		if (light > 0)
			cells.push_back({ place, Vec2(c.x, c.y), std::log(light) });
	}
}

Vec2 LightField::Change(const Vec2& place) const
{
	// A plane through the logarithms.
	Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
	Eigen::Vector3d b = Eigen::Vector3d::Zero();
	Vec2 first = Vec2::Zero();
	int count = 0;
	for (const Cell& cell : cells)
		if ((cell.place - place).norm() <= reach)
		{
			if (count++ == 0)
				first = cell.at;
			const Eigen::Vector3d row(1, cell.at.x() - first.x(), cell.at.y() - first.y());
			A += row * row.transpose();
			b += cell.log_light * row;
		}
	const Vec2 change = A.ldlt().solve(b).tail<2>();
	return count < 4 || !change.allFinite() ? Vec2(Vec2::Zero()) : change;
}

}
