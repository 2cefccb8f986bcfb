// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REAL_LENS_EDGE_COST_H
#define TILTCAL_REAL_LENS_EDGE_COST_H

#include "solve/real_lens_cost.h"

#include <ceres/sized_cost_function.h>

namespace tiltcal
{

/// RealLensEdge::See, weighted, with the derivatives of moving_rays.h. Blocks: state, pose, centre, lens, c, rims.
class RealLensEdgeCost final : public ceres::SizedCostFunction<2, real_lens::STATE_SIZE, 6, 3, real_lens::LENS_SIZE, tilt_lens::AberrationTerms, real_lens::RIMS_SIZE>
{
public:
	/// `of`: an edge that outlives this; the weights of its place and of its blur.
	RealLensEdgeCost(const RealLensEdge& of, double of_place, double of_blur) : edge(of), weight{ of_place, of_blur } {}

	bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

private:
	const RealLensEdge& edge;
	double weight[2];
};

}

#endif
