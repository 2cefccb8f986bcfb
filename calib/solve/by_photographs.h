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
	int predicted = 0;   ///< what is predicted of it: so many numbers of each of its residuals, the first; 0: all
};

/// Where the numbers of free blocks lie that photographs have in common, one block after the other.
class PlacesOfBlocks
{
public:
	PlacesOfBlocks(const ceres::Problem& problem, const std::vector<double*>& shared);

	/// Of these blocks' numbers; -1 for blocks that are held or belong to one photograph.
	std::vector<int> Of(const std::vector<const double*>& blocks) const;

private:
	const ceres::Problem& problem;
	std::map<const double*, int> first;
};

/// Covariances of the blocks that photographs have in common.
class CovarianceByPhotographs
{
public:
	CovarianceByPhotographs(PlacesOfBlocks places, Eigen::MatrixXd of_shared, double held_out);

	/// Of these blocks, one after the other; 0 for those that are held or belong to one photograph.
	Eigen::MatrixXd Of(const std::vector<const double*>& blocks) const;

	/// RMS residual of the photographs, each predicted by the others, its pose its own.
	double HeldOut() const { return held_out; }

private:
	PlacesOfBlocks places;
	Eigen::MatrixXd c;
	double held_out;
};

/// The jackknife over photographs, a group at a time (Efron and Stein, "The jackknife estimate of variance", 1981), linear about the
/// minimum that `problem` stands at: each photograph is left out with its pose, and the others' step to their own minimum is taken. None
/// when one photograph alone says nearly all of something: then the others cannot judge it.
std::optional<CovarianceByPhotographs> JackknifeOverPhotographs(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs);

/// Of blocks that photographs have in common, one after the other, 0 where they are held.
struct PartsAnswer
{
	Eigen::VectorXd step;         ///< from where `problem` stands to the part's own minimum
	Eigen::VectorXd variance;     ///< of that minimum, as the part's residuals scatter
};

/// What a part of the residuals says alone, the poses its own, linear about the minimum of all that `problem` stands at. `part`: the photographs with some of their
/// residuals; what is no photograph's counts in full. None: it does not tell all numbers apart.
std::optional<PartsAnswer> AnswerOfPart(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs, const std::vector<PhotographBlocks>& part, const std::vector<const double*>& blocks);

}

#endif
