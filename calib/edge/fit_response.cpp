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

const int SAMPLES = 48;   // across an edge
const int NODES = 65;     // of a table

Eigen::VectorXd Samples(double reach)
{
	Eigen::VectorXd x(SAMPLES);
	for (int i = 0; i < SAMPLES; ++i)
		x[i] = reach * ((2 * i + 1.0) / SAMPLES - 1);
	return x;
}

/// A pixel's box, with half of a point's variance on each of the two: a box of the width a has a^2/12.
double Widened(double n, double own) { return std::sqrt(n * n + 6 * own); }

/// Of the light at the samples by place, soft diameter and both plateaus.
Eigen::MatrixXd Derivatives(const Eigen::VectorXd& x, double nx, double ny, double soft)
{
	Eigen::MatrixXd by(x.size(), 4);
	for (Eigen::Index i = 0; i < x.size(); ++i)
	{
		const EdgeResponse e = SoftResponse(0.5 * soft, [&](double radius) { return PixelEdgeResponse(x[i], radius, std::abs(nx), std::abs(ny)); });
		by.row(i) << -e.d_position, 0.5 * e.d_radius, 1 - e.value, e.value;
	}
	return by;
}

}

FitResponse::FitResponse(double nx, double ny, double diameter, double reach, double own)
{
	const Eigen::VectorXd x = Samples(reach);
	// A blur narrower than the samples lie apart would fall between them along the pixels' rows and columns: none would know of it.
	const double narrowest = SoftDiameter(4 * reach / SAMPLES), fitted = SoftDiameter(diameter);
	const double told = std::abs(fitted) < narrowest ? std::copysign(narrowest, fitted) : fitted;
	// What a change of the light at each sample does to the four.
	const Eigen::MatrixXd pseudo_inverse = Derivatives(x, nx, ny, told).colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(SAMPLES, SAMPLES));
	const double box_a = Widened(nx, own), box_b = Widened(ny, own), most = reach + box_a + box_b;
	first = -most;
	step = 2 * most / (NODES - 1);
	for (int k = 0; k < NODES; ++k)
	{
		Eigen::VectorXd edge(SAMPLES);
		for (int i = 0; i < SAMPLES; ++i)
			edge[i] = PixelEdgeResponse(x[i] - (first + k * step), 0, box_a, box_b).value;
		const Eigen::VectorXd change = pseudo_inverse * edge;
		place.push_back(change[0]);
		soft.push_back(change[1]);
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
