// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/held_out.h"

#include "model/tilt_angles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace tiltcal
{

namespace
{

Eigen::Vector2d TiltOfState(const BlurFit& fit, const Unknowns& x, size_t state)
{
	const TiltAngles a = AnglesFromPlane(fit.Plane(x, state), fit.w_mm);
	return TiltVector(a.lens_tilt, a.tilt_direction);
}

/// Of the state's own tilt; without one of the untilted state's all may move, by the d and w that they share with it: the greatest.
double TiltChange(const BlurFit& fit, const Unknowns& with, const Unknowns& without, size_t state)
{
	double most = 0;
	for (size_t s = 0; s < with.state.size(); ++s)
		if (state == 0 || s == state)
			most = std::max(most, (TiltOfState(fit, without, s) - TiltOfState(fit, with, s)).norm());
	return most;
}

}

HeldOut HoldOut(const BlurFit& fit, const Unknowns& x, double most)
{
	HeldOut result;
	std::map<size_t, std::set<size_t>> photos;
	for (const Observation& o : fit.observations)
		photos[o.state].insert(o.photo);
	double sum = 0;
	size_t count = 0;
	bool all = true;
	for (const auto& [state, numbers] : photos)
		for (const size_t photo : numbers)
		{
			if (numbers.size() < 2)
				continue;
			std::vector<Observation> others, own;
			for (const Observation& o : fit.observations)
				(o.state == state && o.photo == photo ? own : others).push_back(o);
			const BlurFit reduced{ fit.model, others, fit.w_mm, fit.model_sigma, fit.priors, fit.stops };
			Unknowns y = x;
			if (!reduced.Minimise(y, Free::EVERYTHING, 0))
			{
				all = false;
				continue;
			}
			double squares = 0;
			for (const Observation& o : own)
				squares += std::pow(std::min(std::abs(fit.Residual(o, y)), most), 2);
			sum += squares;
			count += own.size();
			result.photos.push_back({ state, photo, TiltChange(fit, x, y, state), std::abs(std::abs(y.d) - std::abs(x.d)), std::abs(fit.Plane(y, 0).z - fit.Plane(x, 0).z), std::sqrt(squares / double(own.size())) });
		}
	result.rms = all && count ? std::sqrt(sum / double(count)) : 0;
	return result;
}

}
