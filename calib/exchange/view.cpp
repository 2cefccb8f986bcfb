// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/view.h"

#include "exchange/maps.h"
#include "exchange/scene_files.h"
#include "model/projection.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Farther than any scene: planes of focus beyond are at infinity, mm.
const double FAR_MM = 1e9;

Vec3<double> Unit(const Vec3<double>& v) { return (1 / std::sqrt(Dot(v, v))) * v; }

}

View ViewOf(const StateCamera& c)
{
	View view;
	view.width_mm = c.width * c.pitch_mm;
	view.height_mm = c.height * c.pitch_mm;
	const Point shift = ShiftOfPicture(c.width, c.height, c.principal_point);
	view.shift_x_mm = shift[0] * c.pitch_mm;
	view.shift_y_mm = shift[1] * c.pitch_mm;
	view.centre = { view.shift_x_mm / c.image_distance_mm, view.shift_y_mm / c.image_distance_mm, 1 };
	view.focus_depth_mm = FocusDepth(c, view.centre);
	if (!c.KnowsFocus())
		return view;
	const Vec3<double> q = c.PlaneOfFocus();
	const double inverse = std::sqrt(Dot(q, q));
	if (!(inverse > 1 / FAR_MM))
		return view;
	view.has_plane = true;
	const double along = Dot(q, view.centre);
	const bool ahead = along > 1 / FAR_MM;
	const Vec3<double> about = ahead ? (1 / along) * view.centre : (1 / (inverse * inverse)) * q;
	// Two directions in the plane: one level as far as it can be.
	const Vec3<double> n = Unit(q), level = Unit(std::abs(n.y) < 0.9 ? Cross(Vec3<double>{ 0, 1, 0 }, n) : Cross(Vec3<double>{ 0, 0, 1 }, n)), rising = Cross(n, level);
	const double half = std::sqrt(Dot(about, about)) * view.width_mm / c.image_distance_mm;
	const auto corner = [&](double x, double y) { return about + x * half * level + y * half * rising; };
	view.square = { corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1) };
	view.in_focus = { about, corner(1, 0), corner(0, 1) };
	return view;
}

std::string SceneName(const StateCamera& camera)
{
	std::string name = "tiltcal_";
	for (const char c : camera.state)
		name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
	return name;
}

std::string LostBlades(const StateCamera& camera, int most)
{
	const FixedBlades& b = camera.blades;
	return b.count > most ? fmt::format(", the {} blades (a disc instead)", b.count) : b.count ? fmt::format(", rotation and curvature of the {} blades", b.count) : "";
}

std::string SceneNumber(double value) { return fmt::format("{:.15g}", value); }

}
