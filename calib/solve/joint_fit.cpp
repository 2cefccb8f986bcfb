// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/joint_fit.h"

#include "model/lens_model.h"
#include <tiltcal/photo.h>
#include "base/robust.h"
#include "solve/block_covariance.h"
#include "solve/by_photographs.h"
#include "solve/each_edge.h"
#include "solve/edge_cost.h"
#include "solve/prior_cost.h"
#include "solve/quadratic.h"
#include "solve/solve_geometry.h"
#include "solve/least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tiltcal
{

namespace
{

static_assert(sizeof(Vec3<double>) == 3 * sizeof(double), "a block of three numbers");

EdgeBlocks<double> BlocksOf(Geometry& g, Unknowns& x, size_t s, size_t p)
{
	StateGeometry& state = g.states[s];
	return { &g.w_px, g.distortion.data(), state.principal_point.data(), PoseOf(g, s, p).data(),
		&x.d, &x.floor_squared, &x.power, x.curvature.data(), x.state[s].data(), &state.lens_centre.x, &g.pupil_magnification };
}

/// Of the blocks for a problem.
const OpeningNumbers BY_APERTURE{ 4, 0 };

/// The same for a problem.
std::vector<double*> Pointers(const EdgeBlocks<double>& b)
{
	std::vector<double*> all;
	for (const double* block : { b.w_px, b.distortion, b.principal_point, b.pose, b.d /* BY_APERTURE */, b.floor_squared, b.power, b.curvature, b.state, b.lens_centre, b.pupil_magnification })
		all.push_back(const_cast<double*>(block));
	return all;
}

EdgeWeights WeightsOf(const JointFit& fit, const Edge& e)
{
	return { 1 / std::hypot(e.offset_sigma, fit.error.offset), 1 / std::hypot(e.blur_sigma, fit.error.blur) };
}

ceres::CostFunction* CostOf(const JointFit& fit, const Edge& e, const Vec3<double>& axis)
{
	const EdgeModel edge = MakeEdgeModel(fit.task, fit.model, e, axis, fit.geometry_alone);
	const EdgeWeights weights = WeightsOf(fit, e);
	if (fit.geometry_alone)
		return NewPlaceCost(edge, weights.offset);
	if (fit.kind == Refinement::PHOTOMETRIC && !e.profile.empty())
		return NewPhotometricCost(edge, e, weights);
	return NewEdgeCost(edge, SoftDiameter(e.blur), weights);
}

/// What belongs to each photograph, or, with shared poses, to all photographs of one pose; by group and photograph.
using Photographs = std::map<std::pair<size_t, size_t>, PhotographBlocks>;

Photographs Build(const JointFit& fit, Geometry& g, Unknowns& x, ceres::Problem& problem)
{
	Photographs photographs;
	ForEachEdge(fit.task, [&](size_t s, size_t p, const Edge& e)
	{
		const size_t group = g.shared_poses ? 0 : s;
		PhotographBlocks& own = photographs[{ group, p }];
		own.pose = PoseOf(g, s, p).data();
		own.group = group;
		ceres::CostFunction* cost = CostOf(fit, e, g.states[s].lens_normal);
		// A block of n standard normal residuals has the norm sqrt(n).
		auto* const loss = new ceres::HuberLoss(2.5 * std::sqrt(double(cost->num_residuals())));
		own.residuals.push_back(AddAtStop(cost, BY_APERTURE, loss, Pointers(BlocksOf(g, x, s, p)), fit.task.states[s].photos[p].stop, x.stops, problem));
	});
	if (!fit.geometry_alone)
	{
		AddPriors(fit.task.priors, fit.model, { &g.w_px, fit.task.pitch_mm, &x.d, &x.power, x.state[0].data() }, problem);
		AddStopPriors(fit.task.stops, x.stops, problem);
	}
	else
		HoldStops(x.stops, problem);
	HoldDistortion(g, problem);
	HoldUnused(fit.model, x, problem);
	AddPrincipalPointPriors(fit.task, g, problem);
	for (size_t s = 0; s < g.states.size(); ++s)
		if (s == 0 || !g.shared_poses)
			problem.SetParameterBlockConstant(&g.states[s].lens_centre.x);
	if (!fit.geometry_alone || !g.shared_poses)
		problem.SetParameterBlockConstant(&g.pupil_magnification);
	if (!fit.geometry_alone)
		return photographs;
	for (double* block : { &x.d, &x.floor_squared, &x.power, x.curvature.data() })
		problem.SetParameterBlockConstant(block);
	if (!x.untilted_free)
		problem.SetParameterBlockConstant(x.state[0].data());
	// Of a state's numbers the tilt alone is seen: q_z hardly moves the lens normal.
	for (size_t s = x.untilted_free ? 0 : 1; s < x.state.size(); ++s)
		problem.SetManifold(x.state[s].data(), new ceres::SubsetManifold(3, { 2 }));
	return photographs;
}

/// Poses that are shared stand in every state, from its own lens centre.
void SpreadPoses(Geometry& g)
{
	if (!g.shared_poses)
		return;
	for (size_t s = 1; s < g.states.size(); ++s)
	{
		StateGeometry& state = g.states[s];
		state.poses = g.states[0].poses;
		state.pose_sigmas = g.states[0].pose_sigmas;
		for (Pose& pose : state.poses)
		{
			pose[3] -= state.lens_centre.x;
			pose[4] -= state.lens_centre.y;
			pose[5] -= state.lens_centre.z;
		}
	}
}

/// The blocks whose covariance PlanesByUnknowns takes, in its order.
std::vector<const double*> LensBlocks(const Geometry& g, const Unknowns& x)
{
	std::vector<const double*> blocks{ &g.w_px, &x.d, &x.floor_squared, &x.power, x.curvature.data() };
	for (const StateNumbers& state : x.state)
		blocks.push_back(state.data());
	for (const double* stop : x.stops.Blocks())
		blocks.push_back(stop);
	return blocks;
}

/// Every other block that has a sigma, and where that goes.
struct SigmaOf
{
	const double* block;
	int size;
	double* sigma;
};

std::vector<SigmaOf> GeometryBlocks(Geometry& g)
{
	std::vector<SigmaOf> blocks{ { g.distortion.data(), 5, g.distortion_sigma.data() }, { &g.pupil_magnification, 1, &g.pupil_magnification_sigma } };
	for (size_t s = 0; s < g.states.size(); ++s)
	{
		StateGeometry& state = g.states[s];
		blocks.push_back({ state.principal_point.data(), 2, state.principal_point_sigma.data() });
		blocks.push_back({ &state.lens_centre.x, 3, &state.lens_centre_sigma.x });
		for (size_t p = 0; p < state.poses.size() && (s == 0 || !g.shared_poses); ++p)
			blocks.push_back({ state.poses[p].data(), 6, state.pose_sigmas[p].data() });
	}
	return blocks;
}

using Pairs = std::vector<std::pair<const double*, const double*>>;

/// A shared pose stands in another state from that one's lens centre, which is of the same fit.
Pairs PosesAndCentres(const ceres::Problem& problem, const Geometry& g)
{
	Pairs pairs;
	for (size_t s = 1; s < g.states.size() && g.shared_poses; ++s)
		for (const Pose& pose : g.states[0].poses)
			if (problem.HasParameterBlock(pose.data()) && problem.HasParameterBlock(&g.states[s].lens_centre.x))
				pairs.emplace_back(pose.data(), &g.states[s].lens_centre.x);
	return pairs;
}

/// Of the places of these: of a difference. `by_edges`: the covariance of blocks.
template<typename ByEdges>
void SigmasFromCentres(const ceres::Problem& problem, const ByEdges& by_edges, const std::optional<CovarianceByPhotographs>& jackknife, Geometry& g)
{
	for (size_t s = 1; s < g.states.size() && g.shared_poses; ++s)
		for (size_t p = 0; p < g.states[0].poses.size(); ++p)
		{
			const std::vector<const double*> both{ g.states[0].poses[p].data(), &g.states[s].lens_centre.x };
			if (!problem.HasParameterBlock(both[0]) || !problem.HasParameterBlock(both[1]))
				continue;
			const Eigen::MatrixXd own = by_edges(both), left_out = jackknife ? jackknife->Of(both) : Eigen::MatrixXd::Zero(9, 9);
			for (int k = 0; k < 3; ++k)
			{
				const auto variance = [k](const Eigen::MatrixXd& c) { return c(3 + k, 3 + k) + c(6 + k, 6 + k) - 2 * c(3 + k, 6 + k); };
				g.states[s].pose_sigmas[p][size_t(3 + k)] = std::sqrt(std::max({ variance(own), variance(left_out), 0.0 }));
			}
		}
}

/// px; of exact edges.
const double LEAST_OFFSET = 0.002, LEAST_BLUR = 0.01;

std::vector<double> Column(const std::vector<std::array<double, 2>>& rows, size_t k)
{
	std::vector<double> column;
	for (const auto& row : rows)
		column.push_back(row[k]);
	return column;
}

}

ModelError ErrorOf(const Task& task, const std::vector<std::array<double, 2>>& residuals)
{
	std::vector<double> offset_sigmas, blur_sigmas;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e)
	{
		offset_sigmas.push_back(e.offset_sigma);
		blur_sigmas.push_back(e.blur_sigma);
	});
	return { ModelScatter(Column(residuals, 0), offset_sigmas, LEAST_OFFSET), ModelScatter(Column(residuals, 1), blur_sigmas, LEAST_BLUR) };
}

EdgeScatter ScatterOf(const std::vector<std::array<double, 2>>& residuals)
{
	return { std::max(RobustSigma(Column(residuals, 0)), LEAST_OFFSET), std::max(RobustSigma(Column(residuals, 1)), LEAST_BLUR) };
}

std::vector<std::array<double, 2>> JointFit::Residuals(const Geometry& geometry, const Unknowns& x) const
{
	Geometry g = geometry;
	Unknowns y = x;
	std::vector<std::array<double, 2>> all;
	ForEachEdge(task, [&](size_t s, size_t p, const Edge& e)
	{
		double seen[2] = { 1e9, 1e9 };
		EdgeBlocks<double> blocks = BlocksOf(g, y, s, p);
		const double d = y.d * y.stops.Ratio(task.states[s].photos[p].stop);
		blocks.d = &d;
		MakeEdgeModel(task, model, e, g.states[s].lens_normal, geometry_alone).See(blocks, seen);
		all.push_back({ seen[0], seen[1] - SoftDiameter(e.blur) });
	});
	return all;
}

bool JointFit::Minimise(Geometry& g, Unknowns& x) const
{
	ceres::Problem problem;
	Build(*this, g, x, problem);
	LeastSquares how{ ceres::DENSE_SCHUR, 200, 1e-9 };
	how.threads = AllThreads();
	const bool solved = SolveLeastSquares(how, problem).has_value();
	x.d = std::abs(x.d);
	SpreadPoses(g);
	return solved;
}

std::optional<JointCovariance> JointFit::Covariance(Geometry& g, Unknowns& x) const
{
	// Of the edges also where their brightness was fitted: what the model leaves out of a profile is common to all
	// its bins, and would make the sigmas too small by the root of their number.
	JointFit by_edges = *this;
	by_edges.kind = Refinement::EDGES;
	ceres::Problem problem;
	std::vector<PhotographBlocks> photographs;
	for (const auto& [place, blocks] : Build(by_edges, g, x, problem))
		photographs.push_back(blocks);
	BlockCovariance covariance(problem);
	const std::vector<const double*> lens = LensBlocks(g, x);
	std::vector<SigmaOf> geometry = GeometryBlocks(g);
	// A pose without edges is in no residual: it keeps its sigma.
	geometry.erase(std::remove_if(geometry.begin(), geometry.end(), [&](const SigmaOf& wanted) { return !problem.HasParameterBlock(wanted.block); }), geometry.end());
	std::vector<const double*> alone;
	for (const SigmaOf& wanted : geometry)
		alone.push_back(wanted.block);
	if (!covariance.Compute(lens, alone, PosesAndCentres(problem, g)))
		return std::nullopt;

	const double scale = VarianceOfResiduals(problem);
	const std::optional<CovarianceByPhotographs> jackknife = JackknifeOverPhotographs(problem, photographs);
	const auto larger = [&](const std::vector<const double*>& block)
	{
		const Eigen::VectorXd a = scale * covariance.Of(block).diagonal();
		return Eigen::VectorXd(jackknife ? a.cwiseMax(jackknife->Of(block).diagonal()) : a);
	};
	g.w_px_sigma = std::sqrt(larger({ &g.w_px })[0]);
	for (const SigmaOf& wanted : geometry)
	{
		const Eigen::VectorXd own = larger({ wanted.block });
		for (int i = 0; i < wanted.size; ++i)
			wanted.sigma[i] = std::sqrt(std::max(own[i], 0.0));
	}
	SpreadPoses(g);
	SigmasFromCentres(problem, [&](const std::vector<const double*>& blocks) { return Eigen::MatrixXd(scale * covariance.Of(blocks)); }, jackknife, g);
	const auto of_planes = [&](Eigen::MatrixXd c)
	{
		c.row(UnknownIndex::W) *= task.pitch_mm;
		c.col(UnknownIndex::W) *= task.pitch_mm;
		return CovarianceOfPlanes(model, x, g.w_px * task.pitch_mm, c);
	};
	JointCovariance both{ of_planes(scale * covariance.Of(lens)), std::nullopt, 0 };
	if (jackknife)
	{
		both.by_photographs = of_planes(jackknife->Of(lens));
		both.held_out = jackknife->HeldOut();
	}
	return both;
}

namespace
{

/// The rows of `from_tangent`, which holds `shared` one after the other, that are these blocks'; 0 where one is held.
Eigen::MatrixXd RowsOf(const ceres::Problem& problem, const std::vector<const double*>& blocks, const std::vector<double*>& shared, const Eigen::MatrixXd& from_tangent)
{
	const std::vector<int> at = PlacesOfBlocks(problem, shared).Of(blocks);
	Eigen::MatrixXd out = Eigen::MatrixXd::Zero(Eigen::Index(at.size()), from_tangent.cols());
	for (size_t i = 0; i < at.size(); ++i)
		if (at[i] >= 0)
			out.row(Eigen::Index(i)) = from_tangent.row(at[i]);
	return out;
}

}

JointInformation JointFit::Information(Geometry& g, Unknowns& x, const std::vector<size_t>& measured) const
{
	JointFit by_edges = *this;
	by_edges.kind = Refinement::EDGES;
	ceres::Problem problem;
	const Photographs photographs = Build(by_edges, g, x, problem);
	std::vector<PhotographBlocks> all;
	for (const auto& [place, blocks] : photographs)
		all.push_back(blocks);
	std::vector<ceres::ResidualBlockId> residuals;
	problem.GetResidualBlocks(&residuals);
	const std::vector<double*> shared = SharedBlocks(problem, residuals, all);
	const int size = TangentSize(problem, shared);
	JointInformation out;
	out.measured = Eigen::MatrixXd::Zero(size, size);
	if (const std::vector<ceres::ResidualBlockId> others = Others(residuals, all); !others.empty())
		out.measured += Expand(problem, others, shared).H;
	for (const auto& [place, blocks] : photographs)
	{
		const Eigen::MatrixXd H = OfPhotograph(problem, blocks, shared, size).H;
		if (place.second >= measured[place.first])
			out.expected.push_back(H);
		else
			out.measured += H;
	}
	const Eigen::MatrixXd from_tangent = FromTangent(problem, shared);
	Eigen::MatrixXd unknowns = RowsOf(problem, LensBlocks(g, x), shared, from_tangent);
	unknowns.row(UnknownIndex::W) *= task.pitch_mm;
	out.planes = PlanesByUnknowns(model, x, g.w_px * task.pitch_mm) * unknowns;
	std::vector<const double*> points;
	for (const StateGeometry& state : g.states)
		points.push_back(state.principal_point.data());
	out.principal_points = RowsOf(problem, points, shared, from_tangent);
	return out;
}

}
