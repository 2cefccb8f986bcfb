// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve_blur.h"

#include "blur_fit.h"
#include "error.h"
#include "held_out.h"
#include "search_focus.h"
#include "tilt_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// A model with more unknowns must foretell photographs better by 1 %: by chance alone a bowl does by some thousandths.
const double WORTH_IT = 0.99;

/// mm for the image distance, 4x4 covariance of (q, w) per state.
void FillSolution(const Task& task, const Geometry& g, const BlurFit& fit, const Unknowns& x, const Eigen::MatrixXd& c, Solution& out)
{
	const double w = g.w_px * task.pitch_mm, w_sigma = g.w_px_sigma * task.pitch_mm;
	out.w_mm = { w, w_sigma };
	out.aperture_diameter = { x.d, std::sqrt(c(0, 0)) };
	const double floor = std::sqrt(x.floor_squared), floor_squared_sigma = std::sqrt(c(1, 1));
	out.psf_floor_px = { floor, floor_squared_sigma / std::max(2 * floor, std::sqrt(floor_squared_sigma)) };
	const double C = x.curvature[0], half = x.curvature[1];
	out.field_curvature = { C, std::sqrt(c(2, 2)) };
	out.tangential_curvature = { C + half, std::sqrt(std::max(c(2, 2) + 2 * c(2, 3) + c(3, 3), 0.0)) };
	out.sagittal_curvature = { C - half, std::sqrt(std::max(c(2, 2) - 2 * c(2, 3) + c(3, 3), 0.0)) };
	for (size_t s = 0; s < x.state.size(); ++s)
	{
		Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
		const int at = 4 + 3 * int(s);
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

/// The edges, and a fit of them; `by_power` per state (search_focus.h).
struct Fitted
{
	std::vector<Observation> observations;
	double model_sigma = 0.5;
	Unknowns x;
	std::vector<char> by_power;
};

/// Fits everything from f.x on, with the common error that the residuals show.
void Refine(LensModel model, double w_mm, Fitted& f)
{
	BlurFit fit{ model, f.observations, w_mm, f.model_sigma };
	for (int round = 0; round < 3; ++round)
	{
		if (fit.Minimise(f.x, Free::EVERYTHING, 0) >= 1e300)
			throw Refused("the blur fit did not converge");
		fit.model_sigma = std::max(fit.Scale(f.x), 0.01);
	}
	f.model_sigma = fit.model_sigma;
}

/// From nothing: first with a coarse common error, then refined.
Fitted FitFromNothing(LensModel model, const Task& task, const Geometry& geometry)
{
	Fitted f;
	f.observations = Observe(task, geometry);
	RefuseTooFewEdges(task, f.observations);
	const double w_mm = geometry.w_px * task.pitch_mm;
	const BlurFit fit{ model, f.observations, w_mm, f.model_sigma };
	f.x.state.assign(task.states.size(), StateNumbers{ 0, 0, 0 });
	SearchUntilted(fit, task, geometry, f.x);
	f.by_power.assign(task.states.size(), false);
	for (size_t s = 1; s < task.states.size(); ++s)
		f.by_power[s] = SearchTilted(fit, task, geometry, s, f.x);
	Refine(model, w_mm, f);
	return f;
}

Solution SolutionOf(LensModel model, const char* name, const Task& task, const Geometry& geometry, const Fitted& f)
{
	const BlurFit fit{ model, f.observations, geometry.w_px * task.pitch_mm, f.model_sigma };
	Solution solution;
	solution.model = name;
	FillSolution(task, geometry, fit, f.x, fit.CovarianceOfPlanes(f.x), solution);
	for (size_t s = 0; s < f.by_power.size(); ++s)
		solution.states[s].chosen_by_power = f.by_power[s];
	RefuseUndetermined(task, solution);
	return solution;
}

double HeldOut(LensModel model, const Task& task, const Geometry& geometry, const Fitted& f, double most)
{
	return HeldOutError({ model, f.observations, geometry.w_px * task.pitch_mm, f.model_sigma }, f.x, most);
}

/// The bowl, or the two of an astigmatic lens where that foretells photographs better. `plane`: where to start.
Solution Curve(const Task& task, const Geometry& geometry, const Fitted& plane, double most)
{
	const double w_mm = geometry.w_px * task.pitch_mm;
	Fitted one = plane;
	Refine(LensModel::BOWL, w_mm, one);
	Fitted two = one;
	Refine(LensModel::BOWLS, w_mm, two);
	const double one_error = HeldOut(LensModel::BOWL, task, geometry, one, most), two_error = HeldOut(LensModel::BOWLS, task, geometry, two, most);
	const bool apart = two_error < WORTH_IT * one_error;
	Solution solution = apart ? SolutionOf(LensModel::BOWLS, "curved", task, geometry, two) : SolutionOf(LensModel::BOWL, "curved", task, geometry, one);
	solution.held_out_px = apart ? two_error : one_error;
	return solution;
}

/// What a difference counts at most in a held-out error: as much for every model.
double MostOf(const Fitted& plane) { return 5 * plane.model_sigma; }

}

Solution SolvePlane(const Task& task, const Geometry& geometry)
{
	return SolutionOf(LensModel::PLANE, "plane", task, geometry, FitFromNothing(LensModel::PLANE, task, geometry));
}

Solution SolveRigid(const Task& task, const Geometry& geometry)
{
	return SolutionOf(LensModel::RIGID, "rigid", task, geometry, FitFromNothing(LensModel::RIGID, task, geometry));
}

Solution SolveCurved(const Task& task, const Geometry& geometry)
{
	const Fitted plane = FitFromNothing(LensModel::PLANE, task, geometry);
	return Curve(task, geometry, plane, MostOf(plane));
}

std::vector<Solution> CompareExact(const Task& task, const Geometry& geometry)
{
	const Fitted plane = FitFromNothing(LensModel::PLANE, task, geometry);
	const double most = MostOf(plane);
	std::vector<Solution> all;
	const auto add = [&](const char* model, auto solve)
	{
		try
		{
			all.push_back(solve());
		}
		catch (const Error& e)
		{
			if (e.Code() != EXIT_REFUSED)
				throw;
			all.emplace_back();
			all.back().model = model;
			all.back().failure = e.what();
		}
	};
	add("rigid", [&]
	{
		const Fitted rigid = FitFromNothing(LensModel::RIGID, task, geometry);
		Solution s = SolutionOf(LensModel::RIGID, "rigid", task, geometry, rigid);
		s.held_out_px = HeldOut(LensModel::RIGID, task, geometry, rigid, most);
		return s;
	});
	all.push_back(SolutionOf(LensModel::PLANE, "plane", task, geometry, plane));
	all.back().held_out_px = HeldOut(LensModel::PLANE, task, geometry, plane, most);
	add("curved", [&] { return Curve(task, geometry, plane, most); });
	return all;
}

bool CurvatureIsSeen(const Solution& plane, const Solution& curved)
{
	const auto significant = [](const Estimate& e) { return std::abs(e.value) > 2 * e.sigma; };
	return curved.failure.empty() && significant(curved.field_curvature) && curved.held_out_px > 0 && curved.held_out_px < WORTH_IT * plane.held_out_px;
}

}
