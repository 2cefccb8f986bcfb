// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_lens.h"

#include "base/if_answered.h"
#include "base/stopwatch.h"

#include "model/lens_model.h"
#include "solve/blur_fit.h"
#include <tiltcal/error.h>
#include "solve/fill_solution.h"
#include "solve/held_out.h"
#include "solve/search_focus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

void RefuseTooFewEdges(const Task& task, const std::vector<Observation>& observations)
{
	std::vector<int> count(task.states.size(), 0);
	for (const Observation& o : observations)
		++count[o.state];
	for (size_t s = 0; s < count.size(); ++s)
		if (count[s] < 20)
			throw Refused(fmt::format("state {}: only {} edges could be measured, 20 are needed: "
				"use a smaller blur, a larger picture of the board, more photographs, or more `edges_per_photo`", task.states[s].name, count[s]));
}

/// The edges, and a fit of them; `by_power` per state (search_focus.h).
struct Fitted
{
	std::vector<Observation> observations;
	double model_sigma = 0.5, scatter = 0.5;   // px: what the model leaves out, and noise and all
	Unknowns x;
	std::vector<char> by_power;
};

/// Fits everything from f.x on, with the common error that the residuals show.
void Refine(LensModel model, const Task& task, double w_mm, Fitted& f)
{
	BlurFit fit{ model, f.observations, w_mm, f.model_sigma, task.priors, task.stops };
	for (int round = 0; round < 3; ++round)
	{
		if (!fit.Minimise(f.x, Free::EVERYTHING, 0))
			throw Refused("the blur fit did not converge");
		fit.model_sigma = fit.LeftOutBy(f.x);
	}
	f.model_sigma = fit.model_sigma;
	f.scatter = std::max(fit.Scale(f.x), 0.01);
}

/// From nothing: first with a coarse common error, then refined.
Fitted FitFromNothing(LensModel model, const Task& task, const Geometry& geometry)
{
	Fitted f;
	f.observations = Observe(task, geometry);
	RefuseTooFewEdges(task, f.observations);
	const double w_mm = geometry.w_px * task.pitch_mm;
	const BlurFit fit{ model, f.observations, w_mm, f.model_sigma, task.priors, task.stops };
	f.x.state.assign(task.states.size(), StateNumbers{ 0, 0, 0 });
	f.x.stops = StopRatios(task.stops);
	SearchUntilted(fit, task, geometry, f.x);
	f.by_power.assign(task.states.size(), false);
	for (size_t s = 1; s < task.states.size(); ++s)
		f.by_power[s] = SearchTilted(fit, task, geometry, s, f.x);
	f.x.untilted_free = task.untilted_free;
	Refine(model, task, w_mm, f);
	return f;
}

Solution SolutionOf(LensModel model, Model name, const Task& task, const Geometry& geometry, const Fitted& f)
{
	const BlurFit fit{ model, f.observations, geometry.w_px * task.pitch_mm, f.model_sigma, task.priors, task.stops };
	Solution solution;
	solution.model = name;
	FillSolution(task, geometry, fit, f.x, fit.Covariance(f.x, geometry.w_px_sigma * task.pitch_mm), solution);
	for (size_t s = 0; s < f.by_power.size(); ++s)
		solution.states[s].chosen_by_power = f.by_power[s];
	RefuseUndetermined(task, fit, solution);
	return solution;
}

HeldOut LeaveOut(LensModel model, const Task& task, const Geometry& geometry, const Fitted& f, double most)
{
	return HoldOut({ model, f.observations, geometry.w_px * task.pitch_mm, f.model_sigma, task.priors, task.stops }, f.x, most);
}

void Keep(const HeldOut& held_out, Solution& solution)
{
	solution.held_out_px = held_out.rms;
	solution.left_out = held_out.photos;
}

/// SolutionOf with what photographs left out say.
Solution LeavingOut(LensModel model, Model name, const Task& task, const Geometry& geometry, const Fitted& f, double most)
{
	Solution solution = SolutionOf(model, name, task, geometry, f);
	Keep(LeaveOut(model, task, geometry, f, most), solution);
	return solution;
}

/// The bowl, or the two of an astigmatic lens where that predicts photographs better. `plane`: where to start.
Solution Curve(const Task& task, const Geometry& geometry, const Fitted& plane, double most)
{
	const double w_mm = geometry.w_px * task.pitch_mm;
	Fitted one = plane;
	Refine(LensModel::BOWL, task, w_mm, one);
	const HeldOut of_one = LeaveOut(LensModel::BOWL, task, geometry, one, most);
	const auto astigmatic = [&]() -> std::optional<Solution>
	{
		Fitted two = one;
		Refine(LensModel::BOWLS, task, w_mm, two);
		const HeldOut of_two = LeaveOut(LensModel::BOWLS, task, geometry, two, most);
		if (!(of_two.rms > 0 && of_two.rms < WORTH_IT * of_one.rms))
			return std::nullopt;
		Solution solution = SolutionOf(LensModel::BOWLS, Model::CURVED, task, geometry, two);
		Keep(of_two, solution);
		return solution;
	};
	// The bowl is an answer where two have none.
	if (const std::optional<std::optional<Solution>> two = IfAnswered(astigmatic); two && *two)
		return **two;
	Solution solution = SolutionOf(LensModel::BOWL, Model::CURVED, task, geometry, one);
	Keep(of_one, solution);
	return solution;
}

/// What a difference counts at most in a held-out error: as much for every model.
double MostOf(const Fitted& plane) { return 5 * plane.scatter; }

}

Solution SolvePlane(const Task& task, const Geometry& geometry)
{
	return SolutionOf(LensModel::PLANE, Model::PLANE, task, geometry, FitFromNothing(LensModel::PLANE, task, geometry));
}

Solution SolveRigid(const Task& task, const Geometry& geometry)
{
	return SolutionOf(LensModel::RIGID, Model::RIGID, task, geometry, FitFromNothing(LensModel::RIGID, task, geometry));
}

Solution SolveCurved(const Task& task, const Geometry& geometry)
{
	const Fitted plane = FitFromNothing(LensModel::PLANE, task, geometry);
	return Curve(task, geometry, plane, MostOf(plane));
}

Solution SolveLeavingOut(Model model, const Task& task, const Geometry& geometry)
{
	if (model == Model::CURVED)
		return SolveCurved(task, geometry);
	const LensModel lens_model = model == Model::RIGID ? LensModel::RIGID : LensModel::PLANE;
	const Fitted f = FitFromNothing(lens_model, task, geometry);
	return LeavingOut(lens_model, model, task, geometry, f, MostOf(f));
}

ModelComparison CompareExact(const Task& task, const Geometry& geometry)
{
	const Fitted plane = FitFromNothing(LensModel::PLANE, task, geometry);
	const double most = MostOf(plane);
	const auto or_failure = [](Model model, auto solve)
	{
		const Stopwatch time;
		Solution none;
		none.model = model;
		Solution s = IfAnswered(solve, &none.failure).value_or(none);
		s.seconds = s.failure.empty() ? time.Seconds() : 0;
		return s;
	};
	ModelComparison all;
	all.rigid = or_failure(Model::RIGID, [&] { return LeavingOut(LensModel::RIGID, Model::RIGID, task, geometry, FitFromNothing(LensModel::RIGID, task, geometry), most); });
	const Stopwatch time;
	all.plane = LeavingOut(LensModel::PLANE, Model::PLANE, task, geometry, plane, most);
	all.plane.seconds = time.Seconds();
	all.curved = or_failure(Model::CURVED, [&] { return Curve(task, geometry, plane, most); });
	return all;
}

bool CurvatureIsSeen(const Solution& plane, const Solution& curved)
{
	const auto significant = [](const Estimate& e) { return std::abs(e.value) > 2 * e.sigma; };
	return curved.failure.empty() && significant(curved.field_curvature) && curved.held_out_px > 0 && curved.held_out_px < WORTH_IT * plane.held_out_px;
}

}
