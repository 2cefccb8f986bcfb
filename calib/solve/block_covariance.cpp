// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/block_covariance.h"

#include <utility>

namespace tiltcal
{

namespace
{

ceres::Covariance::Options Options()
{
	ceres::Covariance::Options options;
	options.algorithm_type = ceres::SPARSE_QR;
	return options;
}

}

BlockCovariance::BlockCovariance(ceres::Problem& to_judge) : problem(to_judge), covariance(Options()) {}

bool BlockCovariance::Compute(const std::vector<const double*>& together, const std::vector<const double*>& alone, const std::vector<std::pair<const double*, const double*>>& of_two)
{
	std::vector<std::pair<const double*, const double*>> pairs;
	for (const auto& [a, b] : of_two)
		if (Free(a) && Free(b))
			pairs.emplace_back(a, b);
	for (size_t i = 0; i < together.size(); ++i)
		for (size_t j = i; j < together.size(); ++j)
			if (Free(together[i]) && Free(together[j]))
				pairs.emplace_back(together[i], together[j]);
	for (const double* block : alone)
		if (Free(block))
			pairs.emplace_back(block, block);
	return covariance.Compute(pairs, &problem);
}

Eigen::MatrixXd BlockCovariance::Of(const double* a, const double* b) const
{
	Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> c = Eigen::MatrixXd::Zero(problem.ParameterBlockSize(a), problem.ParameterBlockSize(b));
	if (Free(a) && Free(b))
		covariance.GetCovarianceBlock(a, b, c.data());
	return c;
}

Eigen::MatrixXd BlockCovariance::Of(const std::vector<const double*>& blocks) const
{
	int n = 0;
	for (const double* block : blocks)
		n += problem.ParameterBlockSize(block);
	Eigen::MatrixXd all(n, n);
	for (int i = 0, row = 0; i < int(blocks.size()); row += problem.ParameterBlockSize(blocks[size_t(i)]), ++i)
		for (int j = 0, column = 0; j < int(blocks.size()); column += problem.ParameterBlockSize(blocks[size_t(j)]), ++j)
		{
			const double *a = blocks[size_t(i)], *b = blocks[size_t(j)];
			all.block(row, column, problem.ParameterBlockSize(a), problem.ParameterBlockSize(b)) = i <= j ? Of(a, b) : Eigen::MatrixXd(Of(b, a).transpose());
		}
	return all;
}

}
