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

/// What a model leaves out beside the noise: the standard deviation, common to all, with which in quadrature to their own `sigmas` the residuals scatter as much as that says (RobustSigma); at least
/// `least`, above 0. Weighed so, they count beside what is known before as much as they know. As many sigmas as residuals, not none.
inline double ModelScatter(const std::vector<double>& residuals, const std::vector<double>& sigmas, double least)
{
	const auto scatter = [&](double common)
	{
		std::vector<double> in_sigmas;
		for (std::size_t k = 0; k < residuals.size(); ++k)
			in_sigmas.push_back(residuals[k] / std::hypot(sigmas[k], common));
		return RobustSigma(std::move(in_sigmas));
	};
	// Without any noise of their own they scatter by no more than `high` says.
	double low = least, high = RobustSigma(residuals);
	if (!(high > low) || scatter(low) <= 1)
		return least;
	for (int halving = 0; halving < 30; ++halving)
	{
		const double middle = 0.5 * (low + high);
		(scatter(middle) > 1 ? low : high) = middle;
	}
	return high;
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
