// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/edge_shape.h"

#include "edge/fit_response.h"

#include <Eigen/Dense>

#include <cmath>

namespace tiltcal
{

std::optional<EdgeShape> ShapeOfEdge(const Edge& edge)
{
	if (edge.profile.size() < 12 || edge.blur < LEAST_SHAPED)
		return std::nullopt;
	const auto n = Eigen::Index(edge.profile.size());
	Eigen::Matrix<double, Eigen::Dynamic, 4 + SHAPES> by(n, 4 + SHAPES);
	Eigen::VectorXd value(n);
	for (Eigen::Index i = 0; i < n; ++i)
	{
		const ProfileBin& bin = edge.profile[size_t(i)];
		const double root = std::sqrt(double(bin.count));
		by.row(i) = root * ByFitAndShape(bin.x, edge.nx, edge.ny, edge.blur);
		value[i] = root * bin.value;
	}
	const Eigen::Matrix<double, 4 + SHAPES, 4 + SHAPES> inverse = (by.transpose() * by).inverse();
	const Eigen::Matrix<double, 4 + SHAPES, 1> found = inverse * (by.transpose() * value);
	const double step = found[3] - found[2];
	EdgeShape shape;
	for (int k = 0; k < SHAPES; ++k)
	{
		shape.value[size_t(k)] = found[4 + k] / step;
		shape.sigma[size_t(k)] = edge.noise * std::sqrt(inverse(4 + k, 4 + k)) / step;
	}
	return inverse.allFinite() && step > 0 ? std::optional(shape) : std::nullopt;
}

}
