// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/prior_cost.h"

#include <ceres/ceres.h>

namespace tiltcal
{

void AddPriors(const std::vector<Prior>& priors, LensModel model, double* w, double mm_per_unit, double* d, double* power, double* untilted_state, ceres::Problem& problem)
{
	for (const Prior& prior : priors)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost, 1, 1, 1, 1, 3>(new PriorCost{ prior, model, mm_per_unit }), nullptr, w, d, power, untilted_state);
}

}
