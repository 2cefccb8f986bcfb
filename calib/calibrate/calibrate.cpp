// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/calibrate.h>

#include "effects/chromatic_fit.h"
#include <tiltcal/error.h>
#include "calibrate/beside_real_lens.h"
#include "calibrate/between_parts.h"
#include "calibrate/quiet.h"
#include "calibrate/check_light.h"
#include "calibrate/check_photographs.h"
#include "calibrate/exif_check.h"
#include "calibrate/floor_shape.h"
#include "calibrate/left_over.h"
#include "calibrate/next_photographs.h"
#include "calibrate/stops_of_photographs.h"
#include "calibrate/thin_lens.h"
#include "calibrate/use_threads.h"
#include "calibrate/verdict.h"
#include "base/robust.h"
#include "base/stopwatch.h"
#include "solve/solve_lens.h"
#include "solve/solve_geometry.h"
#include "solve/solve_real_lens.h"
#include "effects/effects.h"
#include "effects/vignetting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

/// Above this a picture rendered without distortion is visibly not the photograph, px.
const double PINHOLE_RMS = 0.4;

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

/// The thin lens to solve where the options leave no choice; a real lens begins at any. Throws UsageError where they contradict each other or the board.
std::optional<Model> ModelFor(const CalibrateOptions& o, const Board& board)
{
	if (o.model == Model::LENS && !board.IsCheckerboard())
		throw UsageError("`model` lens looks at straight edges: give another model for circles, or photograph a checkerboard");
	if (!o.effects.Excludes(EffectId::FIELD_CURVATURE))
		return o.model == Model::LENS ? std::nullopt : o.model;
	if (o.model == Model::CURVED)
		throw UsageError("`model` curved has field curvature: add field_curvature to `effects`, or leave out `model`");
	return o.model && o.model != Model::LENS ? o.model : Model::PLANE;
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
	for (const FlatField& flat : task.flat_fields)
		if (flat.state >= task.states.size())
			throw UsageError(fmt::format("{}: a flat field of state {}, there are {}, from 0 on", flat.file, flat.state, task.states.size()));
	for (const Prior& prior : task.priors)
		if (!(prior.sigma > 0) || !std::isfinite(prior.value))
			throw UsageError(fmt::format("{}: what is known of it is a number with a sigma above 0, not {} +- {}", prior.Name(), prior.value, prior.sigma));
	CheckStops(task);
}

void LogEffects(const Calibration& c, const Log& log)
{
	if (!c.vignetting.failure.empty())
		log.Info(fmt::format("vignetting not estimated: {}", c.vignetting.failure));
	if (!c.chromatic.failure.empty())
		log.Info(fmt::format("chromatic aberration not estimated: {}", c.chromatic.failure));
}

/// As WORTH_IT. What a thin lens leaves out must be a third of the whole of what is left over, 0.95 = sqrt(1 - 1/9): with less a lens with a dozen more numbers finds
/// what measuring leaves out of sharp edges, of boards too that a thin lens has photographed.
const double REAL_LENS_IS_WORTH_IT = 0.95;

/// Relative to what is usual; 0: it cannot be had.
std::string LeftOutText(double held_out) { return held_out > 0 ? fmt::format("to {:.2f} of what is usual", held_out) : "to nobody knows what"; }

/// A real lens where it was asked for; else where a thin one leaves over more than noise, the choice is free, and photographs left out are
/// predicted better by REAL_LENS_IS_WORTH_IT. With the rims that are written, which decide what of the opening an edge is seen through.
void FindRealLens(const Task& through_rims, const CalibrateOptions& o, Calibration& c)
{
	const bool asked = o.model == Model::LENS;
	if (!asked && (!c.task.board.IsCheckerboard() || o.model || o.effects.kind != EffectChoice::AUTO || !c.refined || !MoreThanNoiseIsLeftOver(c)))
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
	c.fits_without_answer += lens.used ? found.fits_without_answer : 0;
	if (!lens.failure.empty())
	{
		if (asked)
			throw Refused("no real lens: " + lens.failure);
		o.log.Info(fmt::format("no real lens: {}", lens.failure));
		return;
	}
	o.log.Info(fmt::format("real lens {}: photographs left out are predicted {} by it, {} by {}", lens.used ? "taken" : "not taken", LeftOutText(lens.held_out), LeftOutText(lens.held_out_thin),
		NameOf(c.solution.model)));
	c.scene_lens = std::move(found.scene);
	if (!c.scene_lens)
		return;
	RealLens& scene = *c.scene_lens;
	scene.used = scene.held_out > 0 && scene.held_out < WORTH_IT * scene.held_out_thin;
	o.log.Info(fmt::format("the fifth order {} for scenes: photographs left out are predicted {} with it, {} by six numbers", scene.used ? "taken" : "not taken", LeftOutText(scene.held_out), LeftOutText(scene.held_out_thin)));
}

/// All that is told of a thin lens, and of where it stood. `parts` begin at c.geometry.
void WidenByParts(const Solution& whole, const std::vector<PartAnswer>& parts, Calibration& c)
{
	for (Solution* told : { &c.solution, &c.render })
		WidenByParts(whole, parts, *told);
	const Geometry geometry = c.geometry;
	for (Geometry* told : { &c.geometry, &c.pinhole })
		WidenPlacesByParts(geometry, parts, *told);
}

/// Sigmas of a thin lens whose photographs are unsharp by themselves.
void WidenByFloor(Calibration& c)
{
	if (!c.jointly || !ShapeOfFloorIsSeen(c))
		return;
	const Solution whole = c.solution;
	if (c.thin_as_it_scatters.empty())
		c.thin_as_it_scatters = whole.states;
	if (const std::optional<PartAnswer> other = SolveWithGaussianFloor(c))
		WidenByParts(whole, { *other }, c);
	else
		++c.fits_without_answer;
}

/// Sigmas of a thin lens. Glass that noise hides from each edge still puts all of them together elsewhere.
void WidenWhereGlassShows(const CalibrateOptions& o, Calibration& c)
{
	if (!c.jointly || c.RealLensIsUsed())
		return;
	o.log.Info("solving parts of the edges: how far they put the lens apart");
	const Solution whole = c.solution;
	c.thin_as_it_scatters = whole.states;
	int without_answer = 0;
	const bool misfits = MoreThanNoiseIsLeftOver(c);
	const std::vector<PartAnswer> parts = SolveParts(c, without_answer, !misfits);
	// Few edges have halves that tell nothing, which is no fault where they fit.
	c.fits_without_answer += misfits ? without_answer : 0;
	WidenByParts(whole, parts, c);
}

/// The sigma of a thin lens's f, however well it fits: no photograph tells it from a real lens with pupils of two sizes.
void WidenByUnknownPupils(Calibration& c)
{
	if (c.solution.model == Model::PAPER || c.RealLensIsUsed())
		return;
	// What is told of f before is known of whatever lens it is.
	double known = std::numeric_limits<double>::infinity();
	for (const Prior& p : c.task.priors)
		if (p.quantity == Quantity::FOCAL_LENGTH)
			known = std::min(known, p.sigma);
	for (Solution* told : { &c.solution, &c.render })
		WidenByPupils(*told, known);
}

/// What the places of corners say, and what they do not.
void LogGeometry(const Calibration& c, const Log& log)
{
	const Task& task = c.task;
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
}

/// The published method, for comparison, unless it is what was asked for.
void SolveByPaper(Calibration& c, bool is_wanted, const Log& log)
{
	log.Info("solving the lens (paper)");
	const Stopwatch time;
	// From the places of corners, as the paper has them; the pinhole may be refined by the blur.
	c.paper = SolvePaper(c.task, SolveGeometry(c.task, { 0, {}, c.pinhole.shared_poses }), c.paper_geometry);
	c.paper.seconds = time.Seconds();
	if (!c.paper.failure.empty())
	{
		if (is_wanted)
			throw Refused(c.paper.failure);
		log.Warn(fmt::format("the paper's model, for comparison, gave no answer: {}", c.paper.failure));
	}
	if (is_wanted)
		c.solution = c.render = c.paper;
}

Calibration Solve(const Task& measured, const CalibrateOptions& o)
{
	const Log& log = o.log;
	Calibration c;
	c.task = measured;
	const Task& task = c.task;
	const std::optional<Model> model = ModelFor(o, task.board);
	if (model != Model::PAPER)
		SolveThinLens(measured, model, o, c);
	else
		c.geometry = c.pinhole = SolveGeometry(task, { 0, {}, PosesAreShared(task, {}, o) });
	LogGeometry(c, log);
	SolveByPaper(c, model == Model::PAPER, log);
	c.vignetting = EstimateVignetting(c);
	c.chromatic = EstimateChromatic(c);
	LogEffects(c, log);
	ChooseEffects(o.effects, c);
	if (model != Model::PAPER)
		FindRealLens(SolveThroughRims(measured, o, c), o, c);
	if (c.RealLensIsUsed())
		ClearByRealLens(*c.real_lens, c.photographs);
	// Of what scatters: further photographs do not change what the model leaves out.
	if (model != Model::PAPER && c.refined && o.next_photographs)
		c.next = FindNextPhotographs(c);
	WidenWhereGlassShows(o, c);
	WidenByFloor(c);
	WidenByUnknownPupils(c);
	WidenTilts(c);
	// By what is known of the floor after all.
	if (model != Model::PAPER)
		c.light = CheckLight(c);
	c.verdict = Judge(c);
	// Last: such a lens is graded by its tilts.
	WidenByRealLens(c);
	WidenPlacesByImageDistance(c);
	WidenRimsByOpening(c.solution.aperture_diameter, c);
	TellWidened(o.effects, c);
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
