// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REAL_LENS_EDGE_COST_H
#define TILTCAL_REAL_LENS_EDGE_COST_H

#include "solve/real_lens_cost.h"

#include <ceres/cost_function.h>

namespace tiltcal
{

/// RealLensEdge::See, weighted, with the derivatives of moving_rays.h. Blocks: state, pose, centre, lens, c, rims.
class RealLensEdgeCost final : public ceres::CostFunction
{
public:
	/// `of`: an edge that outlives this; the weights of what is seen of it.
	RealLensEdgeCost(const RealLensEdge& of, const RealLensEdge::Seen& weights);

	bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

private:
	const RealLensEdge& edge;
	RealLensEdge::Seen weight;
};

}

#endif
