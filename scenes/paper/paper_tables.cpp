// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_tables.h"

#include "paper_published.h"

#include <tiltcal/error.h>
#include "base/files.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace paper
{

namespace
{

std::string Calibration(const Run& run, const std::string& folder) { return run.out + "/" + folder + "/calibration.json"; }

const Json& StateOf(const Json& calibration, const std::string& name)
{
	for (const Json& state : calibration.at("states"))
		if (state.at("name") == name)
			return state;
	throw tiltcal::FileError("a calibration.json has no state " + name);
}

/// { value, sigma } of name_unit and name_sigma_unit.
Json Estimate(const Json& from, const std::string& name, const std::string& unit)
{
	return { { "value", from.at(name + unit) }, { "sigma", from.at(name + "_sigma" + unit) } };
}

Json Only(double value) { return { { "value", value }, { "sigma", nullptr } }; }

/// Of anything that has states.
Json TiltsOf(const Json& calibration)
{
	Json states;
	for (const char* const state : { "plus5", "minus5" })
		states[state] = Estimate(StateOf(calibration, state), "lens_tilt", "_deg");
	return states;
}

/// What the whole run took, by the clock.
Json SecondsOf(const Run& run, const std::string& model)
{
	return std::stod(tiltcal::ReadText(run.out + "/models/" + model + "/seconds.txt", "a number of seconds"));
}

Json LensOf(const Json& calibration)
{
	const Json w = Estimate(calibration, "image_distance", "_mm"), d = Estimate(calibration, "aperture_diameter", "_mm"),
		u = Estimate(calibration, "focus_distance", "_mm"), f = Estimate(calibration, "focal_length", "_mm");
	return { { "image_distance_mm", w }, { "aperture_diameter_mm", d }, { "focus_distance_mm", u }, { "focal_length_mm", f } };
}

Json LineErrors(const std::string& file)
{
	const Json json = ReadJson(file);
	return { { "red", json.at("lines").at(0).at("mean_abs_error") }, { "green", json.at("lines").at(1).at("mean_abs_error") },
		{ "picture", json.at("mean_abs_error") } };
}

}

Json ReadJson(const std::string& file)
{
	try
	{
		return Json::parse(tiltcal::ReadText(file, "a JSON file"));
	}
	catch (const nlohmann::json::exception& e)
	{
		throw tiltcal::FileError(fmt::format("{}: {}", file, e.what()));
	}
}

Json TiltTable(const Run& run)
{
	Json table;
	const Json camera = ReadJson(run.camera);
	for (const char* const state : { "plus5", "minus5" })
		table["true"][state] = camera.at("states").at(state).at("tilt_deg");
	Json published;
	for (const Published& p : PUBLISHED)
		if (p.tilt_deg != 0)
			published[p.state] = Only(p.tilt_deg);
	const auto add = [&](const char* name, const Json& states) { table["methods"].push_back({ { "name", name }, { "states", states } }); };
	add("published", published);
	for (const char* const model : { "paper", "rigid", "plane", "curved", "photometric" })
	{
		add(model, TiltsOf(ReadJson(Calibration(run, std::string("models/") + model))));
		table["methods"].back()["seconds"] = SecondsOf(run, model);
	}
	const Json calibration = ReadJson(Calibration(run, "demo/calibration"));
	add("default", TiltsOf(calibration));
	table["methods"].back()["seconds"] = SecondsOf(run, "default");
	table["default_model"] = calibration.at("model");
	if (calibration.contains("scene_lens"))
		add("scene_lens", TiltsOf(calibration.at("scene_lens")));
	if (calibration.at("tilt_told_by").contains("geometry_alone"))
	{
		Json states;
		for (const char* const state : { "plus5", "minus5" })
			states[state] = Estimate(calibration.at("tilt_told_by").at("geometry_alone").at(state), "lens_tilt", "_deg");
		add("geometry", states);
	}
	return table;
}

Json LensTable(const Run& run)
{
	Json table;
	table["published"] = { { "image_distance_mm", Only(PUBLISHED_IMAGE_DISTANCE_MM) }, { "aperture_diameter_mm", Only(PUBLISHED_APERTURE_MM) },
		{ "focus_distance_mm", Only(PUBLISHED_FOCUS_DISTANCE_MM) } };
	table["paper"] = LensOf(ReadJson(Calibration(run, "models/paper")));
	table["default"] = LensOf(ReadJson(Calibration(run, "demo/calibration")));
	const Json camera = ReadJson(run.camera);
	const double f = camera.at("nominal_focal_length_mm"), n = camera.at("f_number");
	table["nominal"] = { { "aperture_diameter_mm", Only(f / n) }, { "focal_length_mm", Only(f) } };
	if (std::filesystem::exists(run.photos + "/truth.json"))
	{
		const Json truth = ReadJson(run.photos + "/truth.json");
		table["prescription"] = { { "image_distance_mm", Only(truth.at("effective_image_distance_w")) },
			{ "aperture_diameter_mm", Only(truth.at("entrance_pupil_diameter")) },
			{ "focus_distance_mm", Only(truth.at("focus_distance_U_from_entrance_pupil")) }, { "focal_length_mm", Only(truth.at("efl")) } };
	}
	return table;
}

Json BrightnessTable(const Run& run)
{
	Json table;
	for (const Published& p : PUBLISHED)
	{
		const std::string profile = run.out + "/demo/profiles/" + p.state;
		table[p.state] = { { "published", { { "red", p.red }, { "green", p.green } } }, { "gain", LineErrors(profile + "-gain.json") },
			{ "shading", LineErrors(profile + "-shading.json") } };
	}
	return table;
}

Json EffectTable(const Run& run)
{
	// The sets of effect-shares.cmake, and how it names them.
	static const struct { const char *set, *title; } sets[] = { { "none", "no effect: w, d, a plane of focus" }, { "distortion", "distortion" },
		{ "distortion+field_curvature", "… and field curvature" }, { "distortion+field_curvature+vignetting_natural", "… and natural vignetting" },
		{ "auto", "… and rims before and behind the lens: all that is significant" }, { "real", "the real lens instead" } };
	Json table = Json::array();
	const auto add = [&](const std::string& title, const std::string& folder, const std::string& suffix)
	{
		Json row{ { "title", title } };
		for (const char* const state : STATES)
			row["states"][state] = LineErrors(run.out + "/" + folder + "/" + state + suffix + ".json");
		table.push_back(row);
	};
	add("the paper's method: w, U, d and tilt by (3), (4), (1)", "paper-method", "-gain");
	for (const auto& [set, title] : sets)
		add(title, std::string("effects/") + set, "");
	return table;
}

bool IsUsed(const Json& calibration, const char* lens)
{
	return calibration.contains(lens) && calibration.at(lens).value("used", false);
}

Json ClosedLoopTable(const Run& run)
{
	const Json start = ReadJson(Calibration(run, "demo/calibration")), found = ReadJson(Calibration(run, "closed/calibration"));
	// The camera that photographed is the real lens for scenes, where there is one, else the thin lens; its tilts are its own.
	const bool scene = IsUsed(start, "scene_lens");
	Json table;
	table["model"] = found.at("model");
	const auto add = [&](const std::string& name, const std::string& what, const std::string& unit, const Json& a, const Json& b, const std::string& key)
	{
		table["numbers"].push_back({ { "name", name }, { "what", what }, { "unit", unit }, { "true", a.at(key + unit) }, { "found", b.at(key + unit) },
			{ "sigma", b.at(key + "_sigma" + unit) } });
	};
	for (const char* const state : { "plus5", "minus5" })
	{
		const Json &own = StateOf(scene ? start.at("scene_lens") : start, state), &camera = own.contains("thin") ? own.at("thin") : own;
		add(std::string("tilt_") + state, std::string("lens tilt, ") + state, "_deg", camera, StateOf(found, state), "lens_tilt");
		add(std::string("direction_") + state, std::string("its direction, ") + state, "_deg", camera, StateOf(found, state), "tilt_direction");
	}
	// Numbers of one kind of lens say little of the other's.
	if (scene != IsUsed(found, "real_lens"))
		return table;
	if (scene)
	{
		const Json &camera = start.at("scene_lens"), &lens = found.at(IsUsed(found, "scene_lens") ? "scene_lens" : "real_lens");
		add("f", "focal length f", "_mm", camera, lens, "focal_length");
		add("d", "aperture d", "_mm", camera, lens, "aperture_diameter");
		add("m", "pupil magnification m", "", camera, lens, "pupil_magnification");
		add("exit_pupil", "exit pupil to sensor", "_mm", StateOf(camera, "untilted"), StateOf(lens, "untilted"), "exit_pupil_to_sensor");
		return table;
	}
	add("w", "image distance w", "_mm", start, found, "image_distance");
	add("d", "aperture d", "_mm", start, found, "aperture_diameter");
	add("U", "focus distance U", "_mm", start, found, "focus_distance");
	add("C", "field curvature C", "_per_mm", start, found, "field_curvature");
	return table;
}

Json PupilTable(const Run& run)
{
	const Json calibration = ReadJson(Calibration(run, "demo/calibration"));
	Json table;
	for (const char* const state : { "plus5", "minus5" })
	{
		const Json& s = StateOf(calibration, state);
		table["lens_centre_mm"][state] = { { "value", s.at("lens_centre_mm") }, { "sigma", s.at("lens_centre_sigma_mm") } };
		table["principal_point_px"][state] = { { "value", s.at("principal_point_px") }, { "sigma", s.at("principal_point_sigma_px") } };
	}
	table["principal_point_px"]["untilted"] = { { "value", calibration.at("principal_point_px") }, { "sigma", calibration.at("principal_point_sigma_px") } };
	const Json& evidence = calibration.at("tilt_told_by");
	if (evidence.contains("geometry_alone") && evidence.at("geometry_alone").contains("pupil_magnification"))
		table["pupil_magnification"] = Estimate(evidence.at("geometry_alone"), "pupil_magnification", "");
	const Json& vignetting = calibration.at("vignetting");
	if (vignetting.contains("optical"))
		for (const Json& rim : vignetting.at("optical").at("rims"))
			table["rims"].push_back({ { "radius", Estimate(rim, "radius", "_mm") }, { "distance", Estimate(rim, "distance", "_mm") } });
	for (const char* const name : { "field_curvature", "tangential_curvature", "sagittal_curvature" })
		if (calibration.contains(std::string(name) + "_per_mm"))
			table[name] = Estimate(calibration, name, "_per_mm");
	table["psf_floor_px"] = Estimate(calibration, "psf_floor", "_px");
	table["rms_blur_px"] = calibration.at("rms_blur_px");
	if (std::filesystem::exists(run.photos + "/truth.json"))
	{
		const Json truth = ReadJson(run.photos + "/truth.json");
		table["prescription"]["pupil_magnification"] = double(truth.at("exit_pupil_diameter")) / double(truth.at("entrance_pupil_diameter"));
		for (const char* const state : { "plus5", "minus5" })   // frame E has y down
		{
			const auto pupil = truth.at("states").at(state).at("entrance_pupil_E").get<std::vector<double>>();
			table["prescription"]["lens_centre_mm"][state] = { pupil.at(0), -pupil.at(1), pupil.at(2) };
		}
	}
	return table;
}

}
