// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/quadratic.h"

#include <ceres/crs_matrix.h>
#include <ceres/manifold.h>

#include <Eigen/Cholesky>

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

Quadratic Expand(ceres::Problem& problem, const std::vector<ceres::ResidualBlockId>& residuals, const std::vector<double*>& blocks)
{
	ceres::Problem::EvaluateOptions options;
	options.residual_blocks = residuals;
	options.parameter_blocks = blocks;
	std::vector<double> r;
	ceres::CRSMatrix J;
	problem.Evaluate(options, nullptr, &r, nullptr, &J);
	Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(J.num_rows, J.num_cols);
	for (int row = 0; row < J.num_rows; ++row)
		for (int k = J.rows[size_t(row)]; k < J.rows[size_t(row) + 1]; ++k)
			dense(row, J.cols[size_t(k)]) = J.values[size_t(k)];
	const Eigen::Map<const Eigen::VectorXd> residual(r.data(), Eigen::Index(r.size()));
	return { dense.transpose() * dense, dense.transpose() * residual, residual.squaredNorm(), int(r.size()) };
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

Quadratic OfPhotograph(ceres::Problem& problem, const PhotographBlocks& photograph, const std::vector<double*>& shared, int size)
{
	std::vector<double*> blocks = shared;
	if (!problem.IsParameterBlockConstant(photograph.pose))
		blocks.push_back(photograph.pose);
	return Reduced(Expand(problem, photograph.residuals, blocks), size);
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
