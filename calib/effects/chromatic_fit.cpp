// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/chromatic_fit.h"

#include "model/predict.h"
#include <tiltcal/calibrate.h>
#include "model/footprint.h"
#include "edge/soft_radius.h"
#include "base/robust.h"
#include "solve/solve_geometry.h"

#include <fmt/format.h>
#include "lens/chromatic.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Residuals beyond so many standard deviations count linearly; left out, they count as no more than so many.
const double HUBER = 2, MOST_HELD_OUT = 5;

const size_t FEWEST_EDGES = 10;

/// measured = unknown * slope, of one edge.
struct Line
{
	size_t photo;      ///< among all photographs of all states
	double measured, sigma, slope;
};

/// The unknown, and its standard deviation by the scatter. `skip`: a photograph that is left out.
Estimate FitSlope(const std::vector<Line>& lines, size_t skip)
{
	Estimate x;
	double model = 0.02;   // px, what the measured sigmas leave out
	for (int round = 0; round < 20; ++round)
	{
		double a = 0, b = 0, squares = 0, count = 0;
		std::vector<double> residuals;
		for (const Line& l : lines)
		{
			if (l.photo == skip)
				continue;
			const double r = l.measured - x.value * l.slope, sigma = std::hypot(l.sigma, model), t = std::abs(r) / sigma;
			const double weight = (t < HUBER ? 1 : HUBER / t) / (sigma * sigma);
			a += weight * l.slope * l.slope;
			b += weight * l.slope * l.measured;
			squares += weight * r * r;
			++count;
			residuals.push_back(r);
		}
		if (!(a > 0))
			return { 0, HUGE_VAL };
		x = { b / a, std::sqrt(squares / std::max(count - 1, 1.0) / a) };
		model = std::max(RobustSigma(std::move(residuals)), 1e-4);
	}
	return x;
}

struct Answer
{
	Estimate estimate;
	double squares_without = 0, squares_with = 0;   ///< of edges left out
	size_t count = 0;
};

Answer Fit(const std::vector<Line>& lines, size_t photos)
{
	Answer answer;
	answer.estimate = FitSlope(lines, photos);
	std::vector<double> residuals, left;
	for (const Line& l : lines)
		residuals.push_back(l.measured - answer.estimate.value * l.slope);
	const double most = MOST_HELD_OUT * RobustSigma(std::move(residuals));
	for (size_t p = 0; p < photos; ++p)
	{
		const double without = FitSlope(lines, p).value;
		const size_t before = answer.count;
		for (const Line& l : lines)
			if (l.photo == p)
			{
				answer.squares_without += std::pow(std::min(std::abs(l.measured), most), 2);
				answer.squares_with += std::pow(std::min(std::abs(l.measured - without * l.slope), most), 2);
				++answer.count;
			}
		if (answer.count > before)
			left.push_back(without);
	}
	double mean = 0, variance = 0;
	for (const double x : left)
		mean += x / double(left.size());
	for (const double x : left)
		variance += (x - mean) * (x - mean);
	if (left.size() > 1)
		answer.estimate.sigma = std::max(answer.estimate.sigma, std::sqrt(variance * double(left.size() - 1) / double(left.size())));
	else
		answer.count = 0;   // nothing is left to predict one from
	return answer;
}

/// Shift of an edge, px, per unit of lateral aberration.
double LateralSlope(const Calibration& c, size_t s, const Edge& e)
{
	const Geometry& g = c.MainGeometry();
	const Point& centre = g.states[s].principal_point;
	const Point normal = EdgeNormal(e);
	const Vec3<double> v{ (e.x - centre[0]) / g.w_px, -(e.y - centre[1]) / g.w_px, 1 };
	const double step = 1e-4;
	// LateralDirection goes from the picture to the scene; the image that is `lateral` larger goes the other way.
	const auto place = [&](double lateral)
	{
		const Vec3<double> moved = tilt_lens::LateralDirection(g.states[s].lens_normal, 1 / (1 + lateral) - 1, v);
		return g.w_px * (normal[0] * moved.x - normal[1] * moved.y) / moved.z;
	};
	return (place(step) - place(-step)) / (2 * step);
}

/// Change of an edge's soft blur width (edge/soft_radius.h), px, per unit of axial aberration, 1/mm.
double AxialSlope(const Calibration& c, size_t s, size_t p, const Edge& e)
{
	const Geometry& g = c.MainGeometry();
	const Vec3<double> P = EdgeInCamera(c.task, g.states[s].poses[p], e), G = EdgeGradient(g, s, P, e), &n = g.states[s].lens_normal;
	const double curvature[2] = { c.solution.field_curvature.value, 0.5 * (c.solution.tangential_curvature.value - c.solution.sagittal_curvature.value) };
	const double floor_squared = c.solution.psf_floor_squared.value, step = 1e-7;
	const auto width = [&](double axial)
	{
		return SoftDiameterOfSquare(SquaredFootprintWidth(c.solution.ApertureOf(c.task.states[s].photos[p]), c.solution.states[s].q + axial * n, n, curvature, P, G) + floor_squared);
	};
	return (width(step) - width(-step)) / (2 * step);
}

double Rms(double squares, size_t count) { return count ? std::sqrt(squares / double(count)) : 0; }

std::string WhyNothing(const Calibration& c)
{
	bool coloured = false, subsampled = false;
	for (const State& state : c.task.states)
		for (const Photo& photo : state.photos)
		{
			coloured = coloured || photo.coloured;
			subsampled = subsampled || (photo.coloured && photo.facts.subsampled_colour);
		}
	if (!coloured)
		return "the photographs are grey";
	if (subsampled)
		return "the JPEG files store colour at half the size (4:2:0 or 4:2:2), which hides most of a shift between colours: export PNG, TIFF or 4:4:4 JPEG from the raw files";
	return c.task.board.IsCheckerboard() ? "too few edges could be measured in all three colours" : "it is told by straight edges, which a grid of circles does not have";
}

}

Chromatic EstimateChromatic(const Calibration& c)
{
	Chromatic result;
	if (c.solution.model == Model::PAPER)
	{
		result.failure = "the paper's model has no effects";
		return result;
	}
	std::vector<Line> lateral[2], axial[2];
	size_t photo = 0;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p, ++photo)
			for (const ColourEdge& e : c.task.states[s].photos[p].colours)
			{
				const double shift = LateralSlope(c, s, e.green), widening = AxialSlope(c, s, p, e.green);
				for (size_t k = 0; k < 2; ++k)
				{
					lateral[k].push_back({ photo, e.shift[k], e.shift_sigma[k], shift });
					axial[k].push_back({ photo, e.widening[k], e.widening_sigma[k], widening });
				}
				++result.edges;
			}
	if (size_t(result.edges) < FEWEST_EDGES)
	{
		result.failure = WhyNothing(c);
		return result;
	}
	Answer sideways[2], along[2];
	for (size_t k = 0; k < 2; ++k)
	{
		sideways[k] = Fit(lateral[k], photo);
		along[k] = Fit(axial[k], photo);
		result.lateral[k] = sideways[k].estimate;
		result.axial_per_mm[k] = along[k].estimate;
	}
	const size_t count = sideways[0].count + sideways[1].count;
	result.lateral_held_out_without = Rms(sideways[0].squares_without + sideways[1].squares_without, count);
	result.lateral_held_out_with = Rms(sideways[0].squares_with + sideways[1].squares_with, count);
	result.axial_held_out_without = Rms(along[0].squares_without + along[1].squares_without, count);
	result.axial_held_out_with = Rms(along[0].squares_with + along[1].squares_with, count);
	return result;
}

}
