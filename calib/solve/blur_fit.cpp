// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/blur_fit.h"

#include "model/predict.h"
#include "model/projection.h"
#include <tiltcal/error.h>
#include "model/footprint.h"
#include "edge/soft_radius.h"
#include "solve/each_edge.h"
#include "solve/prior_cost.h"
#include "base/robust.h"
#include "solve/solve_geometry.h"
#include "solve/least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

struct BlurCost
{
	LensModel model;
	const Observation& o;
	double weight, w_mm;

	template<typename T>
	bool operator()(const T* d, const T* floor_squared, const T* power, const T* curvature, const T* state, T* residual) const
	{
		const Vec3<T> q = PlaneOfState(model, power, state, T(w_mm));
		const Vec3<T> n = tilt_lens::LensFromPlane(q, T(1 / w_mm)).normal;
		const T squared = SquaredFootprintWidth(*d, q, n, curvature, Lifted<T>(o.P), Lifted<T>(o.gradient)) + *floor_squared;
		residual[0] = weight * (SoftDiameterOfSquare(squared) - T(SoftDiameter(o.blur)));
		return true;
	}
};

using BlurCostFunction = ceres::AutoDiffCostFunction<BlurCost, 1, 1, 1, 1, 2, 3>;
const OpeningNumbers BY_APERTURE{ 0, 0 };

void Build(const BlurFit& fit, ceres::Problem& problem, Unknowns& x, Free free, size_t state)
{
	for (const Observation& o : fit.observations)
	{
		if (free != Free::EVERYTHING && o.state != state)
			continue;
		const double weight = 1 / std::hypot(o.sigma, fit.model_sigma);
		ceres::CostFunction* const cost = new BlurCostFunction(new BlurCost{ fit.model, o, weight, fit.w_mm });
		AddAtStop(cost, BY_APERTURE, new ceres::HuberLoss(2.0), { &x.d, &x.floor_squared, &x.power, x.curvature.data(), x.state[o.state].data() }, o.stop, x.stops, problem);
	}
	if (free == Free::EVERYTHING)
		AddStopPriors(fit.stops, x.stops, problem);
	else
		HoldStops(x.stops, problem);
	if (!fit.priors.empty() && (free == Free::EVERYTHING || state == 0) && problem.HasParameterBlock(x.state[0].data()))
	{
		double* const w = const_cast<double*>(&fit.w_mm);   // held
		AddPriors(fit.priors, fit.model, { w, 1, &x.d, &x.power, x.state[0].data() }, problem);
		problem.SetParameterBlockConstant(w);
	}
	HoldUnused(fit.model, x, problem);
	if (free != Free::EVERYTHING)
		problem.SetParameterBlockConstant(x.curvature.data());
	if (free == Free::ONE_STATE)
	{
		problem.SetParameterBlockConstant(&x.power);
		problem.SetParameterBlockConstant(&x.d);
		problem.SetParameterBlockConstant(&x.floor_squared);
	}
}

}

void HoldUnused(LensModel model, Unknowns& x, ceres::Problem& problem)
{
	for (size_t s = 0; s < x.state.size(); ++s)
	{
		double* const own = x.state[s].data();
		if (!problem.HasParameterBlock(own))
			continue;
		const bool held = s == 0 && !x.untilted_free;
		if (HasFreePlanes(model) && held)
			problem.SetManifold(own, new ceres::SubsetManifold(3, { 0, 1 }));
		if (model == LensModel::RIGID && held)
			problem.SetParameterBlockConstant(own);
		if (model == LensModel::RIGID && !held)
			problem.SetManifold(own, new ceres::SubsetManifold(3, { 2 }));
	}
	if (HasFreePlanes(model))
		problem.SetParameterBlockConstant(&x.power);
	if (!IsCurved(model))
		problem.SetParameterBlockConstant(x.curvature.data());
	else if (model == LensModel::BOWL)
		problem.SetManifold(x.curvature.data(), new ceres::SubsetManifold(2, { 1 }));
}

Eigen::MatrixXd PlanesByUnknowns(LensModel model, const Unknowns& x, double w_mm)
{
	using At = LensCovariance::At;
	using Number = LensCovariance::Number;
	using Jet = ceres::Jet<double, 5>;
	const size_t states = x.state.size();
	Eigen::MatrixXd J = Eigen::MatrixXd::Zero(LensCovariance::Size(states, x.stops.Further()), UnknownIndex::Size(x));
	for (size_t k = 1; k <= x.stops.Further(); ++k)
		J(LensCovariance::OfStop(states, k).index, UnknownIndex::OfState(states) + int(k) - 1) = 1;
	J(At(Number::IMAGE_DISTANCE).index, UnknownIndex::W) = 1;
	J(At(Number::APERTURE_DIAMETER).index, UnknownIndex::D) = 1;
	J(At(Number::FLOOR_SQUARED).index, UnknownIndex::FLOOR_SQUARED) = 1;
	J(At(Number::CURVATURE).index, UnknownIndex::CURVATURE) = 1;
	J(At(Number::HALF_CURVATURE_DIFFERENCE).index, UnknownIndex::CURVATURE + 1) = 1;
	for (size_t s = 0; s < states; ++s)
	{
		const StateNumbers& own = x.state[s];
		const Jet power(x.power, 0), state[3] = { Jet(own[0], 1), Jet(own[1], 2), Jet(own[2], 3) };
		const Vec3<Jet> q = PlaneOfState(model, &power, state, Jet(w_mm, 4));
		const std::pair<LensCovariance::Axis, const Jet*> rows[] = { { LensCovariance::Axis::X, &q.x }, { LensCovariance::Axis::Y, &q.y }, { LensCovariance::Axis::Z, &q.z } };
		for (const auto& [axis, value] : rows)
		{
			const int row = At(s, axis).index;
			J(row, UnknownIndex::W) = value->v[4];
			J(row, UnknownIndex::POWER) = value->v[0];
			J.block<1, 3>(row, UnknownIndex::OfState(s)) = value->v.segment<3>(1).transpose();
		}
	}
	return J;
}

LensCovariance CovarianceOfPlanes(LensModel model, const Unknowns& x, double w_mm, const Eigen::MatrixXd& of_unknowns)
{
	const Eigen::MatrixXd J = PlanesByUnknowns(model, x, w_mm);
	return LensCovariance(J * of_unknowns * J.transpose());
}

std::vector<Observation> Observe(const Task& task, const Geometry& g)
{
	std::vector<Observation> all;
	ForEachEdge(task, [&](size_t s, size_t p, const Edge& e)
	{
		const Vec3<double> P = EdgeInCamera(task, g.states[s].poses[p], e);
		all.push_back({ s, p, P, EdgeGradient(g, s, P, e), e.blur, e.blur_sigma, task.states[s].photos[p].stop });
	});
	return all;
}

double BlurFit::Residual(const Observation& o, const Unknowns& x) const
{
	double r = 0;
	const double d = x.d * x.stops.Ratio(o.stop);
	BlurCost{ model, o, 1, w_mm }(&d, &x.floor_squared, &x.power, x.curvature.data(), x.state[o.state].data(), &r);
	return r;
}

Vec3<double> BlurFit::Plane(const Unknowns& x, size_t state) const
{
	return PlaneOfState(model, &x.power, x.state[state].data(), w_mm);
}

std::optional<double> BlurFit::Minimise(Unknowns& x, Free free, size_t state) const
{
	ceres::Problem problem;
	Build(*this, problem, x, free, state);
	const std::optional<double> cost = SolveLeastSquares({ ceres::DENSE_QR, 200, 1e-10 }, problem);
	x.d = std::abs(x.d);
	return cost;
}

double BlurFit::Nearness() const
{
	double sum = 0;
	for (const Observation& o : observations)
		sum += 1 / o.P.z;
	return sum / double(std::max<size_t>(observations.size(), 1));
}

double BlurFit::Scale(const Unknowns& x) const
{
	std::vector<double> r;
	for (const Observation& o : observations)
		r.push_back(Residual(o, x));
	return RobustSigma(std::move(r));
}

double BlurFit::LeftOutBy(const Unknowns& x) const
{
	std::vector<double> residuals, sigmas;
	for (const Observation& o : observations)
	{
		residuals.push_back(Residual(o, x));
		sigmas.push_back(o.sigma);
	}
	return ModelScatter(residuals, sigmas, 0.01);
}

LensCovariance BlurFit::Covariance(Unknowns x, double w_sigma_mm) const
{
	ceres::Problem problem;
	Build(*this, problem, x, Free::EVERYTHING, 0);
	double cost = 0;
	problem.Evaluate(ceres::Problem::EvaluateOptions(), &cost, nullptr, nullptr, nullptr);
	ceres::Covariance::Options options;
	options.algorithm_type = ceres::DENSE_SVD;
	options.min_reciprocal_condition_number = 1e-22;
	ceres::Covariance covariance(options);
	std::vector<const double*> blocks{ &x.d, &x.floor_squared, &x.power, x.curvature.data() };
	for (StateNumbers& state : x.state)
		blocks.push_back(state.data());
	for (const double* stop : x.stops.Blocks())
		blocks.push_back(stop);
	if (!covariance.Compute(blocks, &problem))
		throw Refused("the blur does not determine the lens: photograph inclined boards whose blur differs clearly from one end to the other");
	const int n = UnknownIndex::Size(x) - 1;   // all but w
	Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> c(n, n);
	covariance.GetCovarianceMatrix(blocks, c.data());
	int free_unknowns = 0;
	for (int k = 0; k < n; ++k)
		free_unknowns += c(k, k) > 0;
	const double freedom = std::max(1, problem.NumResiduals() - free_unknowns);
	Eigen::MatrixXd with_w = Eigen::MatrixXd::Zero(n + 1, n + 1);
	with_w(UnknownIndex::W, UnknownIndex::W) = w_sigma_mm * w_sigma_mm;
	with_w.bottomRightCorner(n, n) = c * (2 * cost / freedom);
	return CovarianceOfPlanes(model, x, w_mm, with_w);
}

}
