// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_joint.h"

#include "model/lens_model.h"
#include "solve/fill_solution.h"
#include "solve/solve_geometry.h"

#include "lens/optics.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

void SetNormals(const JointFit& fit, const Unknowns& x, Geometry& g)
{
	const double w_mm = g.w_px * fit.task.pitch_mm;
	for (size_t s = 0; s < x.state.size(); ++s)
		g.states[s].lens_normal = tilt_lens::LensFromPlane(PlaneOfState(fit.model, &x.power, x.state[s].data(), w_mm), 1 / w_mm).normal;
}

void Fill(const Task& task, const Geometry& g, const BlurFit& fit, const Unknowns& x, const JointCovariance& covariance, Solution& out)
{
	FillSolution(task, g, fit, x, covariance.by_edges, out);
	if (!covariance.by_photographs)
		return;
	Solution by_photographs;
	FillSolution(task, g, fit, x, *covariance.by_photographs, by_photographs);
	WidenSigmas(by_photographs, out);
}

}

Unknowns UnknownsOf(const Solution& s)
{
	Unknowns x;
	x.d = s.aperture_diameter.value;
	x.floor_squared = s.psf_floor_squared.value;
	x.power = 1 / s.focal_length.value;
	x.curvature = { s.field_curvature.value, 0.5 * (s.tangential_curvature.value - s.sagittal_curvature.value) };
	for (const StateLens& state : s.states)
		x.state.push_back(StateOfPlane(s.lens, state.q, s.w_mm.value));
	x.stops = StopRatios(s.stop_ratios);
	return x;
}

bool RefineJointly(const Task& task, Refinement kind, Geometry& geometry, Solution& solution)
{
	for (const State& state : task.states)
		if (std::all_of(state.photos.begin(), state.photos.end(), [](const Photo& photo) { return photo.edges.empty(); }))
			return false;   // nothing to tell its lens by
	Geometry g = geometry;
	Unknowns x = UnknownsOf(solution);
	x.untilted_free = task.untilted_free;
	JointFit fit{ task, solution.lens, kind, {}, false };
	for (int round = 0; round < 2; ++round)
	{
		fit.error = ErrorOf(task, fit.Residuals(g, x));
		if (!fit.Minimise(g, x))
			return false;
		SetNormals(fit, x, g);
	}
	fit.error = ErrorOf(task, fit.Residuals(g, x));
	const std::optional<JointCovariance> covariance = fit.Covariance(g, x);
	if (!covariance)
		return false;
	MeasureReprojection(task, g);
	Solution refined;
	refined.model = solution.model;
	refined.held_out_px = solution.held_out_px;
	refined.left_out = solution.left_out;
	const std::vector<Observation> observations = Observe(task, g);
	Fill(task, g, { solution.lens, observations, g.w_px * task.pitch_mm, fit.error.blur, task.priors, task.stops }, x, *covariance, refined);
	for (size_t s = 0; s < refined.states.size(); ++s)
		refined.states[s].chosen_by_power = solution.states[s].chosen_by_power;
	geometry = g;
	solution = refined;
	return true;
}

double HeldOutOf(const Task& task, const Geometry& geometry, const Solution& solution, const ModelError& error)
{
	Geometry g = geometry;
	// As of a real lens every photograph is predicted by itself, its pose its own.
	g.shared_poses = false;
	for (StateGeometry& state : g.states)
		state.lens_centre = { 0, 0, 0 };
	Unknowns x = UnknownsOf(solution);
	x.untilted_free = task.untilted_free;
	const JointFit fit{ task, solution.lens, Refinement::EDGES, error, false };
	if (!fit.Minimise(g, x))
		return 0;
	const std::optional<JointCovariance> covariance = fit.Covariance(g, x);
	return covariance ? covariance->held_out : 0;
}

GeometryAlone TiltFromGeometryAlone(const Task& task, const Geometry& geometry, const Solution& solution, bool untilted_free)
{
	if (geometry.distortion_terms == 0 || !geometry.shared_poses)
		return {};
	Geometry g = geometry;
	Unknowns x = UnknownsOf(solution);
	x.untilted_free = untilted_free;
	JointFit fit{ task, solution.lens, Refinement::EDGES, {}, true };
	for (int round = 0; round < 2; ++round)
	{
		fit.error = ErrorOf(task, fit.Residuals(g, x));
		if (!fit.Minimise(g, x))
			return {};
	}
	const std::optional<JointCovariance> covariance = fit.Covariance(g, x);
	if (!covariance)
		return {};
	Solution alone;
	const std::vector<Observation> observations = Observe(task, g);
	Fill(task, g, { solution.lens, observations, g.w_px * task.pitch_mm, fit.error.blur, task.priors, task.stops }, x, *covariance, alone);
	return { alone.states, { g.pupil_magnification, g.pupil_magnification_sigma } };
}

}
