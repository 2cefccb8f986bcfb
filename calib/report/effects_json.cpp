// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/effects_json.h"

#include "effects/effects.h"
#include "lens/words.h"
#include "model/names.h"

namespace tiltcal
{

Json EffectsJson(const Calibration& c)
{
	Json list = Json::array();
	for (const Effect& e : c.effects)
		list.push_back({ { "name", NameOf(e.id) }, { "used", e.used }, { "sigmas", e.failure.empty() ? PositiveOrNull(e.sigmas) : Json() }, { "held_out_without", PositiveOrNull(e.held_out_without) },
			{ "held_out_with", PositiveOrNull(e.held_out_with) }, { "unit", e.unit }, { "why", e.why } });
	return list;
}

Json VignettingJson(const Calibration& c)
{
	const Vignetting& v = c.vignetting;
	const FalloffAnswer& a = FalloffOf(c);
	Json json;
	if (!v.failure.empty())
		return { { "failure", v.failure } };
	json["natural"] = Uses(c, EffectId::VIGNETTING_NATURAL);
	if (const FalloffAnswer& rim = RimOf(c); rim.rim_seen)
	{
		Put(json["optical"], "radius", "_mm", rim.radius_mm);
		Put(json["optical"], "distance", "_mm", rim.distance_mm);
		Put(json["optical"], "darkening", "", rim.darkening);
		json["optical"]["used"] = Uses(c, EffectId::VIGNETTING_OPTICAL);
		for (const RimEstimate& r : rim.rims)
		{
			Json& entry = json["optical"]["rims"].emplace_back();
			Put(entry, "radius", "_mm", r.radius_mm);
			Put(entry, "distance", "_mm", r.distance_mm);   // < 0: behind the lens
		}
		if (!rim.second.why.empty())
			json["optical"]["second"] = { { "used", rim.second.used }, { "sigmas", PositiveOrNull(rim.second.sigmas) }, { "held_out_sigmas_without", PositiveOrNull(rim.second.held_out_without) },
				{ "held_out_sigmas_with", PositiveOrNull(rim.second.held_out_with) }, { "why", rim.second.why } };
	}
	json["told_by"] = v.flat_field ? "flat fields" : "white squares";
	json["patches"] = a.points.size();
	json["rms_percent"] = 100 * a.rms;
	const char* const kinds[] = { "none", "natural", "optical", "both" };
	for (size_t k = 0; k < v.answers.size(); ++k)
		json["held_out_percent"][kinds[k]] = PositiveOrNull(100 * v.answers[k].held_out);
	json["gains"] = Json::array();
	for (const FalloffGain& g : a.gains)
		json["gains"].push_back({ { "state", c.task.states[g.state].name },
			{ "file", v.flat_field ? c.task.flat_fields[g.photo].file : c.task.states[g.state].photos[g.photo].file }, { "gain", g.gain } });
	return json;
}

Json ChromaticJson(const Calibration& c)
{
	if (!c.chromatic.failure.empty())
		return { { "failure", c.chromatic.failure } };
	Json json;
	Put(json, "lateral_red", "", c.chromatic.lateral[0]);
	Put(json, "lateral_blue", "", c.chromatic.lateral[1]);
	Put(json, "axial_red", "_per_mm", c.chromatic.axial_per_mm[0]);
	Put(json, "axial_blue", "_per_mm", c.chromatic.axial_per_mm[1]);
	json["edges"] = c.chromatic.edges;
	return json;
}

Json RealLensJson(const Calibration& c, const RealLens& lens)
{
	Json json;
	if (!lens.failure.empty())
	{
		json["failure"] = lens.failure;
		return json;
	}
	Put(json, "focal_length", "_mm", lens.focal_length_mm);
	Put(json, "aperture_diameter", "_mm", lens.aperture_diameter_mm);
	if (!lens.stop_ratios.empty())
		json["stops"] = StopsJson(c.task.stops, lens.stop_ratios, lens.aperture_diameter_mm.value);
	Put(json, "opening_on_axis", "_mm", lens.opening_on_axis_mm);
	Put(json, "pupil_magnification", "", lens.pupil_magnification);
	Put(json, "psf_floor_squared", "_px2", lens.psf_floor_squared);
	json["f_stop_of_aberrations"] = 0.5 * lens.focal_length_mm.value / lens.radius_mm;
	json["etendue"] = true;
	for (size_t k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		Put(json["aberrations"], tilt_lens::AberrationWords[k], "", lens.PerMille(k));
	for (size_t k = tilt_lens::ThirdOrderTerms; lens.fifth_order && k < lens.aberrations_mm.size(); ++k)
	{
		json["aberrations"]["fifth_order"].push_back(lens.PerMille(k).value);
		json["aberrations"]["fifth_order_sigma"].push_back(lens.PerMille(k).sigma);
	}
	json["rims"] = Json::array();
	for (const RimEstimate& rim : lens.rims)
	{
		Json one;
		Put(one, "radius", "_mm", rim.radius_mm);
		Put(one, "distance", "_mm", rim.distance_mm);
		json["rims"].push_back(one);
	}
	for (size_t s = 0; s < lens.states.size(); ++s)
	{
		const RealLensState& state = lens.states[s];
		Json one{ { "name", c.task.states[s].name } };
		PutTilt(one, state.lens);
		Put(one, "exit_pupil_to_sensor", "_mm", state.image_distance_mm);
		one["principal_point_px"] = state.principal_point;
		one["principal_point_sigma_px"] = state.principal_point_sigma;
		json["states"].push_back(one);
	}
	json["covariance"] = CovarianceJson(lens.covariance);
	json["sigma_by_photographs"] = SigmasByPhotographs(lens.covariance);
	json["rms_place_px"] = lens.rms_place;
	json["rms_blur_px"] = lens.rms_blur;
	if (lens.rms_shape)
	{
		json["rms_asymmetry"] = (*lens.rms_shape)[0];
		json["rms_hollowness"] = (*lens.rms_shape)[1];
	}
	json["held_out"] = PositiveOrNull(lens.held_out);
	json[lens.fifth_order ? "held_out_six" : "held_out_thin"] = PositiveOrNull(lens.held_out_thin);
	json["used"] = lens.used;
	return json;
}

}
