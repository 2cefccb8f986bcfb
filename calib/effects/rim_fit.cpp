// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/rim_fit.h"

#include "base/robust.h"
#include "solve/least_squares.h"

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Residuals beyond so many standard deviations count linearly.
const double HUBER = 3;

/// Of the grid from which another rim starts: radii in radii of the lens, distances in focal lengths.
const double RADII[] = { 1.02, 1.1, 1.25, 1.5, 2 }, DISTANCES[] = { 0.1, 0.25, 0.5, 0.8 };
const size_t STARTS = 4;
/// Of the cost, relatively: what a rim beside another changes at least where it cuts.
const double CUTS_NOTHING = 1e-9;
/// A rim much smaller than the lens would be its aperture, one much larger none.
const double LEAST_RADIUS = 0.8, MOST_RADIUS = 20;
/// Shares of a rim's distance from the lens to the sensor, or of 100 times that before the lens.
const double LEAST_DISTANCE = 0.01, MOST_DISTANCE = 0.95;

/// Ceres's numeric derivatives step by a share of the number, which must not be near 0.
const double OFFSET = 10;

/// Of a residual in sigmas: its square counts as Huber's cost does.
double Robust(double r) { return std::abs(r) <= HUBER ? r : std::copysign(std::sqrt(2 * HUBER * std::abs(r) - HUBER * HUBER), r); }

std::vector<double> NumbersOf(const Rims& rims)
{
	std::vector<double> x;
	for (const tilt_lens::Rim& rim : rims)
	{
		x.push_back(OFFSET + std::log(rim.radius));
		x.push_back(OFFSET + std::log(std::abs(rim.distance)));
	}
	return x;
}

void FromNumbers(const double* x, Rims& rims)
{
	for (tilt_lens::Rim& rim : rims)
	{
		rim.radius = std::exp(*x++ - OFFSET);
		rim.distance = std::copysign(std::exp(*x++ - OFFSET), rim.distance);
	}
}

/// What the columns span.
Eigen::MatrixXd BasisOf(const Eigen::MatrixXd& columns)
{
	const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
	return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

}

/// Residuals that share numbers which are projected out.
struct RimFit::Block
{
	bool light;
	std::vector<size_t> rows;   ///< of samples or edges
	Eigen::VectorXd weight;
	Eigen::MatrixXd basis;      ///< orthonormal columns
};

RimFit::RimFit(const FalloffFit& light, std::vector<size_t> light_group, std::vector<EdgeShift> edges, size_t first_edge_group)
	: light_(light), light_group_(std::move(light_group)), edges_(std::move(edges)), first_edge_group_(first_edge_group)
{
	groups_ = light_group_.empty() ? 0 : *std::max_element(light_group_.begin(), light_group_.end()) + 1;
	if (!edges_.empty())
		groups_ = std::max(groups_, first_edge_group_ + edges_.back().photo + 1);
}

std::vector<RimFit::Block> RimFit::Blocks(Part part, size_t group) const
{
	const auto wanted = [&](size_t its) { return (its == group) == (part == Part::ONLY); };
	std::vector<Block> blocks(1);
	blocks[0].light = true;
	size_t gains = 0, lights = 0;
	for (size_t k = 0; k < light_.samples.size(); ++k)
		if (wanted(light_group_[k]))
		{
			blocks[0].rows.push_back(k);
			gains = std::max(gains, light_.samples[k].gain + 1);
			lights = std::max(lights, light_.samples[k].light + 1);
		}
	for (size_t k = 0; k < edges_.size(); ++k)
		if (wanted(first_edge_group_ + edges_[k].photo))
		{
			if (blocks.back().light || edges_[blocks.back().rows[0]].photo != edges_[k].photo)
				blocks.push_back({ false, {}, {}, {} });
			blocks.back().rows.push_back(k);
		}
	for (Block& block : blocks)
	{
		const long n = long(block.rows.size()), columns = block.light ? long(gains + (light_.gradients ? 2 * lights : 0)) : edges_.empty() ? 0 : edges_[0].nuisance.size();
		block.weight.resize(n);
		Eigen::MatrixXd nuisance = Eigen::MatrixXd::Zero(n, columns);
		for (long i = 0; i < n; ++i)
			if (block.light)
			{
				const FalloffSample& s = light_.samples[block.rows[size_t(i)]];
				block.weight[i] = 1 / std::hypot(s.sigma, light_.model_sigma);
				nuisance(i, long(s.gain)) = 1;
				for (size_t k = 0; light_.gradients && k < 2; ++k)
					nuisance(i, long(gains + 2 * s.light + k)) = s.place[k];
			}
			else
			{
				const EdgeShift& e = edges_[block.rows[size_t(i)]];
				block.weight[i] = 1 / std::hypot(e.sigma, edge_sigma_);
				nuisance.row(i) = e.nuisance.transpose();
			}
		block.basis = n ? BasisOf(block.weight.asDiagonal() * nuisance) : nuisance;
	}
	return blocks;
}

Eigen::VectorXd RimFit::Evaluate(const std::vector<Block>& blocks, const Rims& rims) const
{
	long total = 0;
	for (const Block& block : blocks)
		total += long(block.rows.size());
	Eigen::VectorXd all(total);
	long at = 0;
	for (const Block& block : blocks)
	{
		Eigen::VectorXd r(long(block.rows.size()));
		for (long i = 0; i < r.size(); ++i)
			if (block.light)
			{
				const FalloffSample& s = light_.samples[block.rows[size_t(i)]];
				r[i] = LogLight(light_, s, rims) - s.log_value;
			}
			else
			{
				const EdgeShift& e = edges_[block.rows[size_t(i)]];
				const Opening open = OpeningOf(e.view, light_.lens_radius, light_.image_distance, rims);
				r[i] = e.by_x * open.x + e.by_y * open.y - e.measured;
			}
		r.array() *= block.weight.array();
		all.segment(at, r.size()) = r - block.basis * (block.basis.transpose() * r);
		at += r.size();
	}
	return all.unaryExpr(&Robust);
}

std::optional<double> RimFit::Solve(const std::vector<Block>& blocks, Rims& rims, int at_most) const
{
	int residuals = 0;
	for (const Block& block : blocks)
		residuals += int(block.rows.size());
	if (residuals == 0)   // the only group is left out
		return std::nullopt;
	const auto evaluate = [&](const double* const* x, double* into)
	{
		Rims at = rims;
		FromNumbers(*x, at);
		const Eigen::VectorXd r = Evaluate(blocks, at);
		std::copy(r.data(), r.data() + r.size(), into);
		return true;
	};
	ceres::NumericDiffOptions steps;
	steps.relative_step_size = 1e-5;
	auto* const cost = new ceres::DynamicNumericDiffCostFunction<decltype(evaluate), ceres::FORWARD>(&evaluate, ceres::DO_NOT_TAKE_OWNERSHIP, steps);
	std::vector<double> x = NumbersOf(rims);
	cost->AddParameterBlock(int(x.size()));
	cost->SetNumResiduals(residuals);
	ceres::Problem problem;
	problem.AddResidualBlock(cost, nullptr, x.data());
	for (size_t k = 0; k < rims.size(); ++k)
	{
		const double reach = rims[k].distance < 0 ? light_.image_distance : 100 * light_.image_distance;
		problem.SetParameterLowerBound(x.data(), int(2 * k), OFFSET + std::log(LEAST_RADIUS * light_.lens_radius));
		problem.SetParameterUpperBound(x.data(), int(2 * k), OFFSET + std::log(MOST_RADIUS * light_.lens_radius));
		problem.SetParameterLowerBound(x.data(), int(2 * k + 1), OFFSET + std::log(LEAST_DISTANCE * light_.image_distance));
		problem.SetParameterUpperBound(x.data(), int(2 * k + 1), OFFSET + std::log(MOST_DISTANCE * reach));
		for (size_t i = 2 * k; i < 2 * k + 2; ++i)
			x[i] = std::clamp(x[i], problem.GetParameterLowerBound(x.data(), int(i)), problem.GetParameterUpperBound(x.data(), int(i)));
	}
	LeastSquares how{ ceres::DENSE_QR, at_most ? at_most : 100, 1e-6 };
	how.may_stop_early = at_most > 0;
	const std::optional<double> final_cost = SolveLeastSquares(how, problem);
	FromNumbers(x.data(), rims);
	return final_cost;
}

std::optional<double> RimFit::Minimise(Rims& rims, size_t left_out, bool few_iterations) const { return Solve(Blocks(Part::WITHOUT, left_out), rims, few_iterations ? 6 : 0); }

void RimFit::LearnSigmas(const Rims& rims)
{
	// Blocks' residuals in sigmas, robust: medians do not mind.
	const std::vector<Block> blocks = Blocks(Part::WITHOUT, NONE);
	const Eigen::VectorXd r = Evaluate(blocks, rims);
	std::vector<double> light, edges;
	long at = 0;
	for (const Block& block : blocks)
		for (long i = 0; i < long(block.rows.size()); ++i, ++at)
			(block.light ? light : edges).push_back(r[at] / block.weight[i]);
	light_.model_sigma = std::max(RobustSigma(std::move(light)), 1e-4);
	if (!edges.empty())
		edge_sigma_ = std::max(RobustSigma(std::move(edges)), 1e-3);
}

bool RimFit::Search(Rims& rims, int distance_sign, double focal_length)
{
	LearnSigmas(rims);
	std::vector<std::pair<double, Rims>> starts;
	const std::vector<Block> blocks = Blocks(Part::WITHOUT, NONE);
	if (distance_sign == 0)
		starts.emplace_back(0, rims);
	else
		// The first rim must give way where the second cuts: begin with a share of each.
		for (const double first : { 1.0, 0.6 })
		{
			Rims given_way = rims;
			given_way[0].distance *= first;
			given_way[0].radius = light_.lens_radius + first * (given_way[0].radius - light_.lens_radius);
			const double alone = Evaluate(blocks, given_way).squaredNorm();
			for (const double radius : RADII)
				for (const double distance : DISTANCES)
				{
					Rims start = given_way;
					start.push_back({ radius * light_.lens_radius, distance_sign * distance * focal_length });
					const double cost = Evaluate(blocks, start).squaredNorm();
					// One that cuts nothing has no slope to move by; as cheap as the first alone, such starts would crowd out the others.
					if (std::abs(cost - alone) > CUTS_NOTHING * alone)
						starts.emplace_back(cost, start);
				}
		}
	const size_t count = std::min(STARTS, starts.size());
	std::partial_sort(starts.begin(), starts.begin() + long(count), starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	std::optional<double> best;
	for (size_t k = 0; k < count; ++k)
	{
		// Enough to choose between starts.
		const std::optional<double> cost = Solve(blocks, starts[k].second, 15);
		if (cost && (!best || *cost < *best))
		{
			best = cost;
			rims = starts[k].second;
		}
	}
	if (!best)
		return false;
	LearnSigmas(rims);
	return Minimise(rims).has_value();
}

double RimFit::ChiSquared(const Rims& rims) const { return Evaluate(Blocks(Part::WITHOUT, NONE), rims).squaredNorm(); }

double RimFit::MeanOfGroup(const Rims& rims, size_t group, size_t& count) const
{
	const Eigen::VectorXd r = Evaluate(Blocks(Part::ONLY, group), rims);
	count = size_t(r.size());
	return count ? r.squaredNorm() / double(count) : 0;
}

bool RimFit::Covariance(const Rims& rims, Eigen::MatrixXd& result) const
{
	const std::vector<Block> blocks = Blocks(Part::WITHOUT, NONE);
	const Eigen::VectorXd here = Evaluate(blocks, rims);
	const std::vector<double> x = NumbersOf(rims);
	Eigen::MatrixXd J(here.size(), long(x.size()));
	long columns = 0;
	for (const Block& block : blocks)
		columns += block.basis.cols();
	for (size_t k = 0; k < x.size(); ++k)
	{
		const double step = 1e-4;
		Rims above = rims, below = rims;
		std::vector<double> y = x;
		y[k] += step;
		FromNumbers(y.data(), above);
		y[k] -= 2 * step;
		FromNumbers(y.data(), below);
		J.col(long(k)) = (Evaluate(blocks, above) - Evaluate(blocks, below)) / (2 * step);
	}
	const Eigen::MatrixXd information = J.transpose() * J;
	if (!(information.determinant() > 1e-12 * information.diagonal().prod()))
		return false;
	result = information.inverse() * (here.squaredNorm() / double(std::max<long>(1, here.size() - columns - long(x.size()))));
	return result.allFinite() && (result.diagonal().array() > 0).all();
}

}
