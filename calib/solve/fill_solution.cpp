// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/fill_solution.h"

#include "model/lens_model.h"
#include <tiltcal/error.h>
#include "model/tilt_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Correlations of w, d, U, C and the components of every tilt, q_x and q_y.
std::vector<Correlation> CorrelationsOf(const Task& task, LensModel model, const Eigen::MatrixXd& c)
{
	std::vector<std::pair<std::string, int>> numbers{ { "image_distance", 0 }, { "aperture_diameter", 1 }, { "focus_distance", 7 } };
	if (IsCurved(model))
		numbers.emplace_back("field_curvature", 3);
	for (size_t s = 1; s < task.states.size(); ++s)
	{
		numbers.emplace_back(task.states[s].name + ".q_x", 5 + 3 * int(s));
		numbers.emplace_back(task.states[s].name + ".q_y", 6 + 3 * int(s));
	}
	std::vector<Correlation> all;
	for (size_t i = 0; i < numbers.size(); ++i)
		for (size_t j = i + 1; j < numbers.size(); ++j)
		{
			const int a = numbers[i].second, b = numbers[j].second;
			const double variance = c(a, a) * c(b, b);
			// 1/U falls when U grows.
			const double sign = (a == 7) != (b == 7) ? -1 : 1;
			if (variance > 0)
				all.push_back({ numbers[i].first, numbers[j].first, sign * c(a, b) / std::sqrt(variance) });
		}
	return all;
}

}

void FillSolution(const Task& task, const Geometry& g, const BlurFit& fit, const Unknowns& x, const Eigen::MatrixXd& c, Solution& out)
{
	const double w = g.w_px * task.pitch_mm;
	out.lens = fit.model;
	out.correlations = CorrelationsOf(task, fit.model, c);
	out.w_mm = { w, std::sqrt(c(0, 0)) };
	out.aperture_diameter = { x.d, std::sqrt(c(1, 1)) };
	const double floor = std::sqrt(x.floor_squared), floor_squared_sigma = std::sqrt(c(2, 2));
	out.psf_floor_px = { floor, floor_squared_sigma / std::max(2 * floor, std::sqrt(floor_squared_sigma)) };
	const double C = x.curvature[0], half = x.curvature[1];
	out.field_curvature = { C, std::sqrt(c(3, 3)) };
	out.tangential_curvature = { C + half, std::sqrt(std::max(c(3, 3) + 2 * c(3, 4) + c(4, 4), 0.0)) };
	out.sagittal_curvature = { C - half, std::sqrt(std::max(c(3, 3) - 2 * c(3, 4) + c(4, 4), 0.0)) };
	for (size_t s = 0; s < x.state.size(); ++s)
	{
		Eigen::Matrix4d block;   // of (q, w)
		const int at = 5 + 3 * int(s);
		block << c.block<3, 3>(at, at), c.block<3, 1>(at, 0), c.block<1, 3>(0, at), c(0, 0);
		StateLens lens;
		FillStateLens(fit.Plane(x, s), w, block, lens);
		out.states.push_back(lens);
	}
	double total = 0;
	for (const Observation& o : fit.observations)
	{
		const double r = fit.Residual(o, x);
		out.states[o.state].rms_blur += r * r;
		++out.states[o.state].edges;
		total += r * r;
	}
	for (StateLens& lens : out.states)
		lens.rms_blur = std::sqrt(lens.rms_blur / std::max(lens.edges, 1));
	out.rms_blur = std::sqrt(total / double(fit.observations.size()));
	out.focus_distance = out.states[0].focus_distance;
	out.focal_length = out.states[0].focal_length;
}

void RefuseUndetermined(const Task& task, const Solution& s)
{
	if (!(s.aperture_diameter.sigma < 0.1 * s.aperture_diameter.value) || !(s.states[0].q_sigma.z < 0.05 * std::abs(s.states[0].q.z)))
		throw Refused(fmt::format("the untilted photographs do not determine aperture ({:.2f} +- {:.2f} mm) and focus: "
			"photograph inclined boards whose blur changes clearly along the board", s.aperture_diameter.value, s.aperture_diameter.sigma));
	for (size_t k = 1; k < s.states.size(); ++k)
		if (!(s.states[k].lens_tilt.sigma < 0.5))
			throw Refused(fmt::format("state {}: its photographs do not determine the tilt ({:.2f} +- {:.2f} degrees): "
				"photograph the board inclined, sharp in one part and blurred in another", task.states[k].name,
				s.states[k].lens_tilt.value, s.states[k].lens_tilt.sigma));
}

}
