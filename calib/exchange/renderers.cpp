// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/scene_files.h"

#include "base/plain_text.h"
#include "exchange/view.h"
#include "lens/angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Where nothing in front is in focus, or infinity is: farther than any scene, units.
const double FARTHEST_FOCUS = 1e8;

double FocusDistance(const View& view, double unit_mm)
{
	const double distance = view.focus_depth_mm / unit_mm;
	return distance > 0 && distance < FARTHEST_FOCUS ? distance : FARTHEST_FOCUS;
}

double FullAngle(double side_mm, double image_distance_mm) { return 2 * std::atan(0.5 * side_mm / image_distance_mm) * 180 / tilt_lens::Pi; }

}

std::string RenderManText(const StateCamera& c, double unit_mm)
{
	const View view = ViewOf(c);
	// RenderMan's screen has the shorter side from -1 to 1, and fov is its angle.
	const double half = 0.5 * std::min(view.width_mm, view.height_mm);
	const auto screen = [&](double shift, double side, double sign) { return SceneNumber((shift + sign * 0.5 * side) / half); };
	std::string out = fmt::format("# The camera of state {}, by tiltcal {}. Units: {} mm. It stands at the world's origin, x right, y up, z forward.\n"
		"# Not in it: the distortion (tiltcal export --stmap), field curvature, rims, blades. PxrCamera finds the tilt from focus1 to focus3, which are\n"
		"# points of the world: where the camera is moved, they are to be moved with it.\n"
		"Format {} {} 1\nScreenWindow {} {} {} {}\n",
		OneLine(c.state), TILTCAL_VERSION, SceneNumber(unit_mm), c.width, c.height, screen(view.shift_x_mm, view.width_mm, -1), screen(view.shift_x_mm, view.width_mm, 1),
		screen(view.shift_y_mm, view.height_mm, -1), screen(view.shift_y_mm, view.height_mm, 1));
	if (c.KnowsFocus())
		out += fmt::format("DepthOfField {} {} {}    # f-number, image distance, depth in focus in the picture's centre\n", SceneNumber(c.image_distance_mm / c.aperture_diameter_mm),
			SceneNumber(c.image_distance_mm / unit_mm), SceneNumber(FocusDistance(view, unit_mm)));
	out += fmt::format("Projection \"PxrCamera\" \"float fov\" [{}]", SceneNumber(FullAngle(2 * half, c.image_distance_mm)));
	for (size_t k = 0; view.has_plane && k < 3; ++k)
	{
		const Vec3<double>& P = view.in_focus[k];
		out += fmt::format(" \"point focus{}\" [{} {} {}]", k + 1, SceneNumber(P.x / unit_mm), SceneNumber(P.y / unit_mm), SceneNumber(P.z / unit_mm));
	}
	return out + "\n";
}

std::string ArnoldText(const StateCamera& c, double unit_mm)
{
	const View view = ViewOf(c);
	const double x = 2 * view.shift_x_mm / view.width_mm, y = 2 * view.shift_y_mm / view.height_mm;
	const std::string name = SceneName(c);
	std::string out = fmt::format("# The camera of state {}, by tiltcal {}. Units: {} mm. It stands at the world's origin and looks along -z, y up.\n"
		"# Not in it: the tilt of the plane of focus (lens_tilt_angle's signs and unit are not documented), field curvature, rims{}. Distortion: connect an image of the -redistort STMap\n"
		"# (tiltcal export --stmap) to uv_remap.\n"
		"options\n{{\n xres {}\n yres {}\n pixel_aspect_ratio 1\n camera \"{}\"\n}}\n\n"
		"persp_camera\n{{\n name {}\n fov {}\n screen_window_min {} {}\n screen_window_max {} {}\n",
		OneLine(c.state), TILTCAL_VERSION, SceneNumber(unit_mm), LostBlades(c, c.blades.count), c.width, c.height, name, name, SceneNumber(FullAngle(view.width_mm, c.image_distance_mm)), SceneNumber(x - 1),
		SceneNumber(y - 1), SceneNumber(x + 1), SceneNumber(y + 1));
	if (c.KnowsFocus())
	{
		out += fmt::format(" focus_distance {}\n flat_field_focus on\n aperture_size {}\n", SceneNumber(FocusDistance(view, unit_mm)), SceneNumber(0.5 * c.aperture_diameter_mm / unit_mm));
		if (c.blades.count > 0)
			out += fmt::format(" aperture_blades {}\n", c.blades.count);
	}
	return out + "}\n";
}

}
