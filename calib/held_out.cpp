// SPDX-License-Identifier: AGPL-3.0-or-later

#include "held_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tiltcal
{

double HeldOutError(const BlurFit& fit, const Unknowns& x, double most)
{
	std::map<size_t, std::set<size_t>> photos;
	for (const Observation& o : fit.observations)
		photos[o.state].insert(o.photo);
	double sum = 0;
	size_t count = 0;
	for (const auto& [state, numbers] : photos)
		for (const size_t photo : numbers)
		{
			if (numbers.size() < 2)
				continue;
			std::vector<Observation> others, own;
			for (const Observation& o : fit.observations)
				(o.state == state && o.photo == photo ? own : others).push_back(o);
			const BlurFit reduced{ fit.model, others, fit.w_mm, fit.model_sigma };
			Unknowns y = x;
			if (reduced.Minimise(y, Free::EVERYTHING, 0) >= 1e300)
				return HUGE_VAL;
			for (const Observation& o : own)
				sum += std::pow(std::min(std::abs(fit.Residual(o, y)), most), 2);
			count += own.size();
		}
	return count ? std::sqrt(sum / double(count)) : 0;
}

}
