// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/floor_shape.h"

#include "base/robust.h"
#include "solve/solve_joint.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

/// What a floor takes off the square of a blur, px^2.
double Excess(double floor, double blur)
{
	return floor * GaussianFloorExcess(std::sqrt(std::max(blur * std::abs(blur) - floor, 0.0) / floor));
}

}

double GaussianFloorExcess(double diameter)
{
	// Fitted to discs with a Gaussian and a pixel, by least squares of their edges' profiles, within 0.06 (test FloorShape.IsThatOfAGaussian).
	return 0.29 / (1 + 0.5 * diameter * diameter);
}

bool ShapeOfFloorIsSeen(const Calibration& c)
{
	const double floor = c.solution.psf_floor_squared.value;
	if (!(floor > 0))
		return false;
	std::vector<double> squares;
	for (const State& state : c.task.states)
		for (const Photo& photo : state.photos)
			for (const Edge& edge : photo.edges)
				squares.push_back(edge.blur * std::abs(edge.blur));
	if (squares.empty())
		return false;
	// Half of what the blurs' squares change from a sharp edge to a usual one.
	const double usual = Median(squares) - floor, sigma = c.solution.aperture_diameter.sigma / c.solution.aperture_diameter.value;
	return !(usual > 0) || 0.5 * floor * GaussianFloorExcess(0) / usual > 0.3 * sigma;
}

std::optional<PartAnswer> SolveWithGaussianFloor(const Calibration& c)
{
	const double floor = c.solution.psf_floor_squared.value;
	Task task = c.task;
	for (State& state : task.states)
		for (Photo& photo : state.photos)
			for (Edge& edge : photo.edges)
			{
				const double square = edge.blur * std::abs(edge.blur) - Excess(floor, edge.blur);
				edge.blur = std::copysign(std::sqrt(std::abs(square)), square);
			}
	PartAnswer answer{ c.geometry, c.solution, 0, 1 / std::sqrt(3.0) };
	if (!RefineJointly(task, Refinement::EDGES, answer.geometry, answer.solution))
		return std::nullopt;
	return answer;
}

}
