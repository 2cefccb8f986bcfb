// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve_blur.h"

#include "blur_fit.h"
#include "error.h"
#include "search_focus.h"
#include "tilt_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// mm for the image distance, 4x4 covariance of (q, w) per state.
void FillSolution(const Task& task, const Geometry& g, const BlurFit& fit, const Unknowns& x, const Eigen::MatrixXd& c, Solution& out)
{
	const double w = g.w_px * task.pitch_mm, w_sigma = g.w_px_sigma * task.pitch_mm;
	out.w_mm = { w, w_sigma };
	out.aperture_diameter = { x.d, std::sqrt(c(0, 0)) };
	const double floor = std::sqrt(x.floor_squared), floor_squared_sigma = std::sqrt(c(1, 1));
	out.psf_floor_px = { floor, floor_squared_sigma / std::max(2 * floor, std::sqrt(floor_squared_sigma)) };
	for (size_t s = 0; s < x.state.size(); ++s)
	{
		Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
		const int at = 2 + 3 * int(s);
		block.topLeftCorner<3, 3>() = c.block<3, 3>(at, at);
		block(3, 3) = w_sigma * w_sigma;
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

void RefuseTooFewEdges(const Task& task, const std::vector<Observation>& observations)
{
	std::vector<int> count(task.states.size(), 0);
	for (const Observation& o : observations)
		++count[o.state];
	for (size_t s = 0; s < count.size(); ++s)
		if (count[s] < 20)
			throw Refused(fmt::format("state {}: only {} edges could be measured, 20 are needed: "
				"use a smaller blur, a larger picture of the board, more photographs, or more --edges-per-photo", task.states[s].name, count[s]));
}

Solution Solve(LensModel model, const Task& task, const Geometry& geometry)
{
	const std::vector<Observation> observations = Observe(task, geometry);
	RefuseTooFewEdges(task, observations);

	// First with a coarse common error, then with the one that the residuals show.
	BlurFit fit{ model, observations, geometry.w_px, geometry.w_px * task.pitch_mm, 0.5 };
	Unknowns x;
	x.state.assign(task.states.size(), StateNumbers{ 0, 0, 0 });
	SearchUntilted(fit, task, x);
	std::vector<char> by_power(task.states.size(), false);
	for (size_t s = 1; s < task.states.size(); ++s)
		by_power[s] = SearchTilted(fit, task, geometry, s, x);
	for (int round = 0; round < 3; ++round)
	{
		if (fit.Minimise(x, Free::EVERYTHING, 0) >= 1e300)
			throw Refused("the blur fit did not converge");
		fit.model_sigma = std::max(fit.Scale(x), 0.01);
	}
	Solution solution;
	FillSolution(task, geometry, fit, x, fit.CovarianceOfPlanes(x), solution);
	for (size_t s = 0; s < by_power.size(); ++s)
		solution.states[s].chosen_by_power = by_power[s];
	RefuseUndetermined(task, solution);
	return solution;
}

}

Solution SolvePlane(const Task& task, const Geometry& geometry)
{
	Solution solution = Solve(LensModel::PLANE, task, geometry);
	solution.model = "plane";
	return solution;
}

Solution SolveRigid(const Task& task, const Geometry& geometry)
{
	Solution solution = Solve(LensModel::RIGID, task, geometry);
	solution.model = "rigid";
	return solution;
}

}
