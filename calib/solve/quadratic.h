// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A sum of squares to second order, photograph by photograph.

#ifndef TILTCAL_QUADRATIC_H
#define TILTCAL_QUADRATIC_H

#include "solve/by_photographs.h"

#include <Eigen/Core>
#include <ceres/problem.h>

#include <vector>

namespace tiltcal
{

/// Sum of squares to second order about the present place: J^T J and J^T r of the blocks, in their tangent spaces.
struct Quadratic
{
	Eigen::MatrixXd H;
	Eigen::VectorXd g;
	double squares = 0;   ///< r^T r
	int count = 0;

	Quadratic& operator+=(const Quadratic& q);
};

/// Of these residuals by these blocks; `most`: of each no more than its first numbers, 0: all.
Quadratic Expand(ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<double*>& blocks, int most = 0);

/// Without the last unknowns, which follow the others.
Quadratic Reduced(const Quadratic& q, int kept);

/// What a photograph says of the shared blocks, its pose following them. `size`: of their tangent spaces; `most` as of Expand.
Quadratic OfPhotograph(ceres::Problem& problem, const PhotographBlocks& photograph, const std::vector<double*>& shared, int size, int most = 0);

/// Free blocks that are no photograph's pose, in the order in which residuals name them: Ceres's own order is that of their addresses.
std::vector<double*> SharedBlocks(const ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<PhotographBlocks>& photographs);

/// Numbers of their tangent spaces.
int TangentSize(const ceres::Problem& problem, const std::vector<double*>& blocks);

/// Those that are no photograph's: priors.
std::vector<ceres::ResidualBlockId> Others(const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<PhotographBlocks>& photographs);

/// From tangent spaces to the blocks' own numbers, held ones 0.
Eigen::MatrixXd FromTangent(const ceres::Problem& problem, const std::vector<double*>& blocks);

}

#endif
