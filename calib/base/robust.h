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
