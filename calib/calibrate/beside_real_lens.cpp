// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/beside_real_lens.h"

#include "lens/aberrations.h"
#include "lens/angles.h"
#include "model/pose_difference.h"
#include "model/tilt_angles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace tiltcal
{

namespace
{

/// `sigma` of `value` widened by the farthest of `others`; a focus at infinity is no distance to compare.
void Widen(const std::vector<double>& others, double value, double& sigma)
{
	double farthest = 0;
	for (const double other : others)
		if (std::isfinite(other) && std::isfinite(value))
			farthest = std::max(farthest, std::abs(other - value));
	sigma = std::hypot(sigma, farthest);
}

void Widen(const std::vector<double>& others, Estimate& told) { Widen(others, told.value, told.sigma); }

template<typename Number>
auto OfEach(const std::vector<const RealLens*>& lenses, Number number)
{
	std::vector<decltype(number(*lenses[0]))> numbers;
	for (const RealLens* lens : lenses)
		numbers.push_back(number(*lens));
	return numbers;
}

void WidenPoint(const std::vector<Point>& others, const Point& value, Point& sigma)
{
	for (size_t axis = 0; axis < value.size(); ++axis)
	{
		std::vector<double> along;
		for (const Point& other : others)
			along.push_back(other[axis]);
		Widen(along, value[axis], sigma[axis]);
	}
}

void WidenStops(const std::vector<Estimate>& others, std::vector<Estimate>& told)
{
	for (size_t k = 0; k < told.size(); ++k)
		Widen({ others[k].value }, told[k]);
}

/// What both lenses state of the glass and of where it stands: its exit pupil is m times as far as what the pictures tell.
void WidenGlass(const RealLens& other, RealLens& told)
{
	for (Estimate RealLens::* number : { &RealLens::focal_length_mm, &RealLens::pupil_magnification, &RealLens::aperture_diameter_mm, &RealLens::opening_on_axis_mm })
		Widen({ (other.*number).value }, told.*number);
	WidenStops(other.stop_ratios, told.stop_ratios);
	for (size_t s = 0; s < told.states.size(); ++s)
	{
		Widen({ other.states[s].image_distance_mm.value }, told.states[s].image_distance_mm);
		WidenPoint({ other.states[s].principal_point }, told.states[s].principal_point, told.states[s].principal_point_sigma);
	}
}

/// By that part of the distance.
void WidenTilt(const StateLens& other, double part, StateLens& told)
{
	const TiltDifference lens = DifferenceOfTilts(told, other, &StateLens::lens_tilt), plane = DifferenceOfTilts(told, other, &StateLens::focal_plane_tilt);
	told.lens_tilt.sigma = std::hypot(told.lens_tilt.sigma, part * lens.along);
	told.focal_plane_tilt.sigma = std::hypot(told.focal_plane_tilt.sigma, part * plane.along);
	if (told.lens_tilt.value != 0)
		told.tilt_direction.sigma = std::hypot(told.tilt_direction.sigma, part * lens.aside / told.lens_tilt.value * tilt_lens::DegreesPerRadian);
}

/// What stands for the fifth order in six numbers is in their third; with the fifth, light and places are shared out among numbers that six do not have.
void WidenFifth(const RealLens& six, RealLens& fifth)
{
	WidenGlass(six, fifth);
	for (size_t k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		Widen({ six.aberrations_mm[k].value }, fifth.aberrations_mm[k]);
	for (size_t i = 0; i < std::min(six.rims.size(), fifth.rims.size()); ++i)
	{
		Widen({ six.rims[i].radius_mm.value }, fifth.rims[i].radius_mm);
		Widen({ six.rims[i].distance_mm.value }, fifth.rims[i].distance_mm);
	}
	for (size_t s = 0; s < fifth.states.size(); ++s)
	{
		WidenTilt(six.states[s].lens, 1, fifth.states[s].lens);
		Widen({ six.states[s].lens.focal_length.value }, fifth.states[s].lens.focal_length);
	}
}

/// The openings by the thin lens's aperture too: what the stop leaves open grows with the field, and each lens makes another disc of it.
void WidenByEachOther(const Solution& thin, RealLens& six, std::optional<RealLens>& fifth)
{
	const auto by_thin = [&](RealLens& lens)
	{
		for (Estimate RealLens::* opening : { &RealLens::aperture_diameter_mm, &RealLens::opening_on_axis_mm })
			Widen({ thin.aperture_diameter.value }, lens.*opening);
		WidenStops(thin.stop_ratios, lens.stop_ratios);
	};
	if (fifth && fifth->failure.empty())
	{
		if (fifth->used)
			WidenGlass(*fifth, six);
		WidenFifth(six, *fifth);
		by_thin(*fifth);
	}
	by_thin(six);
}

/// Where the plane of focus lies that stands for the real lenses near their axes; along the sensor's normal where the whole opening is sharpest. U by it.
void WidenPlane(const std::vector<const RealLens*>& lenses, size_t s, StateLens& told)
{
	Widen(OfEach(lenses, [s](const RealLens& l) { return l.states[s].lens.q.x; }), told.q.x, told.q_sigma.x);
	Widen(OfEach(lenses, [s](const RealLens& l) { return l.states[s].lens.q.y; }), told.q.y, told.q_sigma.y);
	Widen(OfEach(lenses, [s](const RealLens& l) { return 1 / l.states[s].best_focus_mm; }), told.q.z, told.q_sigma.z);
	TellFocusDistance(told);
}

/// Where the boards stand, and the lens centres of the states.
void WidenPlaces(const std::vector<const RealLens*>& lenses, Geometry& told)
{
	for (size_t s = 0; s < told.states.size(); ++s)
	{
		StateGeometry& state = told.states[s];
		for (size_t p = 0; p < state.poses.size(); ++p)
			for (size_t k = 0; k < 6; ++k)
			{
				double farthest = 0;
				for (const RealLens* lens : lenses)
					if (p < lens->states[s].poses.size())
						farthest = std::max(farthest, std::abs(FromPoseTo(state.poses[p], lens->states[s].poses[p])[k]));
				state.pose_sigmas[p][k] = std::hypot(state.pose_sigmas[p][k], farthest);
			}
		if (s > 0 && told.shared_poses)
			for (double Vec3<double>::* axis : { &Vec3<double>::x, &Vec3<double>::y, &Vec3<double>::z })
				Widen(OfEach(lenses, [&](const RealLens& l) { return l.states[s].lens_centre_mm.*axis; }), state.lens_centre.*axis, state.lens_centre_sigma.*axis);
	}
}

}

void WidenTilts(Calibration& c)
{
	if (!c.SceneLensIsUsed())
		return;
	// The truth may be anywhere between the two: the root of the mean square of an even distribution.
	const double between = 1 / std::sqrt(3.0);
	for (size_t s = 0; s < c.real_lens->states.size(); ++s)
		WidenTilt(c.scene_lens->states[s].lens, between, c.real_lens->states[s].lens);
}

void WidenByRealLens(Calibration& c)
{
	if (!c.real_lens || !c.real_lens->used)
		return;
	const double opening = c.real_lens->aperture_diameter_mm.sigma;
	WidenByEachOther(c.solution, *c.real_lens, c.scene_lens);
	// The rims of six numbers are as large as the opening is.
	const double added = std::sqrt(std::max(0., std::pow(c.real_lens->aperture_diameter_mm.sigma, 2) - opening * opening)) / c.real_lens->aperture_diameter_mm.value;
	for (RimEstimate& rim : c.real_lens->rims)
		for (Estimate* number : { &rim.radius_mm, &rim.distance_mm })
			number->sigma = std::hypot(number->sigma, added * number->value);
	std::vector<const RealLens*> lenses{ &*c.real_lens };
	if (c.scene_lens && c.scene_lens->used)
		lenses.push_back(&*c.scene_lens);
	const std::vector<double> f = OfEach(lenses, [](const RealLens& l) { return l.focal_length_mm.value; });
	// Untilted, where the real lens's exit pupil stands before the point that the thin lens's axis meets.
	for (Geometry* told : { &c.geometry, &c.pinhole })
		WidenPoint(OfEach(lenses, [](const RealLens& l) { return l.states[0].principal_point; }), told->states[0].principal_point, told->states[0].principal_point_sigma);
	for (Solution* told : { &c.solution, &c.render })
	{
		Widen(f, told->focal_length);
		// It is the glass's, and no better known than of the lens that is the answer.
		told->focal_length.sigma = std::max(told->focal_length.sigma, c.real_lens->focal_length_mm.sigma);
		Widen(OfEach(lenses, [](const RealLens& l) { return l.opening_on_axis_mm.value; }), told->aperture_diameter);
		for (const RealLens* lens : lenses)
			WidenStops(lens->stop_ratios, told->stop_ratios);
		Widen(OfEach(lenses, [](const RealLens& l) { return l.states[0].image_distance_mm.value / l.pupil_magnification.value; }), told->w_mm);
		for (size_t s = 0; s < told->states.size(); ++s)
		{
			Widen(f, told->states[s].focal_length);
			told->states[s].focal_length.sigma = std::max(told->states[s].focal_length.sigma, c.real_lens->focal_length_mm.sigma);
			WidenPlane(lenses, s, told->states[s]);
			WidenTilt(c.real_lens->states[s].lens, 1, told->states[s]);
		}
		if (!told->states.empty())
			told->focus_distance.sigma = told->states[0].focus_distance.sigma;
	}
	for (Geometry* told : { &c.geometry, &c.pinhole })
		WidenPlaces(lenses, *told);
}

void WidenPlacesByImageDistance(Calibration& c)
{
	for (const auto& [solution, geometry] : { std::pair{ &c.solution, &c.geometry }, std::pair{ &c.render, &c.pinhole } })
		for (StateGeometry& state : geometry->states)
			for (size_t p = 0; p < state.poses.size(); ++p)
				state.pose_sigmas[p][5] = std::max(state.pose_sigmas[p][5], std::abs(state.poses[p][5]) * solution->w_mm.sigma / solution->w_mm.value);
}

}
