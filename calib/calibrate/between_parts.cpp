// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/between_parts.h"
#include "calibrate/left_over.h"

#include "lens/angles.h"
#include "lens/optics.h"
#include "model/pose_difference.h"
#include "model/predict.h"
#include "model/thin_lens_of_real.h"
#include "model/tilt_angles.h"
#include "solve/each_edge.h"
#include "solve/half_of_edges.h"
#include "solve/solve_joint.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

/// A difference, and what a part scatters by itself.
struct Distance
{
	double apart, scatter;
};

/// The farthest of the parts, beyond what it scatters, in quadrature to `sigma`. distance: of a part from the whole.
template<typename Of>
void Widen(const std::vector<PartAnswer>& parts, Of distance, double& sigma)
{
	double farthest = 0;
	for (const PartAnswer& part : parts)
	{
		Distance d = distance(part);
		d = { part.share * d.apart, part.chance > 0 ? std::sqrt(part.chance) * d.scatter : 0 };
		// A focus at infinity is no distance to compare.
		if (std::isfinite(d.apart) && std::isfinite(d.scatter))
			farthest = std::max(farthest, d.apart * d.apart - d.scatter * d.scatter);
	}
	sigma = std::sqrt(sigma * sigma + farthest);
}

/// The plane of focus itself, and U by it: one number has one sigma.
void WidenPlane(const StateLens& whole, size_t state, const std::vector<PartAnswer>& parts, StateLens& told)
{
	for (double Vec3<double>::* axis : { &Vec3<double>::x, &Vec3<double>::y, &Vec3<double>::z })
		Widen(parts, [&](const PartAnswer& part)
		{
			const StateLens& other = part.solution.states[state];
			return Distance{ other.q.*axis - whole.q.*axis, other.q_sigma.*axis };
		}, told.q_sigma.*axis);
	TellFocusDistance(told);
}

void WidenTilt(const StateLens& whole, size_t state, const std::vector<PartAnswer>& parts, StateLens& told)
{
	const auto widen = [&](auto distance, double& sigma) { Widen(parts, [&](const PartAnswer& part) { return distance(part.solution.states[state]); }, sigma); };
	for (Estimate StateLens::* angle : { &StateLens::lens_tilt, &StateLens::focal_plane_tilt })
		widen([&](const StateLens& part) { return Distance{ DifferenceOfTilts(whole, part, angle).along, (part.*angle).sigma }; }, (told.*angle).sigma);
	if (const double tilt = whole.lens_tilt.value; tilt != 0)
		widen([&](const StateLens& part) { return Distance{ DifferenceOfTilts(whole, part, &StateLens::lens_tilt).aside / tilt * DEGREES, part.tilt_direction.sigma }; },
			told.tilt_direction.sigma);
}

}

std::vector<PartAnswer> SolveParts(const Calibration& c, int& without_answer, bool by_place_alone)
{
	std::vector<PartAnswer> parts;
	// The board's size moves parts and whole alike: it is in the sigmas of the whole, and no scatter of a part.
	Task task = c.task;
	task.board.square_sigma_mm = 0;
	const double chance = MoreThanNoiseIsLeftOver(c) ? 1 : 2;
	std::vector<double> blurs;
	ForEachEdge(task, [&](size_t s, size_t p, const Edge& e) { blurs.push_back(PredictedBlur(c, s, p, e)); });
	std::vector<EdgeSubset> halves = FourHalvesOfEdges(task, blurs);
	halves.resize(by_place_alone ? 2 : halves.size());
	for (const EdgeSubset& half : halves)
	{
		PartAnswer part{ c.geometry, c.solution, chance };
		if (RefineJointly(WithEdges(task, half), Refinement::EDGES, part.geometry, part.solution))
			parts.push_back(part);
		else
			++without_answer;
	}
	return parts;
}

void WidenByPupils(Solution& told, double known)
{
	const double w = told.w_mm.value, m = PUPIL_MAGNIFICATION_SIGMA;
	const auto widen = [&](double thin_power, double normal_z, Estimate& f)
	{
		const double by_pupils = std::hypot(f.sigma, 0.5 * (FocalLengthOfReal(1 + m, thin_power, normal_z, w) - FocalLengthOfReal(1 - m, thin_power, normal_z, w)));
		f.sigma = std::max(f.sigma, std::min(by_pupils, known));
	};
	widen(1 / told.focal_length.value, 1, told.focal_length);
	for (StateLens& state : told.states)
		widen(1 / state.focal_length.value, tilt_lens::LensFromPlane(state.q, 1 / w).normal.z, state.focal_length);
}

void WidenByParts(const Solution& whole, const std::vector<PartAnswer>& parts, Solution& told)
{
	const auto widen = [&](auto number)
	{
		Widen(parts, [&](const PartAnswer& part) { return Distance{ number(part.solution).value - number(whole).value, number(part.solution).sigma }; }, number(told).sigma);
	};
	for (Estimate Solution::* number : { &Solution::w_mm, &Solution::focal_length, &Solution::aperture_diameter, &Solution::psf_floor_px, &Solution::psf_floor_squared, &Solution::field_curvature,
		&Solution::tangential_curvature, &Solution::sagittal_curvature })
		widen([number](auto& s) -> auto& { return s.*number; });
	for (size_t k = 0; k < told.stop_ratios.size(); ++k)
		widen([k](auto& s) -> auto& { return s.stop_ratios[k]; });
	for (size_t k = 0; k < told.states.size(); ++k)
	{
		widen([k](auto& s) -> auto& { return s.states[k].focal_length; });
		WidenPlane(whole.states[k], k, parts, told.states[k]);
		WidenTilt(whole.states[k], k, parts, told.states[k]);
	}
	if (!told.states.empty())
		told.focus_distance.sigma = told.states[0].focus_distance.sigma;
}

void WidenPlacesByParts(const Geometry& whole, const std::vector<PartAnswer>& parts, Geometry& told)
{
	for (size_t k = 0; k < told.distortion.size(); ++k)
		if (told.distortion_sigma[k] > 0)   // else it is held
			Widen(parts, [&](const PartAnswer& part) { return Distance{ part.geometry.distortion[k] - whole.distortion[k], part.geometry.distortion_sigma[k] }; }, told.distortion_sigma[k]);
	for (size_t s = 0; s < told.states.size(); ++s)
	{
		StateGeometry& state = told.states[s];
		const StateGeometry& own = whole.states[s];
		const auto widen = [&](auto distance, double& sigma) { Widen(parts, [&](const PartAnswer& part) { return distance(part.geometry.states[s]); }, sigma); };
		for (size_t axis = 0; axis < 2; ++axis)
			widen([&](const StateGeometry& part) { return Distance{ part.principal_point[axis] - own.principal_point[axis], part.principal_point_sigma[axis] }; }, state.principal_point_sigma[axis]);
		for (double Vec3<double>::* axis : { &Vec3<double>::x, &Vec3<double>::y, &Vec3<double>::z })
			widen([&](const StateGeometry& part) { return Distance{ part.lens_centre.*axis - own.lens_centre.*axis, part.lens_centre_sigma.*axis }; }, state.lens_centre_sigma.*axis);
		for (size_t p = 0; p < state.poses.size(); ++p)
			for (size_t k = 0; k < 6; ++k)
				widen([&](const StateGeometry& part) { return Distance{ FromPoseTo(own.poses[p], part.poses[p])[k], part.pose_sigmas[p][k] }; }, state.pose_sigmas[p][k]);
	}
}

}
