// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_BLOCK_COVARIANCE_H
#define TILTCAL_BLOCK_COVARIANCE_H

#include <Eigen/Core>
#include <ceres/covariance.h>
#include <ceres/problem.h>

#include <vector>

namespace tiltcal
{

/// Covariances of a problem's blocks, 0 for those that are held. A block that the problem does not have ends the program: Ceres's check.
class BlockCovariance
{
public:
	/// Fails on a singular problem, which is the answer wanted there.
	explicit BlockCovariance(ceres::Problem& to_judge);

	/// `together`: with each other; `alone`: each by itself; `pairs`: of those alone, with each other. False: singular.
	bool Compute(const std::vector<const double*>& together, const std::vector<const double*>& alone = {}, const std::vector<std::pair<const double*, const double*>>& pairs = {});

	Eigen::MatrixXd Of(const double* a, const double* b) const;

	/// Of all of them, one after the other.
	Eigen::MatrixXd Of(const std::vector<const double*>& blocks) const;

private:
	bool Free(const double* block) const { return !problem.IsParameterBlockConstant(block); }

	ceres::Problem& problem;
	ceres::Covariance covariance;
};

}

#endif
