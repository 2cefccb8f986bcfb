// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/fill_solution.h"

#include "model/lens_model.h"
#include "solve/named_covariance.h"
#include <tiltcal/error.h>
#include "model/tilt_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace tiltcal
{

namespace
{

using Number = LensCovariance::Number;

/// Correlations of w, d, U, C and the components of every tilt, q_x and q_y.
std::vector<Correlation> CorrelationsOf(const Task& task, LensModel model, const LensCovariance& c)
{
	using Axis = LensCovariance::Axis;
	struct Named
	{
		std::string name;
		LensCovariance::At at;
		double sign;
	};
	// 1/U falls when U grows.
	std::vector<Named> numbers{ { "image_distance", Number::IMAGE_DISTANCE, 1 }, { "aperture_diameter", Number::APERTURE_DIAMETER, 1 }, { "focus_distance", { 0, Axis::Z }, -1 } };
	if (IsCurved(model))
		numbers.push_back({ "field_curvature", Number::CURVATURE, 1 });
	for (size_t s = 1; s < task.states.size(); ++s)
	{
		numbers.push_back({ task.states[s].name + ".q_x", { s, Axis::X }, 1 });
		numbers.push_back({ task.states[s].name + ".q_y", { s, Axis::Y }, 1 });
	}
	std::vector<Correlation> all;
	for (size_t i = 0; i < numbers.size(); ++i)
		for (size_t j = i + 1; j < numbers.size(); ++j)
		{
			const Named &a = numbers[i], &b = numbers[j];
			const double variance = c.Variance(a.at) * c.Variance(b.at);
			if (variance > 0)
				all.push_back({ a.name, b.name, a.sign * b.sign * c(a.at, b.at) / std::sqrt(variance) });
		}
	return all;
}

}

void FillSolution(const Task& task, const Geometry& g, const BlurFit& fit, const Unknowns& x, const LensCovariance& of_fit, Solution& out)
{
	const double w = g.w_px * task.pitch_mm;
	std::vector<Vec3<double>> planes;
	for (size_t s = 0; s < x.state.size(); ++s)
		planes.push_back(fit.Plane(x, s));
	const LensCovariance c = WithBoardSize(of_fit, x, planes, task.board.square_sigma_mm / task.board.square_mm);
	out.covariance = Named(c, task);
	out.lens = fit.model;
	out.correlations = CorrelationsOf(task, fit.model, c);
	out.w_mm = { w, c.Sigma(Number::IMAGE_DISTANCE) };
	out.aperture_diameter = { x.d, c.Sigma(Number::APERTURE_DIAMETER) };
	const double floor = std::sqrt(std::max(x.floor_squared, 0.0)), floor_squared_sigma = c.Sigma(Number::FLOOR_SQUARED);
	out.psf_floor_squared = { x.floor_squared, floor_squared_sigma };
	out.psf_floor_px = { floor, floor_squared_sigma / std::max(2 * floor, std::sqrt(floor_squared_sigma)) };
	const double C = x.curvature[0], half = x.curvature[1];
	out.field_curvature = { C, c.Sigma(Number::CURVATURE) };
	out.tangential_curvature = { C + half, c.SigmaOfSum(Number::CURVATURE, Number::HALF_CURVATURE_DIFFERENCE) };
	out.sagittal_curvature = { C - half, c.SigmaOfSum(Number::CURVATURE, Number::HALF_CURVATURE_DIFFERENCE, -1) };
	for (size_t s = 0; s < x.state.size(); ++s)
	{
		StateLens lens;
		FillStateLens(planes[s], w, c.OfPlaneAndImageDistance(s), lens);
		out.states.push_back(lens);
	}
	for (size_t k = 0; k < task.stops.size(); ++k)
		out.stop_ratios.push_back({ x.stops.Ratio(k), k ? x.stops.Ratio(k) * c.Sigma(LensCovariance::OfStop(x.state.size(), k)) : 0 });
	double total = 0;
	for (const Observation& o : fit.observations)
	{
		const double r = fit.Residual(o, x);
		out.states[o.state].rms_blur += r * r;
		++out.states[o.state].edges;
		total += r * r;
	}
	for (StateLens& lens : out.states)
		lens.rms_blur = std::sqrt(lens.rms_blur / std::max(lens.edges, 1));
	out.rms_blur = std::sqrt(total / double(fit.observations.size()));
	out.focus_distance = out.states[0].focus_distance;
	out.focal_length = out.states[0].focal_length;
}

namespace
{

template<typename Numbers>
void Widen(const Numbers& other, Numbers& own, std::initializer_list<Estimate Numbers::*> numbers)
{
	for (Estimate Numbers::*number : numbers)
		(own.*number).sigma = std::max((own.*number).sigma, (other.*number).sigma);
}

}

void WidenSigmas(const StateLens& other, StateLens& own)
{
	Widen(other, own, { &StateLens::lens_tilt, &StateLens::focal_plane_tilt, &StateLens::tilt_direction, &StateLens::focus_distance, &StateLens::focal_length });
	own.q_sigma = { std::max(own.q_sigma.x, other.q_sigma.x), std::max(own.q_sigma.y, other.q_sigma.y), std::max(own.q_sigma.z, other.q_sigma.z) };
}

void WidenSigmas(const Solution& by_photographs, Solution& out)
{
	Widen(by_photographs, out, { &Solution::w_mm, &Solution::aperture_diameter, &Solution::focus_distance, &Solution::focal_length, &Solution::psf_floor_px,
		&Solution::psf_floor_squared, &Solution::field_curvature, &Solution::tangential_curvature, &Solution::sagittal_curvature });
	for (size_t s = 0; s < out.states.size(); ++s)
		WidenSigmas(by_photographs.states[s], out.states[s]);
	for (size_t k = 0; k < out.stop_ratios.size(); ++k)
		out.stop_ratios[k].sigma = std::max(out.stop_ratios[k].sigma, by_photographs.stop_ratios[k].sigma);
	const NamedCovariance& c = by_photographs.covariance;
	for (const std::string& name : out.covariance.names)
	{
		const auto at = std::find(c.names.begin(), c.names.end(), name) - c.names.begin();
		const size_t n = c.names.size();
		out.covariance.by_photographs.push_back(size_t(at) < n ? std::sqrt(c.matrix[size_t(at) * (n + 1)]) : 0);
	}
}

void RefuseUndetermined(const Task& task, const BlurFit& fit, const Solution& s)
{
	// Of a focus far away 1/U is known, not U: beside the boards' 1/z, as which it stands in the blur.
	const double most = 0.05 * std::max(std::abs(s.states[0].q.z), fit.Nearness());
	if (!(s.aperture_diameter.sigma < 0.1 * s.aperture_diameter.value) || !(s.states[0].q_sigma.z < most))
		throw Refused(fmt::format("the untilted photographs do not determine aperture ({:.2f} +- {:.2f} mm) and focus: "
			"photograph inclined boards whose blur changes clearly along the board", s.aperture_diameter.value, s.aperture_diameter.sigma));
	for (size_t k = 1; k < s.states.size(); ++k)
		if (!(s.states[k].lens_tilt.sigma < 0.5))
			throw Refused(fmt::format("state {}: its photographs do not determine the tilt ({:.2f} +- {:.2f} degrees): "
				"photograph the board inclined, sharp in one part and blurred in another", task.states[k].name,
				s.states[k].lens_tilt.value, s.states[k].lens_tilt.sigma));
}

}
