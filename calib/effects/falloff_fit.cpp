// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/falloff_fit.h"

#include "lens/angles.h"
#include "model/projection.h"
#include "base/robust.h"
#include "solve/least_squares.h"

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include "lens/optical_vignetting.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Residuals beyond so many standard deviations count linearly.
const double HUBER = 3;

/// Patches darker than this share of their light are not believed: the logarithm stays finite.
const double LEAST_SHARE = 1e-3;

/// Of the search: the rim's radius in radii of the lens, its distance in focal lengths.
const double RADII[] = { 0.85, 0.9, 0.95, 1, 1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2, 2.5, 3 }, DISTANCES[] = { 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.5, 2, 3 };
/// A rim much smaller than the lens would be its aperture.
const double LEAST_RADIUS = 0.8;
/// Starts that are followed to their minimum.
const size_t STARTS = 5;

template<typename T>
T LogOpenShare(const FalloffSample& s, double lens_radius, const T* rim)
{
	using std::exp;
	using std::log;
	const T share = tilt_lens::OpenShare(tilt_lens::ViewOfRim(Lifted<T>(s.n), Lifted<T>(s.v), T(s.kappa), exp(rim[1])), T(lens_radius * s.opening), exp(rim[0]));
	return share > T(LEAST_SHARE) ? log(share) : T(std::log(LEAST_SHARE));
}

struct FalloffCost
{
	const FalloffSample& s;
	double lens_radius, weight, natural;
	bool optical;

	template<typename T>
	bool operator()(const T* rim, const T* gain, const T* gradient, T* residual) const
	{
		T predicted = *gain + gradient[0] * T(s.place[0]) + gradient[1] * T(s.place[1]) + T(natural);
		if (optical)
			predicted += LogOpenShare(s, lens_radius, rim);
		residual[0] = T(weight) * (predicted - T(s.log_value));
		return true;
	}
};

double Weight(const FalloffFit& fit, const FalloffSample& s) { return 1 / std::hypot(s.sigma, fit.model_sigma); }

void Build(const FalloffFit& fit, FalloffUnknowns& x, ceres::Problem& problem)
{
	for (const FalloffSample& s : fit.samples)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<FalloffCost, 1, 2, 1, 2>(new FalloffCost{ s, fit.lens_radius, Weight(fit, s), fit.natural ? s.log_natural : 0, fit.optical }),
			new ceres::HuberLoss(HUBER), x.rim, &x.gain[s.gain], x.gradient[s.light].data());
	if (!fit.optical)
		problem.SetParameterBlockConstant(x.rim);
	else
	{
		problem.SetParameterLowerBound(x.rim, 0, std::log(LEAST_RADIUS * fit.lens_radius));
		problem.SetParameterUpperBound(x.rim, 0, std::log(100 * fit.lens_radius));
		problem.SetParameterLowerBound(x.rim, 1, std::log(0.1 * fit.lens_radius));
		problem.SetParameterUpperBound(x.rim, 1, std::log(1000 * fit.lens_radius));
	}
	if (!fit.gradients)
		for (std::array<double, 2>& gradient : x.gradient)
			if (problem.HasParameterBlock(gradient.data()))
				problem.SetParameterBlockConstant(gradient.data());
}

/// Sum of the residuals' costs as the fit weighs them.
double Cost(const FalloffFit& fit, const FalloffUnknowns& x)
{
	double sum = 0;
	for (const FalloffSample& s : fit.samples)
	{
		const double r = std::abs(fit.Residual(s, x)) * Weight(fit, s);
		sum += r < HUBER ? r * r : 2 * HUBER * r - HUBER * HUBER;
	}
	return sum;
}

/// The best of the grid, each with the lighting that suits it, best first.
std::vector<FalloffUnknowns> Starts(const FalloffFit& fit, double focal_length, const FalloffUnknowns& from)
{
	std::vector<std::pair<double, FalloffUnknowns>> all;
	for (const double radius : RADII)
		for (const double distance : DISTANCES)
		{
			FalloffUnknowns x = from;
			x.rim[0] = std::log(radius * fit.lens_radius);
			x.rim[1] = std::log(distance * focal_length);
			fit.SolveLighting(x);
			all.emplace_back(Cost(fit, x), x);
		}
	const size_t count = std::min(STARTS, all.size());
	std::partial_sort(all.begin(), all.begin() + long(count), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	std::vector<FalloffUnknowns> starts;
	for (size_t k = 0; k < count; ++k)
		starts.push_back(all[k].second);
	return starts;
}

}

double LogLight(const FalloffFit& fit, const FalloffSample& s, const std::vector<tilt_lens::Rim>& rims)
{
	const double radius = fit.lens_radius * s.opening, share = OpeningOf(s, fit.lens_radius, fit.image_distance, rims).area / (tilt_lens::Pi * radius * radius);
	return (fit.natural ? s.log_natural : 0) + std::log(std::max(share, LEAST_SHARE));
}

double FalloffFit::Effects(const FalloffSample& s, const double* rim) const
{
	if (!rims.empty())
		return LogLight(*this, s, rims);
	return (natural ? s.log_natural : 0) + (optical ? LogOpenShare(s, lens_radius, rim) : 0);
}

double FalloffFit::Residual(const FalloffSample& s, const FalloffUnknowns& x) const
{
	const auto& gradient = x.gradient[s.light];
	return x.gain[s.gain] + gradient[0] * s.place[0] + gradient[1] * s.place[1] + Effects(s, x.rim) - s.log_value;
}

void FalloffFit::SolveLighting(FalloffUnknowns& x) const
{
	const long gains = long(x.gain.size()), n = gains + (gradients ? 2 * long(x.gradient.size()) : 0);
	Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
	Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
	for (const FalloffSample& s : samples)
	{
		const double weight = std::pow(Weight(*this, s), 2), left = s.log_value - Effects(s, x.rim);
		const long at[] = { long(s.gain), gains + 2 * long(s.light), gains + 2 * long(s.light) + 1 };
		const double factor[] = { 1, s.place[0], s.place[1] };
		for (int i = 0; i < (gradients ? 3 : 1); ++i)
		{
			b[at[i]] += weight * factor[i] * left;
			for (int k = 0; k < (gradients ? 3 : 1); ++k)
				A(at[i], at[k]) += weight * factor[i] * factor[k];
		}
	}
	// A photograph of one patch has no gradient: none is taken.
	A.diagonal().array() += 1e-9 * (A.diagonal().maxCoeff() + 1e-300);
	const Eigen::VectorXd solved = A.ldlt().solve(b);
	for (long k = 0; k < gains; ++k)
		x.gain[size_t(k)] = solved[k];
	for (long k = 0; gradients && k < long(x.gradient.size()); ++k)
		x.gradient[size_t(k)] = { solved[gains + 2 * k], solved[gains + 2 * k + 1] };
}

std::optional<double> FalloffFit::Minimise(FalloffUnknowns& x) const
{
	ceres::Problem problem;
	Build(*this, x, problem);
	return SolveLeastSquares({ ceres::DENSE_SCHUR, 200, 1e-9 }, problem);
}

bool FalloffFit::Search(double focal_length, FalloffUnknowns& x)
{
	for (int round = 0; round < 2; ++round)
	{
		std::vector<FalloffUnknowns> starts{ x };
		if (round == 0 && optical)
			starts = Starts(*this, focal_length, x);
		else
			SolveLighting(starts[0]);
		std::optional<double> best;
		for (FalloffUnknowns& start : starts)
		{
			const std::optional<double> cost = Minimise(start);
			if (cost && (!best || *cost < *best))
			{
				best = cost;
				x = start;
			}
		}
		if (!best)
			return false;
		std::vector<double> residuals;
		for (const FalloffSample& s : samples)
			residuals.push_back(Residual(s, x));
		model_sigma = std::max(RobustSigma(std::move(residuals)), 1e-4);
	}
	return true;
}

bool FalloffFit::Covariance(FalloffUnknowns& x, Eigen::Matrix2d& result) const
{
	ceres::Problem problem;
	Build(*this, x, problem);
	if (!optical)
		return false;
	// Not ceres::Covariance: a rim that cuts nothing is no error, and it would write one.
	ceres::Problem::EvaluateOptions options;
	problem.GetParameterBlocks(&options.parameter_blocks);
	const auto rim = std::find(options.parameter_blocks.begin(), options.parameter_blocks.end(), x.rim);
	std::iter_swap(options.parameter_blocks.begin(), rim);
	double cost = 0;
	ceres::CRSMatrix jacobian;
	problem.Evaluate(options, &cost, nullptr, nullptr, &jacobian);
	Eigen::MatrixXd J = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
	for (int row = 0; row < jacobian.num_rows; ++row)
		for (int k = jacobian.rows[size_t(row)]; k < jacobian.rows[size_t(row) + 1]; ++k)
			J(row, jacobian.cols[size_t(k)]) = jacobian.values[size_t(k)];
	const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> lighting(J.rightCols(J.cols() - 2));
	// What the lighting cannot take up.
	const Eigen::MatrixXd own = J.leftCols(2) - J.rightCols(J.cols() - 2) * lighting.solve(J.leftCols(2));
	const Eigen::Matrix2d information = own.transpose() * own;
	const double freedom = std::max<long>(1, J.rows() - J.cols());
	if (!(information.determinant() > 1e-12 * information.diagonal().prod()))
		return false;
	result = information.inverse() * (2 * cost / freedom);
	return result.allFinite() && result(0, 0) > 0 && result(1, 1) > 0;
}

}
