// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/pupil_opening.h"

#include "lens/angles.h"
#include "lens/distortion.h"
#include "model/projection.h"
#include "model/rims_on_lens.h"

#include <tiltcal/calibrate.h>

#include "lens/field_curvature.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

/// What an arc of disc d from the angle a to b adds to the area and to its first moments: integrals of x dy / 2 - y dx / 2,
/// x^2 dy / 2 and -y^2 dx / 2.
void AddArc(const Disc& d, double a, double b, Opening& sum)
{
	const double r = d.radius, sine = std::sin(b) - std::sin(a), cosine = std::cos(a) - std::cos(b), turn = b - a;
	const auto cube = [](double x) { return x * x * x; };
	const double double_sine = (std::sin(2 * b) - std::sin(2 * a)) / 4;
	const double sine_cubed = cosine - (cube(std::cos(a)) - cube(std::cos(b))) / 3, cosine_cubed = sine - (cube(std::sin(b)) - cube(std::sin(a))) / 3;
	sum.area += 0.5 * r * (d.x * sine + d.y * cosine + r * turn);
	sum.x += 0.5 * r * (d.x * d.x * sine + 2 * d.x * r * (turn / 2 + double_sine) + r * r * cosine_cubed);
	sum.y += 0.5 * r * (d.y * d.y * cosine + 2 * d.y * r * (turn / 2 - double_sine) + r * r * sine_cubed);
}

/// The arcs of disc k's rim that lie within all the others, as pairs of angles. Of equal discs the first has the rim.
std::vector<std::pair<double, double>> ArcsWithin(const std::vector<Disc>& discs, size_t k)
{
	std::vector<std::pair<double, double>> arcs{ { -Pi, Pi } };
	const Disc& d = discs[k];
	for (size_t j = 0; j < discs.size() && !arcs.empty(); ++j)
	{
		const Disc& o = discs[j];
		const double dx = o.x - d.x, dy = o.y - d.y, distance = std::hypot(dx, dy);
		const bool inside = distance <= o.radius - d.radius && (distance > 0 || d.radius < o.radius || k < j);
		if (j == k || inside)
			continue;
		if (distance >= o.radius + d.radius || distance <= std::abs(o.radius - d.radius))
			return {};
		const double half = std::acos(std::clamp((distance * distance + (d.radius - o.radius) * (d.radius + o.radius)) / (2 * distance * d.radius), -1.0, 1.0));
		const double middle = std::atan2(dy, dx);
		std::vector<std::pair<double, double>> left;
		for (const auto& [from, to] : arcs)
			for (const double turn : { -2 * Pi, 0.0, 2 * Pi })
				if (std::max(from, middle - half + turn) < std::min(to, middle + half + turn))
					left.emplace_back(std::max(from, middle - half + turn), std::min(to, middle + half + turn));
		arcs = left;
	}
	return arcs;
}

}

Opening CommonOpening(const std::vector<Disc>& discs)
{
	Opening sum;
	for (size_t k = 0; k < discs.size(); ++k)
		for (const auto& [from, to] : ArcsWithin(discs, k))
			AddArc(discs[k], from, to, sum);
	if (!(sum.area > 0))
		return {};
	return { sum.area, sum.x / sum.area, sum.y / sum.area };
}

PixelView ViewOfPixel(const Calibration& c, size_t s, double u, double v)
{
	const Geometry& g = c.MainGeometry();
	const Vec3<double>& n = g.states[s].lens_normal;
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	PixelView view;
	view.n = n;
	view.pixel = { (u - g.states[s].principal_point[0]) / g.w_px, -(v - g.states[s].principal_point[1]) / g.w_px, 1 };
	view.v = tilt_lens::UndistortDirection(g.distortion.data(), basis.a, basis.b, n, view.pixel);
	view.kappa = tilt_lens::InverseFocusDistanceOnBowl(c.solution.states[s].q, c.solution.field_curvature.value, n, view.v);
	return view;
}

Opening OpeningOf(const PixelView& seen, double radius_of_reference, double image_distance, const std::vector<tilt_lens::Rim>& rims)
{
	const double lens_radius = radius_of_reference * seen.opening;
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(seen.n);
	std::vector<Disc> discs{ { 0, 0, lens_radius } };
	for (const RimOnLens& rim : RimsOnLens(seen.n, seen.v, seen.kappa, seen.pixel, image_distance, rims))
	{
		const double x = Dot(rim.centre, basis.a), y = Dot(rim.centre, basis.b);
		// Most rims leave most pixels alone.
		if (std::hypot(x, y) + lens_radius > rim.radius)
			discs.push_back({ x, y, rim.radius });
	}
	return CommonOpening(discs);
}

}
