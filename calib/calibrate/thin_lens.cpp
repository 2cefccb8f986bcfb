// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/thin_lens.h"

#include "base/stopwatch.h"
#include "calibrate/check_board.h"
#include "calibrate/check_focus.h"
#include "calibrate/check_photographs.h"
#include "calibrate/check_untilted.h"
#include "effects/effects.h"
#include "effects/vignetting.h"
#include "lens/optics.h"
#include "model/rims_on_lens.h"
#include "solve/edge_bias.h"
#include "solve/solve_geometry.h"
#include "solve/solve_joint.h"
#include "solve/solve_lens.h"

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

namespace
{

using Solver = Solution (*)(const Task&, const Geometry&);

Solver SolverOf(Model model) { return model == Model::RIGID ? SolveRigid : model == Model::CURVED ? SolveCurved : SolvePlane; }

std::vector<Vec3<double>> LensNormals(const Solution& s)
{
	std::vector<Vec3<double>> normals;
	for (const StateLens& lens : s.states)
		normals.push_back(tilt_lens::LensFromPlane(lens.q, 1 / s.w_mm.value).normal);
	return normals;
}

bool SameCounts(const Task& task)
{
	for (const State& state : task.states)
		if (state.photos.size() != task.states[0].photos.size())
			return false;
	return true;
}

/// RMS of the reprojection; none where no camera has such poses.
std::optional<double> RmsOfPoses(const Task& task, const std::vector<Vec3<double>>& normals, int terms, bool shared)
{
	const std::optional<Geometry> g = SolveGeometryIfDetermined(task, { terms, normals, shared });
	return g ? std::optional(g->rms) : std::nullopt;
}

/// The camera without distortion, fitted as such, and the lens beside it.
void SolvePinhole(Solver solve, Calibration& c)
{
	c.pinhole = SolveGeometry(c.task, { 0, {}, c.geometry.shared_poses });
	c.render = c.geometry.distortion_terms ? solve(c.task, c.pinhole) : c.solution;
}

/// The exact model. The distortion turns with the lens, so lens and geometry are solved
/// in turn: the lens moves the distortion's axis, the geometry hardly moves the lens.
void SolveExact(const Task& measured, const std::optional<Model>& model, const CalibrateOptions& o, Calibration& c)
{
	Task& task = c.task;
	auto solve = SolverOf(model.value_or(Model::PLANE));
	o.log.Info(fmt::format("solving geometry and lens ({})", NameOf(model.value_or(Model::PLANE))));
	GeometryOptions options;
	options.may_distort = !o.effects.Excludes(EffectId::DISTORTION);
	c.geometry = SelectGeometry(task, options);
	c.solution = solve(task, c.geometry);
	options.lens_normal = LensNormals(c.solution);
	options.shared_poses = PosesAreShared(task, options.lens_normal, o);
	for (int round = 0; round < 2; ++round)
	{
		task = WithoutEdgeBias(measured, c.geometry, c.solution);
		c.geometry = SelectGeometry(task, options);
		c.solution = solve(task, c.geometry);
		options.lens_normal = LensNormals(c.solution);
	}
	if (model && c.solution.left_out.empty())
		c.solution = SolveLeavingOut(*model, task, c.geometry);
	if (!model)
	{
		o.log.Info("comparing models");
		c.compared = CompareExact(task, c.geometry);
		const Solution &plane = c.compared->plane, &curved = c.compared->curved;
		if (CurvatureIsSeen(plane, curved) || (o.effects.Wants(EffectId::FIELD_CURVATURE) && curved.failure.empty()))
		{
			solve = SolveCurved;
			options.lens_normal = LensNormals(curved);
			c.geometry = SelectGeometry(task, options);
			c.solution = solve(task, c.geometry);
		}
		else
			c.solution = plane;
		o.log.Info(fmt::format("model {}: photographs left out are predicted to {:.3f} px by plane, {:.3f} px by curved", NameOf(c.solution.model), plane.held_out_px, curved.held_out_px));
	}
	SolvePinhole(solve, c);
}

/// Joint refinement; what blur alone and geometry alone say of the tilt is kept.
void Refine(const Task& task, const CalibrateOptions& o, Calibration& c)
{
	c.blur_alone = c.solution.states;
	c.geometry_alone = TiltFromGeometryAlone(task, c.geometry, c.solution);
	if (o.refinement == Refinement::NONE)
		return;
	o.log.Info(fmt::format("refining geometry and lens together ({})", o.refinement == Refinement::EDGES ? "edges" : "photometric"));
	if (!RefineJointly(task, o.refinement, c.geometry, c.solution))
	{
		c.refined = false;
		o.log.Warn("the joint refinement did not converge; geometry and blur are as solved one after the other");
	}
	else
	{
		c.jointly = true;
		// One camera: places, lens and sigmas of one fit.
		if (c.geometry.distortion_terms == 0)
		{
			c.render = c.solution;
			c.pinhole = c.geometry;
		}
	}
}

/// What the size of the board adds to the sigmas of places; those of the lens hold it already.
void AddBoardSize(Calibration& c)
{
	const double relative = c.task.board.square_sigma_mm / c.task.board.square_mm;
	for (Geometry* g : { &c.geometry, &c.pinhole })
		for (StateGeometry& state : g->states)
		{
			for (size_t p = 0; p < state.poses.size(); ++p)
				for (size_t k = 3; k < 6; ++k)
					state.pose_sigmas[p][k] = std::hypot(state.pose_sigmas[p][k], relative * state.poses[p][k]);
			const std::pair<double*, double> centre[] = { { &state.lens_centre_sigma.x, state.lens_centre.x }, { &state.lens_centre_sigma.y, state.lens_centre.y }, { &state.lens_centre_sigma.z, state.lens_centre.z } };
			for (const auto& [sigma, value] : centre)
				*sigma = std::hypot(*sigma, relative * value);
		}
}

/// From a camera on: refined, and what is checked of its photographs.
void RefineAndCheck(const CalibrateOptions& o, Calibration& c)
{
	Refine(c.task, o, c);
	AddBoardSize(c);
	c.photographs = CheckPhotographs(c);
	c.board_check = CheckBoard(c.task, c.geometry);
	c.focus_check = CheckFocus(c);
	c.untilted_check = CheckUntilted(c);
}

/// Whether a rim is narrower for the light from the point in focus on the axis than the lens: then it is the stop, and says of d what blur says.
bool HoldBackTheAxis(const std::vector<tilt_lens::Rim>& rims, const Calibration& c)
{
	const Vec3<double> axis{ 0, 0, 1 };
	const std::vector<RimOnLens> seen = RimsOnLens(axis, axis, 1 / c.solution.states[0].focus_distance.value, axis, c.solution.w_mm.value, rims);
	return std::any_of(seen.begin(), seen.end(), [&](const RimOnLens& rim) { return 2 * rim.radius < c.solution.aperture_diameter.value; });
}

/// Geometry and lens of these edges, the poses shared and the model chosen as before.
void SolveAgain(Task task, const CalibrateOptions& o, Calibration& c)
{
	c.task = std::move(task);
	GeometryOptions options;
	options.may_distort = !o.effects.Excludes(EffectId::DISTORTION);
	options.lens_normal = LensNormals(c.solution);
	options.shared_poses = c.geometry.shared_poses;
	c.geometry = SelectGeometry(c.task, options);
	c.solution = SolveLeavingOut(c.solution.model, c.task, c.geometry);
}

}

bool PosesAreShared(const Task& task, const std::vector<Vec3<double>>& normals, const CalibrateOptions& o)
{
	if (task.states.size() < 2 || o.poses == Poses::OWN)
		return false;
	if (!SameCounts(task))
	{
		if (o.poses == Poses::SHARED)
			throw Refused("`poses` shared: the states have different numbers of photographs");
		return false;
	}
	if (o.poses == Poses::SHARED)
		return true;
	std::optional<double> own = RmsOfPoses(task, normals, 2, false), shared = RmsOfPoses(task, normals, 2, true);
	// Alike: without distortion where either cannot tell that too; against what poses of their own do at best.
	if (!own || !shared)
	{
		const std::optional<double> without = RmsOfPoses(task, normals, 0, false);
		own = own && without ? std::min(*own, *without) : without ? without : own;
		shared = RmsOfPoses(task, normals, 0, true);
	}
	if (!own)
		own = SolveGeometry(task, { 0, normals, false }).rms;   // says why there is none
	const bool same = shared && *shared < 2 * *own + 0.1;
	o.log.Info(fmt::format("board poses {} between the states: reprojection {} if shared, {:.3f} px with own poses", same ? "shared" : "differ",
		shared ? fmt::format("{:.3f} px", *shared) : "without an answer", *own));
	return same;
}

void SolveThinLens(const Task& measured, const std::optional<Model>& model, const CalibrateOptions& o, Calibration& c)
{
	SolveExact(measured, model, o, c);
	RefineAndCheck(o, c);
}

Task SolveThroughRims(const Task& measured, const CalibrateOptions& o, Calibration& c)
{
	if (WrittenRims(c).empty() || !c.refined || HoldBackTheAxis(RimsOf(WrittenRims(c)), c))
		return c.task;
	o.log.Info("solving geometry and lens once more, with the rims that vignette");
	const Calibration without = c;
	try
	{
		SolveAgain(WithoutEdgeBias(measured, c.geometry, c.solution, RimsOf(WrittenRims(c))), o, c);
		// Brightness alone told the first rim: what else darkens corners does not cut blurs.
		if (!(c.solution.held_out_px > 0 && c.solution.held_out_px < WORTH_IT * without.solution.held_out_px))
		{
			o.log.Info("the edges do not show these rims: blur of photographs left out is not predicted better with them");
			c = without;
			return c.task;
		}
		c.task = WithoutEdgeBias(measured, c.geometry, c.solution);
		c.vignetting = EstimateVignetting(c);
		ChooseEffects(o.effects, c);
		SolveAgain(WithoutEdgeBias(measured, c.geometry, c.solution, RimsOf(WrittenRims(c))), o, c);
		SolvePinhole(SolverOf(c.solution.model), c);
		RefineAndCheck(o, c);
		ChooseEffects(o.effects, c);
		return WithoutEdgeBias(measured, c.geometry, c.solution);
	}
	catch (const Error& refusal)
	{
		if (refusal.Code() != EXIT_REFUSED)
			throw;
		o.log.Info(fmt::format("with the rims there is no answer ({}): they are left to the brightness", refusal.what()));
		c = without;
		return c.task;
	}
}

}
