// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/state_camera.h"

#include "lens/angles.h"
#include "effects/effects.h"
#include "effects/fixed_blades.h"
#include "lens/field_curvature.h"
#include "lens/optics.h"
#include "model/picture_view.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

void AddEffects(const Calibration& c, StateCamera& camera)
{
	camera.natural_vignetting = Uses(c, EffectId::VIGNETTING_NATURAL);
	for (const RimEstimate& rim : WrittenRims(c))
		camera.rims_mm.push_back({ rim.radius_mm.value, rim.distance_mm.value });
	const auto values = [](const std::array<Estimate, 2>& e) { return TwoNumbers{ e[0].value, e[1].value }; };
	if (Uses(c, EffectId::CHROMATIC_LATERAL))
		camera.lateral = values(c.chromatic.lateral);
	if (Uses(c, EffectId::CHROMATIC_AXIAL))
		camera.axial_per_mm = values(c.chromatic.axial_per_mm);
	if (!Uses(c, EffectId::BLADES))
		return;
	// The circle through the corners of blades is wider than the disc that was fitted.
	const double widening = WideningForBlades(c.task.blades);
	camera.blades = c.task.blades;
	camera.aperture_diameter_mm *= widening;
	camera.sigma.aperture_diameter_mm *= widening;
}

}

StateCamera CameraOfFit(const Task& task, const Solution& solution, const Geometry& geometry, size_t s)
{
	const StateLens& lens = solution.states[s];
	const StateGeometry& state = geometry.states[s];
	StateCamera c;
	c.state = task.states[s].name;
	c.model = NameOf(solution.model);
	c.width = task.width;
	c.height = task.height;
	c.pitch_mm = task.pitch_mm;
	const auto take = [](const Estimate& e, double& value, double& sigma)
	{
		value = e.value;
		sigma = e.sigma;
	};
	take(solution.w_mm, c.image_distance_mm, c.sigma.image_distance_mm);
	take(solution.aperture_diameter, c.aperture_diameter_mm, c.sigma.aperture_diameter_mm);
	take(solution.field_curvature, c.field_curvature_per_mm, c.sigma.field_curvature_per_mm);
	take(solution.psf_floor_px, c.psf_floor_px, c.sigma.psf_floor_px);
	take(lens.lens_tilt, c.lens_tilt_deg, c.sigma.lens_tilt_deg);
	take(lens.tilt_direction, c.tilt_direction_deg, c.sigma.tilt_direction_deg);
	take(lens.focal_plane_tilt, c.focal_plane_tilt_deg, c.sigma.focal_plane_tilt_deg);
	take(lens.focus_distance, c.focus_distance_mm, c.sigma.focus_distance_mm);
	take(lens.focal_length, c.focal_length_mm, c.sigma.focal_length_mm);
	c.principal_point = state.principal_point;
	c.sigma.principal_point = state.principal_point_sigma;
	c.distortion = geometry.distortion;
	c.sigma.distortion = geometry.distortion_sigma;
	c.lens_centre_mm = state.lens_centre;
	c.sigma.lens_centre_mm = state.lens_centre_sigma;
	return c;
}

StateCamera CameraOfState(const Calibration& c, size_t s, Distorted distorted)
{
	if (s >= c.solution.states.size())
		throw UsageError(fmt::format("there is no state {}; the calibration has {}, counted from 0", s, c.solution.states.size()));
	const bool bare = distorted == Distorted::NO || !Uses(c, EffectId::DISTORTION);
	StateCamera camera = bare ? CameraOfFit(c.task, c.render, c.RenderGeometry(), s) : CameraOfFit(c.task, c.solution, c.MainGeometry(), s);
	AddEffects(c, camera);
	return camera;
}

Vec3<double> StateCamera::LensNormal() const
{
	const double radians = tilt_lens::Pi / 180;
	return tilt_lens::LensNormalFromTilt(lens_tilt_deg * radians, tilt_direction_deg * radians);
}

Vec3<double> StateCamera::PlaneOfFocus() const
{
	return tilt_lens::PlaneFromLensTilt(LensNormal(), 1 / image_distance_mm, 1 / focus_distance_mm);
}

PictureView PictureViewOf(const StateCamera& c) { return { c.ImageDistancePx(), c.distortion, c.principal_point, c.LensNormal() }; }

std::optional<Point> Project(const StateCamera& c, const Vec3<double>& P) { return PixelOf(PictureViewOf(c), P); }

std::optional<Vec3<double>> Unproject(const StateCamera& c, const Point& pixel) { return DirectionOf(PictureViewOf(c), pixel); }

std::string FoldWarning(const StateCamera& c)
{
	const std::optional<Point> fold = FirstFold(PictureViewOf(c), c.width, c.height);
	return fold ? fmt::format("state {}: the distortion turns back inside the picture: pixel ({:.0f}, {:.0f}) sees nothing, and POV-Ray refuses this camera", c.state, (*fold)[0], (*fold)[1]) : "";
}

double BlurWidth(const StateCamera& c, const Vec3<double>& P)
{
	if (!c.KnowsFocus())
		return std::numeric_limits<double>::quiet_NaN();
	const double kappa_z = tilt_lens::InverseFocusDistanceOnBowl(c.PlaneOfFocus(), c.field_curvature_per_mm, c.LensNormal(), P);
	return c.ImageDistancePx() * c.aperture_diameter_mm * std::abs(1 - kappa_z) / P.z;
}

std::optional<std::vector<Point>> Footprint(const StateCamera& c, const Vec3<double>& P, size_t count)
{
	const Vec3<double> n = c.LensNormal(), q = c.PlaneOfFocus();
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	std::vector<Point> outline;
	if (!c.KnowsFocus())
		return std::nullopt;
	for (size_t i = 0; i < count; ++i)
	{
		const double angle = 2 * tilt_lens::Pi * double(i) / double(count), radius = 0.5 * c.aperture_diameter_mm;
		const Vec3<double> S = radius * std::cos(angle) * basis.a + radius * std::sin(angle) * basis.b;
		// The ray S + t (v - kappa(v) S) meets P: with V = t v, V = P - (1 - kappa(V)) S. Every step leaves d |q| / 2 of the error, some 1e-2.
		Vec3<double> V = P;
		for (int step = 0; step < 100; ++step)
		{
			const Vec3<double> last = V;
			V = P - (1 - tilt_lens::InverseFocusDistanceOnBowl(q, c.field_curvature_per_mm, n, V)) * S;
			if (Dot(V - last, V - last) <= 1e-30 * Dot(P, P))
				break;
		}
		const std::optional<Point> pixel = Project(c, V);
		if (!pixel)
			return std::nullopt;
		outline.push_back(*pixel);
	}
	return outline;
}

}
