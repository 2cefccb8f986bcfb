// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Statistics that outliers do not move, and how improbable a number is.

#ifndef TILTCAL_ROBUST_H
#define TILTCAL_ROBUST_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tiltcal
{

/// Of an even number the upper of the two in the middle. `values` must not be empty.
inline double Median(std::vector<double> values)
{
	const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
	std::nth_element(values.begin(), middle, values.end());
	return *middle;
}

/// Standard deviation of residuals about 0 by 1.4826 median |residual|, which is that of a normal distribution.
inline double RobustSigma(std::vector<double> residuals)
{
	for (double& r : residuals)
		r = std::abs(r);
	return 1.4826 * Median(std::move(residuals));
}

/// RobustSigma of residuals in units of their own `sigmas` and a common one, above 0, in quadrature.
inline double ScatterInSigmas(const std::vector<double>& residuals, const std::vector<double>& sigmas, double common)
{
	std::vector<double> in_sigmas;
	for (std::size_t k = 0; k < residuals.size(); ++k)
		in_sigmas.push_back(residuals[k] / std::hypot(sigmas[k], common));
	return RobustSigma(std::move(in_sigmas));
}

/// The common one with which that is 1; at least `least`.
inline double CommonScatter(const std::vector<double>& residuals, const std::vector<double>& sigmas, double least)
{
	// Without any noise of their own they scatter by no more than `high` says.
	double low = least, high = RobustSigma(residuals);
	if (!(high > low) || ScatterInSigmas(residuals, sigmas, low) <= 1)
		return least;
	for (int halving = 0; halving < 30; ++halving)
	{
		const double middle = 0.5 * (low + high);
		(ScatterInSigmas(residuals, sigmas, middle) > 1 ? low : high) = middle;
	}
	return high;
}

/// What a model leaves out beside the noise: CommonScatter. Weighed so, residuals count beside what is known before as much as they know. Where others' sigmas that say too much hide it, and the
/// surest quarter scatters by half more than it would then say, that of the quarter. As many sigmas as residuals, not none.
inline double ModelScatter(const std::vector<double>& residuals, const std::vector<double>& sigmas, double least)
{
	const double of_all = CommonScatter(residuals, sigmas, least);
	const std::size_t quarter = sigmas.size() / 4, fewest = 50;   // whose scatter is known to 1.17 / sqrt 50, a sixth: half more is three times that
	if (quarter < fewest)
		return of_all;
	std::vector<double> in_order = sigmas;
	const auto last = in_order.begin() + static_cast<std::ptrdiff_t>(quarter);
	std::nth_element(in_order.begin(), last, in_order.end());
	std::vector<double> of_surest, surest;
	for (std::size_t k = 0; k < sigmas.size(); ++k)
		if (sigmas[k] <= *last)
		{
			of_surest.push_back(residuals[k]);
			surest.push_back(sigmas[k]);
		}
	return ScatterInSigmas(of_surest, surest, of_all) > 1.5 ? CommonScatter(of_surest, surest, least) : of_all;
}

/// Of how many standard deviations of one normal number a chi squared of two is as improbable: chi squared of two is beyond
/// x with the probability exp(-x/2).
inline double SigmasOfTwo(double chi_squared)
{
	if (chi_squared > 60)   // erfc is too small to invert, and nobody needs to know
		return std::sqrt(chi_squared);
	double least = 0, most = 10;
	for (int k = 0; k < 60; ++k)
	{
		const double middle = 0.5 * (least + most);
		(std::erfc(middle / std::sqrt(2.0)) > std::exp(-0.5 * chi_squared) ? least : most) = middle;
	}
	return least;
}

}

#endif
