// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/refine_corners.h"

#include "measure/measure_edge.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// A corner as the intersection of the lines of its edges (the paper's features), least
/// squares with the edges' own uncertainties. False: not both directions are there.
bool Intersect(const std::vector<Edge>& edges, Corner& corner)
{
	Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
	Vec2 b = Vec2::Zero();
	bool columns = false, rows = false;
	for (const Edge& e : edges)
	{
		if (!e.Touches(corner.column, corner.row))
			continue;
		const Vec2 nominal(e.nx, e.ny), along(e.ny, -e.nx);
		const double side = along.dot(Vec2(corner.x - e.x, corner.y - e.y));
		const Vec2 normal = (nominal - e.slope * along).normalized();
		const double variance = e.offset_sigma * e.offset_sigma + side * side * e.slope_sigma * e.slope_sigma;
		// Edges fitted with their neighbours use the same pixels twice: once in each direction.
		const double shared = e.BlurRatio() > LONE_RATIO ? 2 : 1;
		const double weight = 1 / std::max(shared * variance, 1e-8);
		A += weight * normal * normal.transpose();
		b += weight * normal * normal.dot(Vec2(e.x, e.y));
		(e.along_columns ? columns : rows) = true;
	}
	if (!columns || !rows)
		return false;
	const Eigen::Matrix2d covariance = A.inverse();
	const Vec2 p = covariance * b;
	corner.x = p.x();
	corner.y = p.y();
	corner.sigma = std::sqrt(0.5 * covariance.trace());
	return true;
}

}

void RefineCorners(Photo& photo)
{
	double blur = 0;
	for (const Edge& e : photo.edges)
		blur += e.blur / double(photo.edges.size());
	for (Corner& corner : photo.corners)
		if (!Intersect(photo.edges, corner))
			corner.sigma = std::hypot(0.05, 0.03 * blur);
}

}
