// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_lens.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// d by reweighted least squares through the origin, and the mean absolute residual.
UntiltedGuess Evaluate(const std::vector<DepthBlur>& observations, double w_px, double inverse_focus)
{
	UntiltedGuess g;
	g.inverse_focus = inverse_focus;
	for (int round = 0; round < 4; ++round)
	{
		double ab = 0, aa = 0;
		for (const DepthBlur& o : observations)
		{
			const double a = w_px * o.opening * std::abs(inverse_focus - 1 / o.z);
			const double r = round ? std::abs(o.blur - g.diameter * a) : 1;
			const double weight = 1 / std::max(r, 0.3);
			ab += weight * a * o.blur;
			aa += weight * a * a;
		}
		g.diameter = aa > 0 ? ab / aa : 0;
	}
	for (const DepthBlur& o : observations)
		g.cost += std::abs(o.blur - g.diameter * o.opening * w_px * std::abs(inverse_focus - 1 / o.z));
	g.cost /= double(observations.size());
	return g;
}

}

std::vector<UntiltedGuess> ScanUntilted(const std::vector<DepthBlur>& observations, double w_px)
{
	double nearest = 1e30;
	for (const DepthBlur& o : observations)
		nearest = std::min(nearest, o.z);
	// From a focus behind the lens to one at 40 % of the nearest point.
	std::vector<UntiltedGuess> all, minima;
	for (int k = -100; k <= 500; ++k)
		all.push_back(Evaluate(observations, w_px, 0.005 * k / nearest));
	for (size_t k = 1; k + 1 < all.size(); ++k)
		if (all[k].cost <= all[k - 1].cost && all[k].cost < all[k + 1].cost)
			minima.push_back(all[k]);
	std::sort(minima.begin(), minima.end(), [](const UntiltedGuess& a, const UntiltedGuess& b) { return a.cost < b.cost; });
	if (minima.empty())
		minima.push_back(*std::min_element(all.begin(), all.end(), [](const UntiltedGuess& a, const UntiltedGuess& b) { return a.cost < b.cost; }));
	return minima;
}

}
