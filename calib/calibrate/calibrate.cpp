// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/calibrate.h>

#include "effects/chromatic_fit.h"
#include <tiltcal/error.h>
#include "calibrate/beside_real_lens.h"
#include "calibrate/between_parts.h"
#include "calibrate/quiet.h"
#include "calibrate/check_light.h"
#include "calibrate/check_board.h"
#include "calibrate/check_photographs.h"
#include "calibrate/check_untilted.h"
#include "calibrate/exif_check.h"
#include "calibrate/floor_shape.h"
#include "calibrate/left_over.h"
#include "calibrate/next_photographs.h"
#include "calibrate/stops_of_photographs.h"
#include "calibrate/use_threads.h"
#include "calibrate/verdict.h"
#include "base/robust.h"
#include "base/stopwatch.h"
#include "solve/edge_bias.h"
#include "solve/solve_lens.h"
#include "solve/solve_geometry.h"
#include "solve/solve_joint.h"
#include "solve/solve_real_lens.h"
#include "effects/effects.h"
#include "effects/vignetting.h"

#include <fmt/format.h>
#include "lens/optics.h"

#include <algorithm>

namespace tiltcal
{

namespace
{

/// Above this a picture rendered without distortion is visibly not the photograph, px.
const double PINHOLE_RMS = 0.4;

std::vector<Vec3<double>> LensNormals(const Solution& s)
{
	std::vector<Vec3<double>> normals;
	for (const StateLens& lens : s.states)
		normals.push_back(tilt_lens::LensFromPlane(lens.q, 1 / s.w_mm.value).normal);
	return normals;
}

/// A photograph whose corners disagree with the rest is of another camera or board, or
/// was cropped; it should not be averaged in unnoticed.
void WarnOfOddPhotos(const Task& task, const Geometry& g, const Log& log)
{
	std::vector<double> all;
	for (const StateGeometry& state : g.states)
		all.insert(all.end(), state.photo_rms.begin(), state.photo_rms.end());
	const double median = Median(all);
	for (size_t s = 0; s < g.states.size(); ++s)
		for (size_t p = 0; p < g.states[s].photo_rms.size(); ++p)
			if (g.states[s].photo_rms[p] > 5 * median + 0.3)
				log.Warn(fmt::format("{}: its corners fit badly ({:.2f} px, others {:.2f} px): is it of the same camera and board?",
					task.states[s].photos[p].file, g.states[s].photo_rms[p], median));
}

bool SameCounts(const Task& task)
{
	for (const State& state : task.states)
		if (state.photos.size() != task.states[0].photos.size())
			return false;
	return true;
}

/// RMS of the reprojection if the board stood still between the states; none where no camera has such poses.
std::optional<double> RmsOfSharedPoses(const Task& task, const std::vector<Vec3<double>>& normals)
{
	try
	{
		return SolveGeometry(task, { 2, normals, true }).rms;
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED)
			throw;
		return std::nullopt;
	}
}

/// A board that was moved between the states shows as a reprojection error of many
/// pixels, or as no answer; the little that the pupil moves when the lens tilts does not double it.
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
	const double own = SolveGeometry(task, { 2, normals, false }).rms;
	const std::optional<double> shared = RmsOfSharedPoses(task, normals);
	const bool same = shared && *shared < 2 * own + 0.1;
	o.log.Info(fmt::format("board poses {} between the states: reprojection {} if shared, {:.3f} px with own poses", same ? "shared" : "differ",
		shared ? fmt::format("{:.3f} px", *shared) : "without an answer", own));
	return same;
}

/// The exact model. The distortion turns with the lens, so lens and geometry are solved
/// in turn: the lens moves the distortion's axis, the geometry hardly moves the lens.
void SolveExact(const Task& measured, const std::optional<Model>& model, const CalibrateOptions& o, Calibration& c)
{
	Task& task = c.task;
	auto solve = model == Model::RIGID ? SolveRigid : model == Model::CURVED ? SolveCurved : SolvePlane;
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
	c.pinhole = SolveGeometry(task, { 0, {}, options.shared_poses });
	c.render = c.geometry.distortion_terms ? solve(task, c.pinhole) : c.solution;
}

/// The thin lens to solve where the options leave no choice. Throws UsageError where the two contradict each other.
std::optional<Model> ModelFor(const CalibrateOptions& o)
{
	if (o.model == Model::LENS)
		return std::nullopt;
	if (!o.effects.Excludes(EffectId::FIELD_CURVATURE))
		return o.model;
	if (o.model == Model::CURVED)
		throw UsageError("`model` curved has field curvature: add field_curvature to `effects`, or leave out `model`");
	return o.model ? o.model : Model::PLANE;
}

/// What a program could have left out. Throws UsageError.
void CheckTask(const Task& task)
{
	CheckPitch(task.pitch_mm);
	if (task.states.empty())
		throw UsageError("the task has no states: the first is the untilted one");
	for (const State& state : task.states)
		if (state.photos.empty())
			throw UsageError(fmt::format("state {}: no photographs", state.name));
	if (task.width < 1 || task.height < 1)
		throw UsageError("the task does not say the photographs' width and height, px");
	CheckStops(task);
}

void LogEffects(const Calibration& c, const Log& log)
{
	if (!c.vignetting.failure.empty())
		log.Info(fmt::format("vignetting not estimated: {}", c.vignetting.failure));
	if (!c.chromatic.failure.empty())
		log.Info(fmt::format("chromatic aberration not estimated: {}", c.chromatic.failure));
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
	else if (c.geometry.distortion_terms == 0)
		c.render = c.solution;
}

/// As WORTH_IT. What a thin lens leaves out must be a third of the whole of what is left over, 0.95 = sqrt(1 - 1/9): with less a lens with a dozen more numbers finds
/// what measuring leaves out of sharp edges, of boards too that a thin lens has photographed.
const double REAL_LENS_IS_WORTH_IT = 0.95;

/// A real lens where it was asked for; else where a thin one leaves over more than noise, the choice is free, and photographs left out are
/// predicted better by REAL_LENS_IS_WORTH_IT. With the rims that are written, which decide what of the opening an edge is seen through.
void FindRealLens(const Task& through_rims, const CalibrateOptions& o, Calibration& c)
{
	const bool asked = o.model == Model::LENS;
	if (!asked && (o.model || o.effects.kind != EffectChoice::AUTO || !c.refined || !MoreThanNoiseIsLeftOver(c)))
		return;
	o.log.Info("solving one real lens, with aberrations, for all states");
	RealLenses found = FindRealLens(c.task, through_rims, c.geometry, c.solution, WrittenRims(c), [&](RealLens& lens)
	{
		lens.used = asked || (lens.held_out > 0 && lens.held_out < REAL_LENS_IS_WORTH_IT * lens.held_out_thin);
		if (!lens.used || !o.scene_lens)
			return false;
		o.log.Info("solving it with the fifth order, for scenes");
		return true;
	});
	c.real_lens = std::move(found.tilts);
	const RealLens& lens = *c.real_lens;
	if (!lens.failure.empty())
	{
		if (asked)
			throw Refused("no real lens: " + lens.failure);
		o.log.Info(fmt::format("no real lens: {}", lens.failure));
		return;
	}
	o.log.Info(fmt::format("real lens {}: photographs left out are predicted to {:.2f} of what is usual by it, to {:.2f} by {}", lens.used ? "taken" : "not taken", lens.held_out, lens.held_out_thin,
		NameOf(c.solution.model)));
	c.scene_lens = std::move(found.scene);
	if (!c.scene_lens)
		return;
	RealLens& scene = *c.scene_lens;
	scene.used = scene.held_out > 0 && scene.held_out < WORTH_IT * scene.held_out_thin;
	o.log.Info(fmt::format("the fifth order {} for scenes: photographs left out are predicted to {:.2f} of what is usual with it, to {:.2f} by six numbers", scene.used ? "taken" : "not taken", scene.held_out, scene.held_out_thin));
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

/// Sigmas of a thin lens whose photographs are unsharp by themselves.
void WidenByFloor(const CalibrateOptions& o, Calibration& c)
{
	if (c.solution.model == Model::PAPER || !c.refined || o.refinement == Refinement::NONE)
		return;
	const Solution whole = c.solution;
	if (const std::optional<PartAnswer> other = SolveWithGaussianFloor(c))
		for (Solution* told : { &c.solution, &c.render })
			WidenByParts(whole, { *other }, *told);
}

/// Sigmas of a thin lens whose photographs misfit by more than noise, in blur or in places.
void WidenWhereGlassShows(const CalibrateOptions& o, Calibration& c)
{
	if (c.solution.model == Model::PAPER || !c.refined || o.refinement == Refinement::NONE || c.RealLensIsUsed() || !MoreThanNoiseIsLeftOver(c))
		return;
	o.log.Info("solving parts of the edges: how far they put the lens apart");
	const Solution whole = c.solution;
	c.thin_as_it_scatters = whole.states;
	const std::vector<PartAnswer> parts = SolveParts(c);
	for (Solution* told : { &c.solution, &c.render })
		WidenByParts(whole, parts, *told);
}

/// The sigma of a thin lens's f, however well it fits: no photograph tells it from a real lens with pupils of two sizes.
void WidenByUnknownPupils(Calibration& c)
{
	const auto& priors = c.task.priors;
	const bool told_f = std::any_of(priors.begin(), priors.end(), [](const Prior& p) { return p.quantity == Quantity::FOCAL_LENGTH; });
	if (c.solution.model == Model::PAPER || c.RealLensIsUsed() || told_f)
		return;
	for (Solution* told : { &c.solution, &c.render })
		WidenByPupils(*told);
}

/// From a camera on: refined, and what is checked of its photographs.
void RefineAndCheck(const CalibrateOptions& o, Calibration& c)
{
	Refine(c.task, o, c);
	AddBoardSize(c);
	c.photographs = CheckPhotographs(c);
	c.board_check = CheckBoard(c.task, c.geometry);
	c.untilted_check = CheckUntilted(c);
}

/// A thin lens once more from what its edges would be without the rims that were found, which cut blurs and move edges. A real lens sees edges through what rims leave.
void SolveThroughRims(const Task& measured, const CalibrateOptions& o, Calibration& c)
{
	std::vector<tilt_lens::Rim> rims;
	for (const RimEstimate& rim : WrittenRims(c))
		rims.push_back({ rim.radius_mm.value, rim.distance_mm.value });
	if (rims.empty() || !c.refined)
		return;
	o.log.Info("solving geometry and lens once more, with the rims that vignette");
	c.task = WithoutEdgeBias(measured, c.geometry, c.solution, rims);
	GeometryOptions options;
	options.may_distort = !o.effects.Excludes(EffectId::DISTORTION);
	options.lens_normal = LensNormals(c.solution);
	options.shared_poses = c.geometry.shared_poses;
	c.geometry = SelectGeometry(c.task, options);
	c.solution = SolveLeavingOut(c.solution.model, c.task, c.geometry);
	c.pinhole = SolveGeometry(c.task, { 0, {}, options.shared_poses });
	c.render = c.geometry.distortion_terms ? SolveLeavingOut(c.solution.model, c.task, c.pinhole) : c.solution;
	RefineAndCheck(o, c);
	ChooseEffects(o.effects, c);
}

Calibration Solve(const Task& measured, const CalibrateOptions& o)
{
	const Log& log = o.log;
	Calibration c;
	c.task = measured;
	const Task& task = c.task;
	const std::optional<Model> model = ModelFor(o);
	if (model != Model::PAPER)
	{
		SolveExact(measured, model, o, c);
		RefineAndCheck(o, c);
	}
	else
		c.geometry = c.pinhole = SolveGeometry(task, { 0, {}, PosesAreShared(task, {}, o) });
	WarnOfOddPhotos(task, c.geometry, log);
	for (size_t k = 0; k < task.states.size(); ++k)
		if (c.geometry.states[k].principal_point_fixed)
			log.Warn(fmt::format("state {}: the photographs do not determine the principal point; it is held to 2 % of the width about the picture's centre. "
				"Photograph the board in more, differently inclined poses", task.states[k].name));
	for (size_t k = 0; k < c.solution.states.size(); ++k)
		if (c.solution.states[k].chosen_by_power)
			log.Warn(fmt::format("state {}: the blur alone fits two planes of focus; the one that keeps the focal length was taken. "
				"Photograph more poses to be sure", task.states[k].name));
	double worst = 0;
	for (const StateGeometry& state : c.pinhole.states)
		worst = std::max(worst, *std::max_element(state.photo_rms.begin(), state.photo_rms.end()));
	log.Info(fmt::format("reprojection: {:.3f} px with {} distortion terms (w {:.3f} mm), {:.3f} px without (w {:.3f} mm)", c.geometry.rms,
		c.geometry.distortion_terms, c.geometry.w_px * task.pitch_mm, c.pinhole.rms, c.pinhole.w_px * task.pitch_mm));
	if (worst > PINHOLE_RMS)
		log.Warn(fmt::format("a render without this lens's distortion misses the corners of the worst photograph by {:.2f} px RMS", worst));

	log.Info("solving the lens (paper)");
	const Stopwatch time;
	c.paper = SolvePaper(task, c.pinhole, c.paper_geometry);
	c.paper.seconds = time.Seconds();
	if (!c.paper.failure.empty())
	{
		if (model == Model::PAPER)
			throw Refused(c.paper.failure);
		log.Warn(fmt::format("the paper's model, for comparison, gave no answer: {}", c.paper.failure));
	}
	if (model == Model::PAPER)
		c.solution = c.render = c.paper;
	c.vignetting = EstimateVignetting(c);
	c.chromatic = EstimateChromatic(c);
	LogEffects(c, log);
	ChooseEffects(o.effects, c);
	if (model != Model::PAPER)
	{
		const Task through_rims = c.task;
		SolveThroughRims(measured, o, c);
		FindRealLens(through_rims, o, c);
		if (c.RealLensIsUsed())
			ClearByRealLens(*c.real_lens, c.photographs);
		c.light = CheckLight(c);
	}
	// Of what scatters: further photographs do not change what the model leaves out.
	if (model != Model::PAPER && c.refined && o.next_photographs)
		c.next = FindNextPhotographs(c);
	WidenWhereGlassShows(o, c);
	WidenByFloor(o, c);
	WidenByUnknownPupils(c);
	WidenTilts(c);
	c.verdict = Judge(c);
	// Last: such a lens is graded by its tilts.
	WidenByRealLens(c);
	return c;
}

}

Calibration Calibrate(const Task& measured, const CalibrateOptions& o)
{
	const QuietLibraries quiet;
	const UseThreads threads(o.threads);
	CheckTask(measured);
	try
	{
		return Solve(measured, o);
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED)
			throw;
		std::string text = e.what();
		for (const std::string& line : WhatPhotographsLack(measured))
			text += "\n  " + line;
		throw Refused(text);
	}
}

}
