// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/quadratic.h"

#include <ceres/cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <set>

namespace tiltcal
{

Quadratic& Quadratic::operator+=(const Quadratic& q)
{
	H += q.H;
	g += q.g;
	squares += q.squares;
	count += q.count;
	return *this;
}

namespace
{

/// The rows of the first `most` numbers of each residual; 0: of all.
std::vector<int> RowsOf(const ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, int most)
{
	std::vector<int> rows;
	int first = 0;
	for (const ceres::ResidualBlockId r : residuals)
	{
		const int count = problem.GetCostFunctionForResidualBlock(r)->num_residuals();
		for (int i = 0; i < (most ? std::min(most, count) : count); ++i)
			rows.push_back(first + i);
		first += count;
	}
	return rows;
}

}

Quadratic Expand(ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<double*>& blocks, int most)
{
	ceres::Problem::EvaluateOptions options;
	options.residual_blocks = residuals;
	options.parameter_blocks = blocks;
	std::vector<double> r;
	ceres::CRSMatrix J;
	problem.Evaluate(options, nullptr, &r, nullptr, &J);
	const std::vector<int> rows = RowsOf(problem, residuals, most);
	Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(Eigen::Index(rows.size()), J.num_cols);
	Eigen::VectorXd residual(dense.rows());
	for (Eigen::Index i = 0; i < dense.rows(); ++i)
	{
		const size_t row = size_t(rows[size_t(i)]);
		residual[i] = r[row];
		for (int k = J.rows[row]; k < J.rows[row + 1]; ++k)
			dense(i, J.cols[size_t(k)]) = J.values[size_t(k)];
	}
	return { dense.transpose() * dense, dense.transpose() * residual, residual.squaredNorm(), int(rows.size()) };
}

Quadratic Reduced(const Quadratic& q, int kept)
{
	const auto own = Eigen::Index(q.g.size()) - kept;
	if (own == 0)
		return q;
	const Eigen::LDLT<Eigen::MatrixXd> solve(q.H.bottomRightCorner(own, own));
	const Eigen::MatrixXd across = q.H.topRightCorner(kept, own);
	return { q.H.topLeftCorner(kept, kept) - across * solve.solve(across.transpose()), q.g.head(kept) - across * solve.solve(q.g.tail(own)),
		q.squares - q.g.tail(own).dot(solve.solve(q.g.tail(own))), q.count };
}

Quadratic OfPhotograph(ceres::Problem& problem, const PhotographBlocks& photograph, const std::vector<double*>& shared, int size, int most)
{
	std::vector<double*> blocks = shared;
	if (!problem.IsParameterBlockConstant(photograph.pose))
		blocks.push_back(photograph.pose);
	return Reduced(Expand(problem, photograph.residuals, blocks, most), size);
}

int TangentSize(const ceres::Problem& problem, const std::vector<double*>& blocks)
{
	int size = 0;
	for (const double* b : blocks)
		size += problem.ParameterBlockTangentSize(b);
	return size;
}

std::vector<double*> SharedBlocks(const ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<PhotographBlocks>& photographs)
{
	std::set<const double*> done;
	for (const PhotographBlocks& p : photographs)
		done.insert(p.pose);
	std::vector<double*> shared, blocks;
	for (ceres::ResidualBlockId r : residuals)
	{
		problem.GetParameterBlocksForResidualBlock(r, &blocks);
		for (double* block : blocks)
			if (!problem.IsParameterBlockConstant(block) && done.insert(block).second)
				shared.push_back(block);
	}
	return shared;
}

std::vector<ceres::ResidualBlockId> Others(const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<PhotographBlocks>& photographs)
{
	std::set<ceres::ResidualBlockId> taken;
	for (const PhotographBlocks& p : photographs)
	{
		taken.insert(p.residuals.begin(), p.residuals.end());
		taken.insert(p.beside.begin(), p.beside.end());
	}
	std::vector<ceres::ResidualBlockId> others;
	for (ceres::ResidualBlockId r : residuals)
		if (!taken.count(r))
			others.push_back(r);
	return others;
}

Eigen::MatrixXd FromTangent(const ceres::Problem& problem, const std::vector<double*>& blocks)
{
	int rows = 0, columns = 0;
	for (const double* b : blocks)
	{
		rows += problem.ParameterBlockSize(b);
		columns += problem.ParameterBlockTangentSize(b);
	}
	Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, columns);
	rows = columns = 0;
	for (const double* b : blocks)
	{
		const int size = problem.ParameterBlockSize(b), tangent = problem.ParameterBlockTangentSize(b);
		Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J = Eigen::MatrixXd::Identity(size, tangent);
		if (const ceres::Manifold* manifold = problem.GetManifold(b))
			manifold->PlusJacobian(b, J.data());
		all.block(rows, columns, size, tangent) = J;
		rows += size;
		columns += tangent;
	}
	return all;
}

}
