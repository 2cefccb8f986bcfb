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

/// Less than this part of what is known of a number, were the others known, is rounding.
const double LEAST_TOLD = 1e-12;

/// What photographs have in common, and what is known of it beside them.
struct Common
{
	ceres::Problem& problem;
	std::vector<ceres::ResidualBlockId> residuals = {}, others = {};
	std::vector<double*> shared = {};
	int size = 0;

	Common(ceres::Problem& of, const std::vector<PhotographBlocks>& photographs) : problem(of)
	{
		problem.GetResidualBlocks(&residuals);
		shared = SharedBlocks(problem, residuals, photographs);
		size = TangentSize(problem, shared);
		others = Others(residuals, photographs);
	}

	Quadratic Nothing() const { return { Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0, 0 }; }
	Quadratic Prior() const { return others.empty() ? Nothing() : Expand(problem, others, shared); }
	Quadratic Beside(const PhotographBlocks& p) const { return p.beside.empty() ? Nothing() : Expand(problem, p.beside, shared); }
};

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

PlacesOfBlocks::PlacesOfBlocks(const ceres::Problem& of, const std::vector<double*>& shared) : problem(of)
{
	int at = 0;
	for (const double* b : shared)
	{
		first[b] = at;
		at += problem.ParameterBlockSize(b);
	}
}

std::vector<int> PlacesOfBlocks::Of(const std::vector<const double*>& blocks) const
{
	std::vector<int> at;
	for (const double* b : blocks)
		for (int i = 0; i < problem.ParameterBlockSize(b); ++i)
			at.push_back(first.count(b) ? first.at(b) + i : -1);
	return at;
}

CovarianceByPhotographs::CovarianceByPhotographs(PlacesOfBlocks of, Eigen::MatrixXd of_shared, double rms) : places(std::move(of)), c(std::move(of_shared)), held_out(rms) {}

Eigen::MatrixXd CovarianceByPhotographs::Of(const std::vector<const double*>& blocks) const
{
	const std::vector<int> at = places.Of(blocks);
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
	const Common common(problem, photographs);
	Quadratic total = common.Prior();
	std::vector<Quadratic> each, predicted;
	for (const PhotographBlocks& p : photographs)
	{
		each.push_back(OfPhotograph(problem, p, common.shared, common.size));
		predicted.push_back(p.predicted ? OfPhotograph(problem, p, common.shared, common.size, p.predicted) : each.back());
		each.back() += common.Beside(p);
		total.H += each.back().H;
	}
	const std::optional<LeftOutEach> left_out = Jackknife(predicted, each, total, photographs);
	if (!left_out)
		return std::nullopt;
	const Eigen::MatrixXd out = FromTangent(problem, common.shared);
	return CovarianceByPhotographs(PlacesOfBlocks(problem, common.shared), out * left_out->covariance * out.transpose(), left_out->held_out);
}

std::optional<PartsAnswer> AnswerOfPart(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs, const std::vector<PhotographBlocks>& part, const std::vector<const double*>& blocks)
{
	const Common common(problem, photographs);
	Quadratic total = common.Prior();
	int unknowns = common.size;
	for (const PhotographBlocks& p : part)
	{
		total += OfPhotograph(problem, p, common.shared, common.size);
		total += common.Beside(p);
		unknowns += problem.IsParameterBlockConstant(p.pose) ? 0 : problem.ParameterBlockTangentSize(p.pose);
	}
	// Scaled to a diagonal of ones, so that an eigenvalue is what is left of a number's knowledge when the others are unknown.
	const Eigen::VectorXd scale = total.H.diagonal().cwiseSqrt();
	if (!(scale.minCoeff() > 0))
		return std::nullopt;
	const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.cwiseInverse().asDiagonal() * total.H * scale.cwiseInverse().asDiagonal());
	if (!(eigen.eigenvalues().minCoeff() > LEAST_TOLD))
		return std::nullopt;
	const Eigen::MatrixXd out = FromTangent(problem, common.shared) * scale.cwiseInverse().asDiagonal() * eigen.eigenvectors();
	const Eigen::VectorXd along = eigen.eigenvectors().transpose() * scale.cwiseInverse().cwiseProduct(total.g), inverse = eigen.eigenvalues().cwiseInverse();
	const double squares = total.squares - along.dot(inverse.cwiseProduct(along)), unit = squares / std::max(total.count - unknowns, 1);
	const Eigen::VectorXd step = -(out * inverse.cwiseProduct(along)), variance = unit * (out.cwiseAbs2() * inverse);
	const std::vector<int> at = PlacesOfBlocks(problem, common.shared).Of(blocks);
	PartsAnswer answer{ Eigen::VectorXd::Zero(Eigen::Index(at.size())), Eigen::VectorXd::Zero(Eigen::Index(at.size())) };
	for (size_t i = 0; i < at.size(); ++i)
		if (at[i] >= 0)
		{
			answer.step[Eigen::Index(i)] = step[at[i]];
			answer.variance[Eigen::Index(i)] = variance[at[i]];
		}
	return answer;
}

}
