// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/named_covariance.h"

#include <fmt/format.h>

namespace tiltcal
{

using Number = LensCovariance::Number;
using Axis = LensCovariance::Axis;
using At = LensCovariance::At;

LensCovariance WithBoardSize(const LensCovariance& c, const Unknowns& x, const std::vector<Vec3<double>>& planes, double relative)
{
	const int n = LensCovariance::Size(planes.size(), x.stops.Further());
	// What a board larger by 1 does, to first order.
	Eigen::VectorXd by_size = Eigen::VectorXd::Zero(n);
	by_size[At(Number::APERTURE_DIAMETER).index] = x.d;
	by_size[At(Number::CURVATURE).index] = -x.curvature[0];
	by_size[At(Number::HALF_CURVATURE_DIFFERENCE).index] = -x.curvature[1];
	for (size_t s = 0; s < planes.size(); ++s)
	{
		by_size[At(s, Axis::X).index] = -planes[s].x;
		by_size[At(s, Axis::Y).index] = -planes[s].y;
		by_size[At(s, Axis::Z).index] = -planes[s].z;
	}
	Eigen::MatrixXd sum = relative * relative * by_size * by_size.transpose();
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			sum(i, j) += c(At(i), At(j));
	return LensCovariance(sum);
}

NamedCovariance Named(const LensCovariance& c, const Task& task)
{
	std::vector<std::pair<std::string, At>> all{ { "image_distance_mm", Number::IMAGE_DISTANCE }, { "aperture_diameter_mm", Number::APERTURE_DIAMETER },
		{ "psf_floor_squared_px2", Number::FLOOR_SQUARED }, { "field_curvature_per_mm", Number::CURVATURE }, { "half_curvature_difference_per_mm", Number::HALF_CURVATURE_DIFFERENCE } };
	for (size_t s = 0; s < task.states.size(); ++s)
		for (const auto& [name, axis] : { std::pair("q_x", Axis::X), std::pair("q_y", Axis::Y), std::pair("q_z", Axis::Z) })
			all.emplace_back(task.states[s].name + "." + name + "_per_mm", At(s, axis));
	for (size_t k = 1; k < task.stops.size(); ++k)
		all.emplace_back(fmt::format("stop_f{:g}.log_ratio", task.stops[k].f_number), LensCovariance::OfStop(task.states.size(), k));
	NamedCovariance named;
	std::vector<At> kept;
	for (const auto& [name, at] : all)
		if (c.Variance(at) > 0)
		{
			named.names.push_back(name);
			kept.push_back(at);
		}
	for (const At& a : kept)
		for (const At& b : kept)
			named.matrix.push_back(c(a, b));
	return named;
}

}
