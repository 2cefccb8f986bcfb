// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Seeded random cases of optics.h and of ResolveTiltLens as JSON, for plane_page.py to hold the page's JavaScript against.

#include "lens/angles.h"
#include "lens/lens_text.h"
#include "lens/optics.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <random>

namespace
{

using namespace tilt_lens;
using nlohmann::json;

std::mt19937 generator(19);

double Between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator); }
Vec3d Anywhere(double size) { return { Between(-size, size), Between(-size, size), Between(-size, size) }; }
json List(const Vec3d& v) { return json::array({ v.x, v.y, v.z }); }

json Formulas()
{
	json cases = json::array();
	const auto add = [&](const char* name, json args, json value) { cases.push_back({ { "name", name }, { "args", std::move(args) }, { "value", std::move(value) } }); };
	for (int i = 0; i < 100; ++i)
	{
		const Vec3d a = Anywhere(2), b = Anywhere(5), v{ a.x, a.y, 1.0 }, n = LensNormalFromTilt(Between(-1.2, 1.2), Between(-4, 4));
		const double s = Between(-1.4, 1.4), phi = Between(-4, 4), inverse_w = Between(0.01, 3), inverse_U = Between(-0.5, 0.5), kappa = Between(-1, 1);
		const Vec3d q = PlaneFromLensTilt(n, inverse_w, inverse_U);
		const Lens<double> lens = LensFromPlane(b, inverse_w);
		const double power = ScaledLength(Vec3d{ q.x, q.y, 0.0 }) + Between(0.01, 2);
		const LensBasis<double> basis = BasisOfLensPlane(n);
		add("InverseFocusDistance", { List(a), List(v) }, InverseFocusDistance(a, v));
		add("RayDirection", { List(v), List(b), kappa }, List(RayDirection(v, b, kappa)));
		add("FocalPlaneDirection", { s, phi }, List(FocalPlaneDirection(s, phi)));
		add("PlaneAtDistance", { List(v), inverse_U }, List(PlaneAtDistance(v, inverse_U)));
		add("PlaneThroughPoint", { List(v), List({ b.x, b.y, 20.0 }) }, List(PlaneThroughPoint(v, Vec3d{ b.x, b.y, 20.0 })));
		add("LensNormalFromTilt", { s, phi }, List(LensNormalFromTilt(s, phi)));
		add("LensFromPlane", { List(b), inverse_w }, { { "normal", List(lens.normal) }, { "power", lens.power } });
		add("PlaneFromLens", { List(n), inverse_w, inverse_U }, List(PlaneFromLens(n, inverse_w, inverse_U)));
		add("PlaneFromLensTilt", { List(n), inverse_w, inverse_U }, List(q));
		add("InverseImageDistance", { List(q), power }, InverseImageDistance(q, power));
		add("SignedBlurWidth", { inverse_w, s, List(q), List({ b.x, b.y, 3.0 }) }, SignedBlurWidth(inverse_w, s, q, Vec3d{ b.x, b.y, 3.0 }));
		add("AngleFromAxis", json::array({ List(n) }), AngleFromAxis(n));
		add("TiltDirection", json::array({ List(a) }), TiltDirection(a));
		add("BasisOfLensPlane", json::array({ List(n) }), { { "a", List(basis.a) }, { "b", List(basis.b) } });
	}
	return cases;
}

/// Rays of the picture's corners in the camera's frame, z = 1.
json Corners(const CameraVectors& camera, const TiltLens& lens)
{
	const Vec3d x = Normalized(camera.right), y = Normalized(camera.up - Dot(x, camera.up) * x);
	json corners = json::array();
	for (const auto& [across, up] : { std::pair{ -0.5, 0.5 }, { 0.5, 0.5 }, { 0.5, -0.5 }, { -0.5, -0.5 } })
	{
		const Vec3d ray = lens.direction + across * camera.right + up * camera.up;
		const double depth = Dot(lens.axis, ray);
		corners.push_back({ Dot(x, ray) / depth, Dot(y, ray) / depth, 1 });
	}
	return corners;
}

/// A camera anywhere, sheared and mirrored at times, and one lens stated in one of the ways that the page knows.
json LensCase(int number)
{
	const char* const drives[] = { "lens", "plane", "point" };
	const int drive = number % 3;
	const bool holds_f = number % 2 == 0;
	const double w0 = Between(0.5, 60), size = Between(0.3, 1.5) * w0;
	const Vec3d away = Normalized(Anywhere(1)), x = Normalized(Cross(Vec3d{ 0.3, 1, 0.2 }, away)), y = Cross(away, x);
	const CameraVectors camera{ Anywhere(20), w0 * away + (0.1 * size) * x, (number % 5 ? size : -size) * x, (0.7 * size) * y + (number % 7 ? 0.0 : 0.1 * size) * x };
	LensSpec base;
	base.enabled = true;
	base.angle_given = number % 4 == 0;
	base.image_distance = w0;
	base.focal_distance = 10 * w0;
	TiltLens lens;
	std::string error;
	if (!ResolveTiltLens(base, camera, lens, error))
		return {};
	const std::string page = LensText(base, camera, lens, 100, 70);

	const double tilt = Between(-35, 35), direction = Between(-200, 200), f = w0 * Between(0.4, 1.3), U = (number % 9 ? 1 : -1) * w0 * std::exp(Between(-1.5, 4)), N = Between(1, 30);
	const double inverse_distance = number % 11 ? 1 / U : 0;
	const Vec3d point = camera.location + w0 * Anywhere(20), normal = Anywhere(1), shift{ Between(-0.2, 0.2) * w0, Between(-0.2, 0.2) * w0, 0 };
	LensSpec spec;
	spec.enabled = true;
	spec.angle_given = base.angle_given;
	spec.shift = shift;
	spec.f_stop = N;
	if (holds_f)
		spec.focal_length = f;
	else
		spec.image_distance = f;
	if (drive == 2)
	{
		spec.focal_plane_point = point;
		spec.focal_plane_normal = normal;
	}
	else
	{
		(drive ? spec.focal_plane_tilt : spec.lens_tilt) = tilt;
		spec.tilt_direction = direction;
		spec.focal_distance = 1 / inverse_distance;
	}
	const bool made = ResolveTiltLens(spec, camera, lens, error);
	json out = { { "camera", json::parse(page) }, { "made", made },
		{ "settings", { { "drive", drives[drive] }, { "hold", holds_f ? "focal_length" : "image_distance" }, { "focal_length", f }, { "image_distance", f }, { "tilt", tilt },
			{ "plane_tilt", tilt }, { "direction", direction }, { "inverse_distance", inverse_distance }, { "point", List(point) }, { "normal", List(normal) },
			{ "f_stop", N }, { "shift", { shift.x, shift.y } }, { "circle", w0 / 1500 } } } };
	if (made)
		out["lens"] = { { "q", List(lens.inverse_focus_camera) }, { "w", lens.image_distance }, { "f", 1 / lens.power }, { "d", lens.aperture_diameter }, { "normal", List(lens.normal_camera) },
			{ "corners", Corners(camera, lens) } };
	return out;
}

}

int main()
{
	json lenses = json::array();
	for (int number = 0; number < 600; ++number)
		lenses.push_back(LensCase(number));
	std::printf("%s\n", json{ { "formulas", Formulas() }, { "lenses", lenses } }.dump().c_str());
}
