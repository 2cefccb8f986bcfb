// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Sigmas from the photographs themselves: what the model leaves out of a photograph is common to all its edges, and the covariance of a
// fit takes them for independent.

#ifndef TILTCAL_BY_PHOTOGRAPHS_H
#define TILTCAL_BY_PHOTOGRAPHS_H

#include <Eigen/Core>
#include <ceres/problem.h>

#include <map>
#include <optional>
#include <vector>

namespace tiltcal
{

/// What one photograph has of its own in a problem: residuals, the pose of its board, and the group in which it has its like, its state.
struct PhotographBlocks
{
	std::vector<ceres::ResidualBlockId> residuals;
	double* pose = nullptr;
	size_t group = 0;
	std::vector<ceres::ResidualBlockId> beside{};   ///< left out with it, but not what is predicted of it; they do not know its pose
};

/// Covariances of the blocks that photographs have in common.
class CovarianceByPhotographs
{
public:
	CovarianceByPhotographs(const ceres::Problem& problem, const std::vector<double*>& shared, Eigen::MatrixXd of_shared, double held_out);

	/// Of these blocks, one after the other; 0 for those that are held or belong to one photograph.
	Eigen::MatrixXd Of(const std::vector<const double*>& blocks) const;

	/// RMS residual of the photographs, each predicted by the others, its pose its own.
	double HeldOut() const { return held_out; }

private:
	const ceres::Problem& problem;
	std::map<const double*, int> first;
	Eigen::MatrixXd c;
	double held_out;
};

/// The jackknife over photographs, a group at a time (Efron and Stein, "The jackknife estimate of variance", 1981), linear about the
/// minimum that `problem` stands at: each photograph is left out with its pose, and the others' step to their own minimum is taken. None
/// when one photograph alone says nearly all of something: then the others cannot judge it.
std::optional<CovarianceByPhotographs> JackknifeOverPhotographs(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs);

}

#endif
