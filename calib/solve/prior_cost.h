// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is known of the lens beforehand, as residuals of a fit.

#ifndef TILTCAL_PRIOR_COST_H
#define TILTCAL_PRIOR_COST_H

#include "model/lens_model.h"

#include <ceres/problem.h>

#include <vector>

namespace tiltcal
{

/// (predicted - value) / sigma, for w_px (times mm_per_unit: mm), d, power and the untilted state's numbers.
struct PriorCost
{
	Prior prior;
	LensModel model;
	double mm_per_unit;

	template<typename T>
	bool operator()(const T* w, const T* d, const T* power, const T* state, T* residual) const
	{
		const T w_mm = *w * T(mm_per_unit);
		const Vec3<T> q = PlaneOfState(model, power, state, w_mm);
		const T lens_power = tilt_lens::LensFromPlane(q, T(1) / w_mm).power;
		T predicted = w_mm;
		T value = T(prior.value), sigma = T(prior.sigma);
		switch (prior.quantity)
		{
		case Quantity::FOCAL_LENGTH: predicted = T(1) / lens_power; break;
		case Quantity::F_NUMBER: predicted = T(1) / (lens_power * *d); break;
		case Quantity::IMAGE_DISTANCE: break;
		case Quantity::APERTURE_DIAMETER: predicted = *d; break;
		case Quantity::FOCUS_DISTANCE:
			// As 1/U, which stays finite.
			predicted = q.z;
			value = T(1 / prior.value);
			sigma = T(prior.sigma / (prior.value * prior.value));
			break;
		}
		residual[0] = (predicted - value) / sigma;
		return true;
	}
};

/// The blocks of a problem that priors speak of.
struct PriorBlocks
{
	double* w;             ///< in units of mm_per_unit mm
	double mm_per_unit;
	double *d, *power, *untilted_state;
};

/// Adds the priors to a problem that has these blocks.
void AddPriors(const std::vector<Prior>& priors, LensModel model, const PriorBlocks& blocks, ceres::Problem& problem);

}

#endif
