// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/by_photographs.h"

#include "solve/quadratic.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Of all that is known in some direction, the most that one photograph may say.
const double MOST_LEVERAGE = 0.99;

struct LeftOutEach
{
	Eigen::MatrixXd covariance;
	double held_out;
};

/// Of the steps that leaving out each photograph makes. `total`: all photographs and what else is known.
std::optional<LeftOutEach> Jackknife(const std::vector<Quadratic>& predicted, const std::vector<Quadratic>& each, const Quadratic& total, const std::vector<PhotographBlocks>& photographs)
{
	const Eigen::LLT<Eigen::MatrixXd> root(total.H);
	if (root.info() != Eigen::Success)
		return std::nullopt;
	std::map<size_t, double> in_group;
	for (const PhotographBlocks& p : photographs)
		in_group[p.group] += 1;
	const auto n = total.g.size();
	Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
	double squares = 0, count = 0;
	for (size_t i = 0; i < each.size(); ++i)
	{
		// Whitened by `total`, so that an eigenvalue is the part of a direction's knowledge that this photograph brings.
		const Eigen::MatrixXd half = root.matrixL().solve(each[i].H);
		const Eigen::MatrixXd part = root.matrixL().solve(half.transpose());
		const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(part);
		if (!(eigen.eigenvalues().maxCoeff() < MOST_LEVERAGE))
			return std::nullopt;
		const Eigen::VectorXd r = root.matrixL().solve(each[i].g);
		const Eigen::VectorXd step = eigen.eigenvectors() * ((eigen.eigenvectors().transpose() * r).array() / (1 - eigen.eigenvalues().array())).matrix();
		// Its residuals there: the others' minimum lies at `step` in these coordinates.
		const Eigen::VectorXd shift = root.matrixU().solve(step);
		squares += predicted[i].squares + 2 * predicted[i].g.dot(shift) + shift.dot(predicted[i].H * shift);
		count += predicted[i].count;
		sum += (1 - 1 / in_group[photographs[i].group]) * step * step.transpose();
	}
	return LeftOutEach{ root.matrixU().solve(Eigen::MatrixXd(root.matrixU().solve(sum).transpose())), std::sqrt(squares / std::max(count, 1.0)) };
}

}

CovarianceByPhotographs::CovarianceByPhotographs(const ceres::Problem& of, const std::vector<double*>& shared, Eigen::MatrixXd of_shared, double rms) : problem(of), c(std::move(of_shared)), held_out(rms)
{
	int at = 0;
	for (const double* b : shared)
	{
		first[b] = at;
		at += problem.ParameterBlockSize(b);
	}
}

Eigen::MatrixXd CovarianceByPhotographs::Of(const std::vector<const double*>& blocks) const
{
	std::vector<int> at;
	for (const double* b : blocks)
		for (int i = 0; i < problem.ParameterBlockSize(b); ++i)
			at.push_back(first.count(b) ? first.at(b) + i : -1);
	const auto n = Eigen::Index(at.size());
	Eigen::MatrixXd picked = Eigen::MatrixXd::Zero(n, n);
	for (Eigen::Index i = 0; i < n; ++i)
		for (Eigen::Index j = 0; j < n; ++j)
			if (at[size_t(i)] >= 0 && at[size_t(j)] >= 0)
				picked(i, j) = c(at[size_t(i)], at[size_t(j)]);
	return picked;
}

std::optional<CovarianceByPhotographs> JackknifeOverPhotographs(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs)
{
	std::vector<ceres::ResidualBlockId> residuals;
	problem.GetResidualBlocks(&residuals);
	const std::vector<double*> shared = SharedBlocks(problem, residuals, photographs);
	const int size = TangentSize(problem, shared);
	Quadratic total{ Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0, 0 };
	// Priors.
	if (const std::vector<ceres::ResidualBlockId> others = Others(residuals, photographs); !others.empty())
		total = Expand(problem, others, shared);
	std::vector<Quadratic> each, predicted;
	for (const PhotographBlocks& p : photographs)
	{
		predicted.push_back(OfPhotograph(problem, p, shared, size));
		each.push_back(predicted.back());
		if (!p.beside.empty())
		{
			const Quadratic beside = Expand(problem, p.beside, shared);
			each.back().H += beside.H;
			each.back().g += beside.g;
		}
		total.H += each.back().H;
	}
	const std::optional<LeftOutEach> left_out = Jackknife(predicted, each, total, photographs);
	if (!left_out)
		return std::nullopt;
	const Eigen::MatrixXd out = FromTangent(problem, shared);
	return CovarianceByPhotographs(problem, shared, out * left_out->covariance * out.transpose(), left_out->held_out);
}

}
