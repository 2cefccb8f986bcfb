// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The openings that photographs were taken through, as unknowns of a fit. The lens is one: at a further stop a photograph sees its aperture
// times a ratio that is found, and all else as it is.

#ifndef TILTCAL_STOP_RATIOS_H
#define TILTCAL_STOP_RATIOS_H

#include <tiltcal/calibration.h>

#include <ceres/cost_function.h>
#include <ceres/problem.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace tiltcal
{

/// Logarithms of the ratios of the stops' diameters to the reference's, stop 0, whose own is 0.
class StopRatios
{
public:
	/// One opening for all photographs.
	StopRatios() = default;
	/// As the f-numbers say.
	explicit StopRatios(const std::vector<Stop>& stops);
	/// As they were found.
	explicit StopRatios(const std::vector<Estimate>& ratios);

	/// How many there are beside the reference.
	size_t Further() const { return logs.size(); }
	double Log(size_t stop) const { return stop == 0 ? 0 : logs.at(stop - 1); }
	double Ratio(size_t stop) const { return stop == 0 ? 1 : std::exp(Log(stop)); }

	/// Of the further stops, a number each.
	std::vector<const double*> Blocks() const;
	/// `stop`: not the reference.
	double* Block(size_t stop) { return &logs.at(stop - 1); }

private:
	std::vector<double> logs;
};

/// Which numbers of a cost function's blocks stand for the opening.
struct OpeningNumbers
{
	size_t block, at;                       ///< the number that is its diameter, or proportional to it
	std::optional<size_t> in_openings{};    ///< a block of logarithms of lengths in units of it, which stay where they are when it changes
};

/// A cost function as photographs at a further stop have it: its own blocks, of the reference, and one more, the logarithm of the stop's ratio.
class CostAtStop final : public ceres::CostFunction
{
public:
	CostAtStop(std::unique_ptr<ceres::CostFunction> of_reference, const OpeningNumbers& opening);

	bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

private:
	std::unique_ptr<ceres::CostFunction> cost;
	OpeningNumbers numbers;
};

/// Adds the cost of a photograph at that stop; of the reference it is added as it is. The problem owns cost and loss.
ceres::ResidualBlockId AddAtStop(ceres::CostFunction* cost, const OpeningNumbers& opening, ceres::LossFunction* loss, std::vector<double*> blocks, size_t stop, StopRatios& stops,
	ceres::Problem& problem);

/// Adds what the f-numbers say of the further stops; those of `stops` and `ratios` are the same.
void AddStopPriors(const std::vector<Stop>& stops, StopRatios& ratios, ceres::Problem& problem);

/// Adds the further stops' numbers, held.
void HoldStops(StopRatios& ratios, ceres::Problem& problem);

}

#endif
