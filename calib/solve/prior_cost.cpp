// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/prior_cost.h"

#include <ceres/ceres.h>

namespace tiltcal
{

void AddPriors(const std::vector<Prior>& priors, LensModel model, const PriorBlocks& blocks, ceres::Problem& problem)
{
	for (const Prior& prior : priors)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost, 1, 1, 1, 1, 3>(new PriorCost{ prior, model, blocks.mm_per_unit }), nullptr,
			blocks.w, blocks.d, blocks.power, blocks.untilted_state);
}

}
