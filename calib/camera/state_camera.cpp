// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/state_camera.h"

#include "model/names.h"
#include "model/thin_lens_of_real.h"
#include "model/state_names.h"
#include <tiltcal/error.h>
#include "base/files.h"
#include "base/plain_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include "lens/optical_vignetting.h"
#include "lens/words.h"

#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

using Json = nlohmann::ordered_json;

const double INFINITY_MM = std::numeric_limits<double>::infinity();

/// A value of the file that knows where it stands, for the errors.
struct Node
{
	const Json* json;
	std::string file, path;

	[[noreturn]] void Fail(const std::string& what) const
	{
		throw FileError(fmt::format("{}: {} {}; give the calibration.json that tiltcal calibrate or import wrote", file, path, what));
	}
	Node operator[](const std::string& key) const
	{
		const std::string name = path.empty() ? key : path + "." + key;
		if (!json->is_object() || !json->contains(key))
			Node{ json, file, name }.Fail("is missing");
		return { &(*json)[key], file, name };
	}
	Node At(size_t i) const { return { &(*json)[i], file, fmt::format("{}[{}]", path, i) }; }
	void NeedList(size_t length) const
	{
		if (!json->is_array() || (length && json->size() != length))
			Fail(length ? fmt::format("is no list of {} values", length) : "is no list");
	}
	std::string Text() const
	{
		if (!json->is_string())
			Fail("is no text");
		return json->get<std::string>();
	}
	double Number() const
	{
		if (!json->is_number())
			Fail("is no number");
		return json->get<double>();
	}
	/// calibration.json writes null for what is infinite or unknown.
	double NumberOr(double otherwise) const { return json->is_null() ? otherwise : Number(); }
	double Positive() const
	{
		const double x = Number();
		if (!(x > 0))
			Fail(fmt::format("is {}, not above 0", x));
		return x;
	}
	bool Flag() const
	{
		if (!json->is_boolean())
			Fail("is neither true nor false");
		return json->get<bool>();
	}
	int Pixels() const { return Whole(1, MOST_PIXELS_A_SIDE, "is no number of pixels"); }
	int Whole(long least, long most, const std::string& why) const
	{
		if (!json->is_number_integer() || json->get<long>() < least || json->get<long>() > most)
			Fail(why);
		return json->get<int>();
	}
};

Json Parse(const std::string& file)
{
	const std::string text = ReadText(file, "the calibration.json of tiltcal calibrate");
	try
	{
		return Json::parse(text);
	}
	catch (const Json::exception& e)
	{
		throw FileError(fmt::format("{}: is not JSON ({})", file, OneLine(std::string(e.what()).substr(0, 200))));
	}
}

/// The node of the state called `name`, or of the first.
Node FindState(const Node& top, const std::string& name)
{
	const Node states = top["states"];
	states.NeedList(0);
	std::string names;
	for (size_t i = 0; i < states.json->size(); ++i)
	{
		const Node state = states.At(i);
		const std::string its_name = state["name"].Text();
		if (name.empty() || its_name == name || its_name == WithUnderscores(name))
			return state;
		names += (i ? ", " : "") + its_name;
	}
	if (names.empty())
		states.Fail("is empty");
	throw UsageError(fmt::format("`state` {}: {} has the states {}", name, top.file, OneLine(names)));
}

bool Used(const Node& effects, EffectId effect)
{
	for (size_t i = 0; i < effects.json->size(); ++i)
		if (effects.At(i)["name"].Text() == NameOf(effect))
			return effects.At(i)["used"].Flag();
	return false;
}

std::array<double, 2> Pair(const Node& node, const char* first, const char* second) { return { node[first].Number(), node[second].Number() }; }

/// Old files have the first one only.
std::vector<std::array<double, 2>> ReadRims(const Node& optical)
{
	if (!optical.json->contains("rims"))
		return { Pair(optical, "radius_mm", "distance_mm") };
	const Node list = optical["rims"];
	list.NeedList(0);
	if (list.json->empty() || list.json->size() > size_t(tilt_lens::MostRims))
		list.Fail(fmt::format("has {} rims, not 1 to {}", list.json->size(), tilt_lens::MostRims));
	std::vector<std::array<double, 2>> rims;
	for (size_t i = 0; i < list.json->size(); ++i)
		rims.push_back(Pair(list.At(i), "radius_mm", "distance_mm"));
	return rims;
}

/// What the list `effects` says is used. Files of import, and old ones, have none.
void ReadEffects(const Node& top, StateCamera& c)
{
	if (!top.json->contains("effects"))
		return;
	const Node effects = top["effects"];
	effects.NeedList(0);
	c.natural_vignetting = Used(effects, EffectId::VIGNETTING_NATURAL);
	if (Used(effects, EffectId::VIGNETTING_OPTICAL))
		c.rims_mm = ReadRims(top["vignetting"]["optical"]);
	if (Used(effects, EffectId::CHROMATIC_LATERAL))
		c.lateral = Pair(top["chromatic"], "lateral_red", "lateral_blue");
	if (Used(effects, EffectId::CHROMATIC_AXIAL))
		c.axial_per_mm = Pair(top["chromatic"], "axial_red_per_mm", "axial_blue_per_mm");
	if (!Used(effects, EffectId::BLADES))
		return;
	const Node blades = top["blades"];
	c.blades = { blades["count"].Whole(tilt_lens::FewestBlades, tilt_lens::MostBlades, fmt::format("is no whole number from {} to {}", tilt_lens::FewestBlades, tilt_lens::MostBlades)), blades["rotation_deg"].Number(), blades["curvature"].Number() };
	c.aperture_diameter_mm *= blades["aperture_diameter_mm"].Positive() / top["aperture_diameter_mm"].Positive();
}

/// Where U cannot be told from infinity, it is null, and 1/U has all that is known. Files of import have U only.
double ReadFocus(const Node& state)
{
	const Node distance = state["focus_distance_mm"];
	if (!distance.json->is_null() || !state.json->contains("inverse_focus_per_mm"))
		return distance.NumberOr(INFINITY_MM);
	const Node q = state["inverse_focus_per_mm"];
	q.NeedList(3);
	return 1 / q.At(2).Number();
}

Json NumberOrNull(double x) { return std::isfinite(x) ? Json(x) : Json(); }

/// What has the thin camera that is written: the one without distortion, where that is no effect. Files of import, and old ones, have one alone.
Node ThinFit(const Node& top)
{
	const bool bare = top.json->contains("effects") && top.json->contains("render") && !Used(top["effects"], EffectId::DISTORTION);
	return bare ? top["render"] : top;
}

StateCamera ThinCamera(const Node& top, const std::string& name)
{
	const Node fit = ThinFit(top), state = FindState(fit, name);
	StateCamera c;
	c.state = state["name"].Text();
	c.model = fit[fit.json->contains("thin_model") ? "thin_model" : "model"].Text();
	const Node size = top["image_size_px"];
	size.NeedList(2);
	c.width = size.At(0).Pixels();
	c.height = size.At(1).Pixels();
	c.pitch_mm = top["pixel_pitch_mm"].Positive();
	c.image_distance_mm = fit["image_distance_mm"].Positive();
	const Node centre = state["principal_point_px"];
	centre.NeedList(2);
	c.principal_point = { centre.At(0).Number(), centre.At(1).Number() };
	for (size_t k = 0; k < 5; ++k)
		c.distortion[k] = fit["distortion"][DISTORTION_NAMES[k]].Number();
	// The thin camera's, where the file's answer is a real lens.
	const Node thin = state.json->contains("thin") ? state["thin"] : state;
	const Node tilt = thin["lens_tilt_deg"];
	c.lens_tilt_deg = tilt.Number();
	if (!(std::abs(c.lens_tilt_deg) < 90))
		tilt.Fail(fmt::format("is {}, not between -90 and 90", c.lens_tilt_deg));
	c.tilt_direction_deg = thin["tilt_direction_deg"].Number();
	c.focus_distance_mm = ReadFocus(state);
	c.aperture_diameter_mm = fit["aperture_diameter_mm"].NumberOr(0);
	c.field_curvature_per_mm = fit["field_curvature_per_mm"].NumberOr(0);
	ReadEffects(top, c);
	return c;
}

/// False where it is not there.
bool IsTrue(const Node& of, const char* flag)
{
	return of.json->contains(flag) && of[flag].Flag();
}

/// `lens`: real_lens or scene_lens, which may be left out or have failed.
bool IsUsed(const Node& top, const char* lens)
{
	return top.json->contains(lens) && IsTrue(top[lens], "used");
}

}

StateCamera ReadStateCamera(const std::string& file, const std::string& name)
{
	const Json json = Parse(file);
	return ThinCamera({ &json, file, "" }, name);
}

bool TakesRealLens(const std::string& file)
{
	const Json json = Parse(file);
	const Node top{ &json, file, "" };
	return IsUsed(top, "real_lens") && IsUsed(top, "scene_lens");
}

std::optional<StateCamera> ReadRealLensCamera(const std::string& file, const std::string& name)
{
	const Json json = Parse(file);
	const Node top{ &json, file, "" };
	if (!IsUsed(top, "real_lens"))
		return std::nullopt;
	StateCamera c = ThinCamera(top, name);
	const bool scene = IsUsed(top, "scene_lens");
	const Node lens = top[scene ? "scene_lens" : "real_lens"], states = lens["states"];
	states.NeedList(0);
	for (size_t i = 0; i < states.json->size(); ++i)
	{
		const Node state = states.At(i);
		if (state["name"].Text() != c.state)
			continue;
		CameraAberrations a{ lens["pupil_magnification"].Positive(), lens["focal_length_mm"].Positive(), 0, {} };
		a.radius_mm = 0.5 * a.focal_length_mm / lens["f_stop_of_aberrations"].Positive();
		a.etendue = IsTrue(lens, "etendue");
		const double unit = a.focal_length_mm / 1000;
		for (size_t k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
			a.mm[k] = lens["aberrations"][tilt_lens::AberrationWords[k]].Number() * unit;
		if (lens["aberrations"].json->contains("fifth_order"))
		{
			const Node fifth = lens["aberrations"]["fifth_order"];
			fifth.NeedList(tilt_lens::FifthOrderTerms);
			for (size_t k = 0; k < tilt_lens::FifthOrderTerms; ++k)
				a.mm[tilt_lens::ThirdOrderTerms + k] = fifth.At(k).Number() * unit;
		}
		if (lens.json->contains("rims"))
		{
			const Node rims = lens["rims"];
			rims.NeedList(0);
			for (size_t k = 0; k < rims.json->size() && k < c.rims_mm.size(); ++k)
				c.rims_mm[k] = { rims.At(k)["radius_mm"].Positive(), rims.At(k)["distance_mm"].Number() };
		}
		c.model = "lens";
		c.aperture_diameter_mm *= lens["aperture_diameter_mm"].Positive() / ThinFit(top)["aperture_diameter_mm"].Positive();   // blades widen both
		c.image_distance_mm = state["exit_pupil_to_sensor_mm"].Positive() / a.pupil_magnification;
		const Node centre = state["principal_point_px"];
		centre.NeedList(2);
		c.principal_point = { centre.At(0).Number(), centre.At(1).Number() };
		c.lens_tilt_deg = state["lens_tilt_deg"].Number();
		c.tilt_direction_deg = state["tilt_direction_deg"].Number();
		const Vec3<double> n = c.LensNormal();
		c.focus_distance_mm = FocusOfThinLens(PowerOfThinLens(a.pupil_magnification, 1 / a.focal_length_mm, n.z, c.image_distance_mm), n.z, c.image_distance_mm);
		c.distortion = {};
		c.field_curvature_per_mm = 0;
		c.aberrations = a;
		return c;
	}
	states.Fail(fmt::format("has no state {}", OneLine(c.state)));
}

std::string StateCameraJson(const StateCamera& c, const std::string& source)
{
	Json json;
	json["model"] = c.model;
	json["source"] = source;
	json["image_distance_mm"] = c.image_distance_mm;
	json["aperture_diameter_mm"] = c.aperture_diameter_mm > 0 ? Json(c.aperture_diameter_mm) : Json();
	json["principal_point_px"] = c.principal_point;
	for (size_t k = 0; k < 5; ++k)
		json["distortion"][DISTORTION_NAMES[k]] = c.distortion[k];
	json["distortion_axis"] = "lens axis";
	json["field_curvature_per_mm"] = c.field_curvature_per_mm;
	const Vec3<double> n = c.LensNormal();
	json["states"] = { { { "name", c.state }, { "lens_tilt_deg", c.lens_tilt_deg }, { "tilt_direction_deg", c.tilt_direction_deg },
		{ "lens_normal", { n.x, n.y, n.z } }, { "focus_distance_mm", NumberOrNull(c.focus_distance_mm) }, { "principal_point_px", c.principal_point } } };
	json["image_size_px"] = { c.width, c.height };
	json["pixel_pitch_mm"] = c.pitch_mm;
	json["frames"] = "camera: x right, y up, z forward; pixel centres at integers, (0, 0) top left";
	json["program"] = "tiltcal " TILTCAL_VERSION;
	// A file name may be in another encoding than JSON's.
	return json.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

}
