// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/effects.h"

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "effects/fixed_blades.h"
#include "effects/rim_fit.h"
#include "model/names.h"
#include "solve/held_out_corners.h"
#include "base/robust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

/// Below this an effect is not told from noise.
const double SIGNIFICANT = 2;

const double NOT_KNOWN = std::numeric_limits<double>::quiet_NaN();

double Sigmas(const Estimate& e) { return e.sigma > 0 ? std::abs(e.value) / e.sigma : 0; }

double SigmasOfBoth(const std::array<Estimate, 2>& e) { return SigmasOfTwo(std::pow(Sigmas(e[0]), 2) + std::pow(Sigmas(e[1]), 2)); }

using Values = std::vector<std::pair<std::string, Estimate>>;

Values DistortionValues(const Geometry& g)
{
	Values values;
	for (size_t k = 0; k < 5; ++k)
		if (g.distortion_sigma[k] > 0)
			values.emplace_back(DISTORTION_NAMES[k], Estimate{ g.distortion[k], g.distortion_sigma[k] });
	return values;
}

Values CurvatureValues(const Estimate& C) { return { { "C per mm", C } }; }

double MostSigmas(const Values& values)
{
	double most = 0;
	for (const auto& [name, value] : values)
		most = std::max(most, Sigmas(value));
	return most;
}

Effect DistortionOf(const Calibration& c, const EffectChoice& choice)
{
	const Geometry& g = c.MainGeometry();
	Effect e;
	e.unit = "px, places of corners left out";
	if (c.solution.model == Model::PAPER)
		e.failure = "the paper's model has no effects";
	else if (choice.Excludes(EffectId::DISTORTION))
		e.failure = "the lens was solved without it";
	else if (g.distortion_terms == 0)
		e.failure = "no coefficient is significant and lowers the reprojection error";
	if (!e.failure.empty())
		return e;
	e.values = DistortionValues(g);
	e.sigmas = MostSigmas(e.values);
	e.held_out_without = CornersLeftOut(c.task, { 0, LensNormals(g), g.shared_poses });
	e.held_out_with = CornersLeftOut(c.task, { g.distortion_terms, LensNormals(g), g.shared_poses });
	return e;
}

Effect CurvatureOf(const Calibration& c, const EffectChoice& choice)
{
	Effect e;
	e.unit = "px, blur of photographs left out";
	e.held_out_without = c.compared ? c.compared->plane.held_out_px : 0;
	e.held_out_with = c.compared ? c.compared->curved.held_out_px : c.solution.model == Model::CURVED ? c.solution.held_out_px : 0;
	if (c.solution.model == Model::CURVED)
		e.values = CurvatureValues(c.solution.field_curvature);
	else if (c.solution.model == Model::PAPER)
		e.failure = "the paper's model has no effects";
	else if (choice.Excludes(EffectId::FIELD_CURVATURE))
		e.failure = "the lens was solved without it";
	else if (!c.compared)
		e.failure = fmt::format("`model` {} has none", NameOf(c.solution.model));
	else if (!c.compared->curved.failure.empty())
		e.failure = c.compared->curved.failure;
	else
		e.values = CurvatureValues(c.compared->curved.field_curvature);
	e.sigmas = MostSigmas(e.values);
	return e;
}

std::string SecondRimText(const SecondRim& second)
{
	if (second.why.empty())
		return "";
	std::string text = fmt::format("second rim {}: {}", second.used ? "written" : "not written", second.why);
	if (second.held_out_with > 0)
		text += fmt::format("; {:.1f} sigma; error {:.4g} without, {:.4g} with it (sigmas of brightness and places of edges, photographs left out)", second.sigmas, second.held_out_without, second.held_out_with);
	return text;
}

/// One kind of vignetting, with or without the other beside it.
Effect VignettingOf(const Calibration& c, bool optical, bool beside)
{
	const Vignetting& v = c.vignetting;
	Effect e;
	e.unit = v.flat_field ? "share of the light, flat fields left out" : "share of the light, photographs left out";
	e.failure = v.failure;
	const FalloffAnswer& with = v.answers[optical ? FalloffKind(beside, true) : FalloffKind(true, beside)];
	const FalloffAnswer& without = v.answers[optical ? FalloffKind(beside, false) : FalloffKind(false, beside)];
	e.held_out_without = without.held_out;
	e.held_out_with = with.held_out;
	if (e.failure.empty() && (!with.fitted || !without.fitted))
		e.failure = "the fit of the brightness did not converge";
	e.sigmas = optical ? with.rim_sigmas : NOT_KNOWN;
	if (e.failure.empty() && optical && !with.rim_seen)
		e.failure = "no patch is darker than without a rim";
	if (!optical || !e.failure.empty())
		return e;
	for (size_t k = 0; k < with.rims.size(); ++k)
	{
		e.values.emplace_back(k ? fmt::format("R{} mm", k + 1) : "R mm", with.rims[k].radius_mm);
		e.values.emplace_back(k ? fmt::format("Z{} mm", k + 1) : "Z mm", with.rims[k].distance_mm);
	}
	e.values.emplace_back("darkening at most", with.darkening);
	e.note = SecondRimText(with.second);
	return e;
}

/// One kind of chromatic aberration, of red and of blue, and how edges left out are predicted.
Effect ChromaticOf(const Calibration& c, const char* letter, const char* per, const char* unit, const std::array<Estimate, 2>& values, double held_out_without, double held_out_with)
{
	Effect e;
	e.unit = unit;
	e.failure = c.chromatic.failure;
	e.values = { { fmt::format("{} red{}", letter, per), values[0] }, { fmt::format("{} blue{}", letter, per), values[1] } };
	e.sigmas = SigmasOfBoth(values);
	e.held_out_without = held_out_without;
	e.held_out_with = held_out_with;
	return e;
}

Effect BladesOf(const Calibration& c)
{
	Effect e;
	e.sigmas = NOT_KNOWN;
	if (c.task.blades.count == 0)
		e.failure = "photographs of edges do not tell them: give `fix` blades=N";
	else
		e.values = { { "blades", { double(c.task.blades.count), 0 } }, { "rotation deg", { c.task.blades.rotation_deg, 0 } }, { "curvature", { c.task.blades.curvature, 0 } } };
	return e;
}

/// What speaks against the effect; empty when nothing does.
std::string Against(const Effect& e)
{
	if (!e.failure.empty())
		return e.failure;
	if (e.id == EffectId::BLADES)
		return "";
	if (e.sigmas < (e.id == EffectId::VIGNETTING_OPTICAL ? SIGNIFICANT_RIM : SIGNIFICANT))
		return fmt::format("{:.1f} sigma: not significant", e.sigmas);
	if (!(e.held_out_with > 0) || !(e.held_out_without > 0))
		return e.id == EffectId::FIELD_CURVATURE ? "" : "nothing can be left out to be predicted: photograph more";
	if (!(e.held_out_with < e.held_out_without))
		return "what was left out is not predicted better with it";
	return "";
}

/// Sets used and why. Throws Refused where the choice names what could not be estimated.
void Decide(const EffectChoice& choice, Effect& e)
{
	const std::string against = Against(e);
	if (choice.kind == EffectChoice::AUTO)
	{
		e.used = against.empty();
		e.why = !against.empty() ? against : e.id == EffectId::BLADES ? "given by `fix`" : "significant, and predicts better";
		return;
	}
	e.used = choice.Wants(e.id) && e.failure.empty();
	e.why = choice.Excludes(e.id) ? "not in `effects`" : !e.failure.empty() ? e.failure : against.empty() ? "asked for by `effects`" : "asked for by `effects`, although: " + against;
	if (choice.kind == EffectChoice::LIST && choice.Wants(e.id) && !e.failure.empty())
		throw Refused(fmt::format("`effects`: {} could not be estimated: {}", NameOf(e.id), e.failure));
}

/// The models have been compared already (CurvatureIsSeen, which wants 1 %), or one was asked for.
void DecideCurvature(const EffectChoice& choice, const Calibration& c, Effect& e)
{
	Decide(choice, e);
	e.used = c.solution.model == Model::CURVED;
	if (choice.kind == EffectChoice::AUTO && e.used && !c.compared)
		e.why = "asked for by `model` curved";
	else if (choice.kind == EffectChoice::AUTO && !e.used && Against(e).empty())
		e.why = "predicts hardly better";
}

Effect Named(Effect e, EffectId id)
{
	e.id = id;
	return e;
}

/// Both kinds of vignetting, each judged beside the other where that is used; of one alone the one that predicts better.
void DecideVignetting(const EffectChoice& choice, Calibration& c)
{
	Effect natural = Named(VignettingOf(c, false, true), EffectId::VIGNETTING_NATURAL), optical = Named(VignettingOf(c, true, true), EffectId::VIGNETTING_OPTICAL);
	Decide(choice, optical);
	if (!optical.used)
		natural = Named(VignettingOf(c, false, false), EffectId::VIGNETTING_NATURAL);
	Decide(choice, natural);
	if (!natural.used)
	{
		optical = Named(VignettingOf(c, true, false), EffectId::VIGNETTING_OPTICAL);
		Decide(choice, optical);
	}
	else if (choice.kind == EffectChoice::AUTO && !optical.used)
	{
		// The natural fall-off of a thin lens is too strong for glass whose exit pupil is the larger one: rims alone may be nearer to the truth.
		Effect alone = Named(VignettingOf(c, true, false), EffectId::VIGNETTING_OPTICAL);
		Decide(choice, alone);
		if (alone.used && alone.held_out_with < natural.held_out_with)
		{
			optical = alone;
			natural.used = false;
			natural.why = "optical vignetting alone predicts better";
		}
	}
	c.effects.push_back(natural);
	c.effects.push_back(optical);
}

std::string ValueText(const Effect& e)
{
	std::string out;
	for (const auto& [name, value] : e.values)
		out += fmt::format("{}{} {:.4g}{}", out.empty() ? "" : ", ", name, value.value, value.sigma > 0 ? fmt::format(" +- {:.2g}", value.sigma) : "");
	return out.empty() || !e.failure.empty() ? "-" : out;
}

}

EffectChoice ParseEffects(const std::string& text)
{
	EffectChoice choice;
	if (text == "auto" || text == "all")
	{
		choice.kind = text == "all" ? EffectChoice::ALL : EffectChoice::AUTO;
		return choice;
	}
	choice.kind = EffectChoice::LIST;
	if (text == "none")
		return choice;
	for (size_t at = 0; at <= text.size();)
	{
		const size_t comma = std::min(text.find(',', at), text.size());
		const std::string name = text.substr(at, comma - at);
		const std::optional<EffectId> effect = EffectNamed(name);
		if (!effect)
			throw UsageError(fmt::format("`effects` {}: there is no '{}'; give auto, all, none, or some of {}, separated by commas", text, name, EffectNames()));
		choice.listed.insert(*effect);
		at = comma + 1;
	}
	return choice;
}

void ChooseEffects(const EffectChoice& choice, Calibration& c)
{
	c.effects = { Named(DistortionOf(c, choice), EffectId::DISTORTION), Named(CurvatureOf(c, choice), EffectId::FIELD_CURVATURE) };
	Decide(choice, c.effects[0]);
	DecideCurvature(choice, c, c.effects[1]);
	DecideVignetting(choice, c);
	const Chromatic& chromatic = c.chromatic;
	const Effect lateral = ChromaticOf(c, "C", "", "px, shift of edges of photographs left out", chromatic.lateral,
		chromatic.lateral_held_out_without, chromatic.lateral_held_out_with);
	const Effect axial = ChromaticOf(c, "A", " per mm", "px, difference in blur of edges of photographs left out", chromatic.axial_per_mm,
		chromatic.axial_held_out_without, chromatic.axial_held_out_with);
	for (Effect e : { Named(lateral, EffectId::CHROMATIC_LATERAL), Named(axial, EffectId::CHROMATIC_AXIAL), Named(BladesOf(c), EffectId::BLADES) })
	{
		Decide(choice, e);
		c.effects.push_back(e);
	}
}

void TellWidened(const EffectChoice& choice, Calibration& c)
{
	for (Effect& e : c.effects)
	{
		const bool curvature = e.id == EffectId::FIELD_CURVATURE;
		if (!e.used || !(curvature || e.id == EffectId::DISTORTION))
			continue;
		e.values = curvature ? CurvatureValues(c.solution.field_curvature) : DistortionValues(c.MainGeometry());
		e.sigmas = MostSigmas(e.values);
		if (choice.kind == EffectChoice::AUTO && e.sigmas < SIGNIFICANT && !(curvature && !c.compared))
			e.why = fmt::format("significant by edges alone, and predicts better; by all that is told {:.1f} sigma", e.sigmas);
	}
}

bool Uses(const Calibration& c, EffectId effect)
{
	return std::any_of(c.effects.begin(), c.effects.end(), [&](const Effect& e) { return e.id == effect && e.used; });
}

const FalloffAnswer& FalloffOf(const Calibration& c)
{
	const bool natural = Uses(c, EffectId::VIGNETTING_NATURAL), optical = Uses(c, EffectId::VIGNETTING_OPTICAL);
	return c.vignetting.answers[natural || optical ? FalloffKind(natural, optical) : FalloffKind(true, true)];
}

const FalloffAnswer& RimOf(const Calibration& c)
{
	return Uses(c, EffectId::VIGNETTING_OPTICAL) ? FalloffOf(c) : c.vignetting.answers[FalloffKind(true, true)];
}

std::vector<RimEstimate> WrittenRims(const Calibration& c)
{
	return Uses(c, EffectId::VIGNETTING_OPTICAL) ? RimOf(c).rims : std::vector<RimEstimate>{};
}

std::string EffectsText(const Calibration& c)
{
	std::string out = "\neffects:\n";
	for (const Effect& e : c.effects)
	{
		out += fmt::format("  {:<19} {:<11} {}\n", NameOf(e.id), e.used ? "written" : "not written", e.why);
		if (e.failure.empty() && !e.values.empty())
			out += fmt::format("  {:<19} {}{}\n", "", ValueText(e), std::isfinite(e.sigmas) && e.sigmas > 0 ? fmt::format(": {:.1f} sigma", e.sigmas) : "");
		if (e.failure.empty() && e.held_out_with > 0)
			out += fmt::format("  {:<19} error {:.4g} without, {:.4g} with it ({})\n", "", e.held_out_without, e.held_out_with, e.unit);
		if (!e.note.empty())
			out += fmt::format("  {:<19} {}\n", "", e.note);
	}
	return out;
}

}
