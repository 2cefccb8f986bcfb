// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/stop_ratios.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>
#include <utility>

namespace tiltcal
{

namespace
{

struct StopPrior
{
	double log_ratio, sigma;

	template<typename T>
	bool operator()(const T* log, T* residual) const
	{
		residual[0] = (*log - T(log_ratio)) / T(sigma);
		return true;
	}
};

}

StopRatios::StopRatios(const std::vector<Stop>& stops)
{
	for (size_t k = 1; k < stops.size(); ++k)
		logs.push_back(std::log(RatioByFNumbers(stops, k)));
}

StopRatios::StopRatios(const std::vector<Estimate>& ratios)
{
	for (size_t k = 1; k < ratios.size(); ++k)
		logs.push_back(std::log(ratios[k].value));
}

std::vector<const double*> StopRatios::Blocks() const
{
	std::vector<const double*> blocks;
	for (const double& log : logs)
		blocks.push_back(&log);
	return blocks;
}

CostAtStop::CostAtStop(std::unique_ptr<ceres::CostFunction> of_reference, const OpeningNumbers& opening) : cost(std::move(of_reference)), numbers(opening)
{
	set_num_residuals(cost->num_residuals());
	*mutable_parameter_block_sizes() = cost->parameter_block_sizes();
	mutable_parameter_block_sizes()->push_back(1);
}

bool CostAtStop::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
	const std::vector<int>& sizes = cost->parameter_block_sizes();
	const size_t count = sizes.size();
	const double log = parameters[count][0], ratio = std::exp(log);
	std::vector<const double*> seen(parameters, parameters + count);
	const auto copy = [&](size_t block) { return std::vector<double>(parameters[block], parameters[block] + sizes[block]); };
	std::vector<double> opening = copy(numbers.block), lengths;
	opening[numbers.at] *= ratio;
	seen[numbers.block] = opening.data();
	if (numbers.in_openings)
	{
		lengths = copy(*numbers.in_openings);
		for (double& length : lengths)
			length -= log;
		seen[*numbers.in_openings] = lengths.data();
	}
	if (!jacobians)
		return cost->Evaluate(seen.data(), residuals, nullptr);

	std::vector<double*> by(jacobians, jacobians + count);
	// What the ratio moves is asked for even where it is held.
	std::vector<double> by_opening(size_t(num_residuals() * sizes[numbers.block])), by_lengths;
	by[numbers.block] = by_opening.data();
	if (numbers.in_openings)
	{
		by_lengths.resize(size_t(num_residuals() * sizes[*numbers.in_openings]));
		by[*numbers.in_openings] = by_lengths.data();
	}
	if (!cost->Evaluate(seen.data(), residuals, by.data()))
		return false;
	const size_t width = size_t(sizes[numbers.block]);
	for (size_t i = 0; i < size_t(num_residuals()); ++i)
	{
		double& by_number = by_opening[i * width + numbers.at];
		double by_log = by_number * opening[numbers.at];
		for (size_t k = 0; numbers.in_openings && k < lengths.size(); ++k)
			by_log -= by_lengths[i * lengths.size() + k];
		by_number *= ratio;
		if (jacobians[count])
			jacobians[count][i] = by_log;
	}
	if (jacobians[numbers.block])
		std::copy(by_opening.begin(), by_opening.end(), jacobians[numbers.block]);
	if (numbers.in_openings && jacobians[*numbers.in_openings])
		std::copy(by_lengths.begin(), by_lengths.end(), jacobians[*numbers.in_openings]);
	return true;
}

ceres::ResidualBlockId AddAtStop(ceres::CostFunction* cost, const OpeningNumbers& opening, ceres::LossFunction* loss, std::vector<double*> blocks, size_t stop, StopRatios& stops,
	ceres::Problem& problem)
{
	if (stop == 0)
		return problem.AddResidualBlock(cost, loss, blocks);
	blocks.push_back(stops.Block(stop));
	return problem.AddResidualBlock(new CostAtStop(std::unique_ptr<ceres::CostFunction>(cost), opening), loss, blocks);
}

void AddStopPriors(const std::vector<Stop>& stops, StopRatios& ratios, ceres::Problem& problem)
{
	for (size_t k = 1; k < stops.size(); ++k)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<StopPrior, 1, 1>(new StopPrior{ std::log(RatioByFNumbers(stops, k)), stops[k].log_sigma }), nullptr, ratios.Block(k));
}

void HoldStops(StopRatios& ratios, ceres::Problem& problem)
{
	for (size_t k = 1; k <= ratios.Further(); ++k)
	{
		problem.AddParameterBlock(ratios.Block(k), 1);
		problem.SetParameterBlockConstant(ratios.Block(k));
	}
}

}
