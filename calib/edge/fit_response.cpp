// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/fit_response.h"

#include "edge/disc_edge.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const int FEWEST_SAMPLES = 48, MOST_SAMPLES = 192;   // across an edge
const int NODES = 65;     // of a table

/// So close that along the pixels' rows and columns, too, a disc of this diameter does not fall between two of them: none would know of it.
Eigen::VectorXd Samples(double reach, double diameter)
{
	const int n = int(std::clamp(std::ceil(8 * reach / diameter), double(FEWEST_SAMPLES), double(MOST_SAMPLES)));
	Eigen::VectorXd x(n);
	for (int i = 0; i < n; ++i)
		x[i] = reach * ((2 * i + 1.0) / n - 1);
	return x;
}

/// A pixel's box, with half of a point's variance on each of the two: a box of the width a has a^2/12.
double Widened(double n, double own) { return std::sqrt(n * n + 6 * own); }

/// Of the light at the samples by place, soft diameter and both plateaus.
Eigen::MatrixXd Derivatives(const Eigen::VectorXd& x, double nx, double ny, double soft)
{
	Eigen::MatrixXd by(x.size(), 4);
	for (Eigen::Index i = 0; i < x.size(); ++i)
		by.row(i) = ByFit(x[i], nx, ny, soft);
	return by;
}

Eigen::MatrixXd PseudoInverse(const Eigen::MatrixXd& m) { return m.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(m.rows(), m.rows())); }

/// What a change of the light at each sample does to the shapes, with the fit free.
Eigen::MatrixXd ToShapes(const Eigen::VectorXd& x, double nx, double ny, double diameter)
{
	Eigen::MatrixXd by(x.size(), 4 + SHAPES);
	for (Eigen::Index i = 0; i < x.size(); ++i)
		by.row(i) = ByFitAndShape(x[i], nx, ny, diameter);
	return PseudoInverse(by).bottomRows(SHAPES);
}

}

Eigen::RowVector4d ByFit(double x, double nx, double ny, double soft)
{
	const EdgeResponse e = SoftResponse(0.5 * soft, [&](double radius) { return PixelEdgeResponse(x, radius, std::abs(nx), std::abs(ny)); });
	return { -e.d_position, 0.5 * e.d_radius, 1 - e.value, e.value };
}

Eigen::Matrix<double, 1, 4 + SHAPES> ByFitAndShape(double x, double nx, double ny, double diameter)
{
	Eigen::Matrix<double, 1, 4 + SHAPES> by;
	by << ByFit(x, nx, ny, SoftDiameter(diameter)), ShapeResponse(x, 0.5 * diameter, std::abs(nx), std::abs(ny)).transpose();
	return by;
}

FitResponse::FitResponse(double nx, double ny, double diameter, double reach, double own, bool shaped)
{
	// Discs that are narrower yet are taken to be as narrow as the samples see.
	const double narrowest = SoftDiameter(4 * reach / MOST_SAMPLES), fitted = SoftDiameter(diameter), told = std::copysign(std::max(std::abs(fitted), narrowest), fitted);
	const Eigen::VectorXd x = Samples(reach, std::abs(told));
	const Eigen::Index n = x.size();
	// What a change of the light at each sample does to the four.
	const Eigen::MatrixXd by = Derivatives(x, nx, ny, told), pseudo_inverse = PseudoInverse(by);
	const Eigen::MatrixXd to_shapes = shaped ? ToShapes(x, nx, ny, diameter) : Eigen::MatrixXd(0, n);
	const double box_a = Widened(nx, own), box_b = Widened(ny, own), most = reach + box_a + box_b;
	first = -most;
	step = 2 * most / (NODES - 1);
	for (int k = 0; k < NODES; ++k)
	{
		Eigen::VectorXd edge(n);
		for (Eigen::Index i = 0; i < n; ++i)
			edge[i] = PixelEdgeResponse(x[i] - (first + k * step), 0, box_a, box_b).value;
		const Eigen::VectorXd change = pseudo_inverse * edge;
		place.push_back(change[0]);
		soft.push_back(change[1]);
		for (Eigen::Index i = 0; i < to_shapes.rows(); ++i)
			shapes[size_t(i)].push_back(to_shapes.row(i).dot(edge));
	}
}

FitResponse::Value FitResponse::Interpolated(const std::vector<double>& table, double x) const
{
	const double at = (x - first) / step;
	if (!(at > 0 && at < NODES - 1))
		return { 0, 0 };
	const int i = std::min(int(at), NODES - 2);
	const double t = at - i;
	const auto node = [&](int k) { return k < 0 || k >= NODES ? 0.0 : table[size_t(k)]; };
	// Catmull and Rom's cubic.
	const double a = node(i - 1), b = node(i), c = node(i + 1), d = node(i + 2);
	const double k1 = 0.5 * (c - a), k2 = a - 2.5 * b + 2 * c - 0.5 * d, k3 = 0.5 * (d - a) + 1.5 * (b - c);
	return { b + t * (k1 + t * (k2 + t * k3)), (k1 + t * (2 * k2 + 3 * t * k3)) / step };
}

}
