// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Statistics that outliers do not move.

#ifndef TILTCAL_ROBUST_H
#define TILTCAL_ROBUST_H

#include <algorithm>
#include <cmath>
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

}

#endif
