// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_lens.h"

#include "camera/camera_block.h"
#include "report/html.h"
#include "report/scene_parts.h"

#include <tiltcal/camera.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace tiltcal
{

namespace
{

using nlohmann::json;

json List(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

/// The words of the effects, each of its lines without the indentation and the comment.
json EffectWords(const StateCamera& camera)
{
	json words = json::array();
	std::istringstream lines(EffectLines(camera, PlainNumbers(1), {}));
	for (std::string line; std::getline(lines, line);)
		if (const size_t at = line.find_first_not_of('\t'); at != std::string::npos)
			words.push_back(line.substr(at));
	return words;
}

json Boards(const SceneParts& scene)
{
	json boards = json::array();
	for (size_t p = 0; p < scene.boards.size(); ++p)
	{
		json outline = json::array();
		for (const Vec3<double>& P : scene.boards[p].outline)
			outline.push_back(List(P));
		boards.push_back({{"name", std::to_string(p + 1)}, {"colour", html::PhotoColour(p)}, {"outline", outline}});
	}
	return boards;
}

}

std::string LensOfState(const Calibration& c, size_t state)
{
	const StateCamera camera = CameraOfState(c, state);
	const SceneParts scene = MakeScene(c, state);
	const double width = camera.width * camera.pitch_mm, height = camera.height * camera.pitch_mm;
	// The middle of the picture, seen from the axis.
	const Vec3<double>&a = scene.corner_rays[0], &b = scene.corner_rays[2];
	const double w = scene.w;
	const json lens = {
		{"inverse_focus", List(scene.q)}, {"image_distance", w}, {"aperture_diameter", scene.d}, {"field_curvature", scene.field_curvature},
		{"right", {width, 0}}, {"up", {0, height}}, {"skew", {0, 0}}, {"shift", {w * (a.x + b.x) / 2, w * (a.y + b.y) / 2}}, {"sensor_is_window", true},
		{"location", {0, 0, 0}}, {"axes", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"drive", "lens"}, {"hold", "image_distance"}, {"pixels", {camera.width, camera.height}},
		{"other_words", EffectWords(camera)}, {"remarks", json::array({fmt::format("in a camera of right {:.10g}*x  up {:.10g}*y, in mm", width, height)})},
		{"unit", "mm"}, {"far", scene.far}, {"boards", Boards(scene)}};
	return lens.dump();
}

}
