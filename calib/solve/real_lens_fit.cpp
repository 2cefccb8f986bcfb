// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_fit.h"

#include "base/robust.h"
#include "edge/soft_radius.h"
#include "model/footprint.h"
#include "model/thin_lens_of_real.h"
#include "solve/block_covariance.h"
#include "solve/by_photographs.h"
#include "solve/each_edge.h"
#include "solve/half_of_edges.h"
#include "solve/least_squares.h"
#include "solve/real_lens_edge_cost.h"

#include <ceres/ceres.h>
#include <opencv2/core/utility.hpp>

#include <cmath>

namespace tiltcal
{

namespace
{

using namespace real_lens;

/// What the sum over the opening's points misses of the mean over the disc that was fitted, whichever way it lies.
double MissOfDisc(const FitResponse& response, double diameter, Rings rings)
{
	const int directions = 12, fine = 400;
	double coarse = 0, exact = 0;
	for (int d = 0; d < directions; ++d)
	{
		const double a = 2 * M_PI * d / directions, cosine = std::cos(a), sine = std::sin(a);
		for (const OpeningPoint& p : OpeningPoints(rings))
			coarse += p.weight * response.Soft(0.5 * diameter * (p.x * cosine + p.y * sine)).value / directions;
	}
	// Chebyshev's points of the second kind: the chords of a disc are their weights.
	for (int k = 1; k <= fine; ++k)
	{
		const double a = M_PI * k / (fine + 1);
		exact += 2 * std::sin(a) * std::sin(a) / (fine + 1) * response.Soft(0.5 * diameter * std::cos(a)).value;
	}
	return coarse - exact;
}

RealLensEdge EdgeOf(const RealLensFit& fit, const Edge& e, const RealLensNumbers& x, size_t s, size_t p)
{
	const Task& task = fit.task;
	const Point normal = EdgeNormal(e);
	const double floor_squared = std::max(x.lens[FLOOR_SQUARED], 0.0), squared = SignedSquare(e.blur), h = 0.01;
	// Edges that were told, not measured, have no pixels.
	const double reach = e.reach > 0 ? e.reach : 0.7 * std::abs(e.blur) + 3;
	RealLensEdge edge{ task.board.X(e.board_column), task.board.Y(e.board_row), e.along_columns, e.x, e.y, normal[0], normal[1], x.r, task.pitch_mm,
		FitResponse(normal[0], normal[1], e.blur, reach, floor_squared / 16), 0, (SoftDiameterOfSquare(squared + h) - SoftDiameterOfSquare(squared - h)) / (2 * h), floor_squared, {}, {} };
	edge.soft_of_disc = MissOfDisc(edge.response, std::sqrt(std::max(squared - x.lens[FLOOR_SQUARED], 0.0)), fit.rings);
	const auto mounted = [&](double t) { return MountedLens<double>(x.states[s].data(), x.lens.data(), x.c.data(), x.r, task.pitch_mm, e.x + t * normal[0], e.y + t * normal[1]); };
	const double step = 0.5;   // px
	const MountedLens<double> at = mounted(0), before = mounted(-step), behind = mounted(step);
	const double *const pose = x.PoseOf(s, p).data(), *const centre = x.centres[s].data();
	double R[9];
	ceres::AngleAxisToRotationMatrix(pose, R);
	const auto open = [&](const std::vector<OpeningPoint>& points)
	{
		edge.points = points;
		edge.px_per_mm.clear();
		for (const OpeningPoint& point : edge.points)
			edge.px_per_mm.push_back(2 * step / (edge.FromLine(behind, pose, R, centre, x.lens.data(), point) - edge.FromLine(before, pose, R, centre, x.lens.data(), point)));
	};
	edge.at_rims = x.rims;
	if (x.sides.empty())
	{
		open(OpeningPoints(fit.rings));
		return edge;
	}
	const OpeningRays rays({ at.lens, x.r * x.lens[OPENING] * x.lens[MAGNIFICATION], at.x, at.y, at.depth, fit.rings });
	const auto seen = [&](const RealLensNumbers& numbers)
	{
		open(rays.Through(numbers.Rims()));
		std::array<double, 2> place_and_soft;
		edge.See(x.states[s].data(), pose, centre, x.lens.data(), x.c.data(), x.rims.data(), place_and_soft.data());
		return place_and_soft;
	};
	if (x.rims_free)
	{
		std::array<std::array<double, RIMS_SIZE>, 2> by_rims{};
		for (size_t k = 0; k < RIM_SIZE * x.sides.size(); ++k)
		{
			const double change = 0.02;   // of the logarithms of a radius and a distance
			RealLensNumbers more = x, less = x;
			more.rims[k] += change;
			less.rims[k] -= change;
			const std::array<double, 2> above = seen(more), below = seen(less);
			for (size_t i = 0; i < 2; ++i)
				by_rims[i][k] = (above[i] - below[i]) / (2 * change);
		}
		edge.by_rims = by_rims;
	}
	open(rays.Through(x.Rims()));
	return edge;
}

struct Likely
{
	double about, sigma;
	int at;

	template<typename T>
	bool operator()(const T* block, T* residual) const
	{
		residual[0] = (block[at] - T(about)) / T(sigma);
		return true;
	}
};

struct LikelyMagnification
{
	template<typename T>
	bool operator()(const T* lens, T* residual) const
	{
		using std::log;
		if (!(lens[MAGNIFICATION] > T(0)))
			return false;
		residual[0] = log(lens[MAGNIFICATION]) / T(PUPIL_MAGNIFICATION_SIGMA);
		return true;
	}
};

/// The rims start from where a thin lens has them, which is right but for a factor of two or so.
const double SIGMA_OF_LOG_RIM = 0.7;

/// Holds the numbers of a block that are not free.
void Hold(ceres::Problem& problem, double* block, int size, const std::vector<int>& held)
{
	if (int(held.size()) == size)
		problem.SetParameterBlockConstant(block);
	else if (!held.empty())
		problem.SetManifold(block, new ceres::SubsetManifold(size, held));
}

template<int Size>
void AddLikely(double* block, int at, double about, double sigma, ceres::Problem& problem)
{
	problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Likely, 1, Size>(new Likely{ about, sigma, at }), nullptr, block);
}

void AddWhatIsLikely(const RealLensFit& fit, RealLensNumbers& x, ceres::Problem& problem)
{
	for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
		if (x.free[size_t(k)] && fit.likely_c[size_t(k)] > 0)
			AddLikely<tilt_lens::AberrationTerms>(x.c.data(), k, 0, fit.likely_c[size_t(k)], problem);
	if (x.magnification_free)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LikelyMagnification, 1, LENS_SIZE>(new LikelyMagnification), nullptr, x.lens.data());
	for (int k = 0; x.rims_free && k < RIM_SIZE * int(x.sides.size()); ++k)
		AddLikely<RIMS_SIZE>(x.rims.data(), k, fit.rims_about[size_t(k)], SIGMA_OF_LOG_RIM, problem);
}

const OpeningNumbers EDGE_BY_OPENING{ 3, OPENING, 5 }, LIGHT_BY_OPENING{ 1, OPENING, 3 };

void AddLight(const RealLensFit& fit, RealLensNumbers& x, ceres::Problem& problem, std::vector<PhotographBlocks>& photographs)
{
	for (const RealLensExposure& exposure : fit.exposures)
	{
		double* const gradient = x.gradients[exposure.lit_alike ? *exposure.photo : 0].data();
		const ceres::ResidualBlockId id = AddAtStop(new RealLensLightCost(exposure.light), LIGHT_BY_OPENING, nullptr,
			{ x.states[exposure.state].data(), x.lens.data(), x.c.data(), x.rims.data(), gradient }, exposure.stop, x.stops, problem);
		if (!exposure.lit_alike)
			problem.SetParameterBlockConstant(gradient);
		if (exposure.photo)
			for (PhotographBlocks& p : photographs)
				if (p.group == exposure.state && p.pose == x.PoseOf(exposure.state, *exposure.photo).data())
					p.beside.push_back(id);
	}
}

/// Of edges that outlive the problem. Returns the photographs, each with the pose that is its own unless poses are shared.
std::vector<PhotographBlocks> Build(const RealLensFit& fit, const std::vector<RealLensEdge>& edges, RealLensNumbers& x, ceres::Problem& problem)
{
	std::vector<PhotographBlocks> photographs;
	size_t k = 0;
	ForEachEdge(fit.task, [&](size_t s, size_t p, const Edge& e)
	{
		double* const pose = x.PoseOf(s, p).data();
		if (photographs.empty() || photographs.back().pose != pose)
			photographs.push_back({ {}, pose, s });
		auto* const cost = new RealLensEdgeCost(edges[k++], 1 / std::hypot(e.offset_sigma, fit.error.offset), 1 / std::hypot(e.blur_sigma, fit.error.blur));
		photographs.back().residuals.push_back(AddAtStop(cost, EDGE_BY_OPENING, new ceres::HuberLoss(2.5 * std::sqrt(2.0)),
			{ x.states[s].data(), pose, x.centres[s].data(), x.lens.data(), x.c.data(), x.rims.data() }, fit.task.states[s].photos[p].stop, x.stops, problem));
	});
	if (!x.lens_held)
		AddLight(fit, x, problem, photographs);
	AddWhatIsLikely(fit, x, problem);
	if (x.lens_held)
		HoldStops(x.stops, problem);
	else
		AddStopPriors(fit.task.stops, x.stops, problem);
	std::vector<int> held;
	for (int term = 0; term < tilt_lens::AberrationTerms; ++term)
		if (!x.free[size_t(term)])
			held.push_back(term);
	Hold(problem, x.c.data(), tilt_lens::AberrationTerms, held);
	Hold(problem, x.lens.data(), LENS_SIZE, x.magnification_free ? std::vector<int>{} : std::vector<int>{ MAGNIFICATION });
	held.clear();
	for (int number = 0; number < RIMS_SIZE; ++number)
		if (!x.rims_free || number >= RIM_SIZE * int(x.sides.size()))
			held.push_back(number);
	Hold(problem, x.rims.data(), RIMS_SIZE, held);
	if (x.lens_held)
		for (const double* const block : { x.lens.data(), x.c.data(), x.rims.data() })
			problem.SetParameterBlockConstant(block);
	for (size_t s = 0; s < x.states.size(); ++s)
		if (x.lens_held || (s == 0 && !fit.task.untilted_free))
			Hold(problem, x.states[s].data(), STATE_SIZE, { NX, NY });
	for (size_t s = 0; s < x.centres.size(); ++s)
		if (s == 0 || !x.shared_poses)
			problem.SetParameterBlockConstant(x.centres[s].data());
	return photographs;
}

/// In the order of RealLensNumbers::InARow.
std::vector<const double*> SharedBlocks(const RealLensNumbers& x)
{
	std::vector<const double*> blocks{ x.lens.data(), x.c.data(), x.rims.data() };
	for (const auto& state : x.states)
		blocks.push_back(state.data());
	for (const double* stop : x.stops.Blocks())
		blocks.push_back(stop);
	return blocks;
}

/// The photographs with the edges of a subset.
std::vector<PhotographBlocks> WithEdges(const std::vector<PhotographBlocks>& photographs, const EdgeSubset& subset)
{
	std::vector<PhotographBlocks> part = photographs;
	size_t k = 0;
	for (PhotographBlocks& p : part)
	{
		std::vector<ceres::ResidualBlockId> kept;
		for (const ceres::ResidualBlockId id : p.residuals)
			if (subset[k++])
				kept.push_back(id);
		p.residuals = std::move(kept);
	}
	return part;
}

Eigen::VectorXd VarianceByParts(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs, const std::vector<EdgeSubset>& parts, const std::vector<const double*>& blocks)
{
	Eigen::VectorXd farthest = Eigen::VectorXd::Zero(Eigen::Index(PlacesOfBlocks(problem, {}).Of(blocks).size()));
	for (const EdgeSubset& part : parts)
		// Too few photographs or edges to tell all numbers apart say nothing against the whole.
		if (const std::optional<PartsAnswer> alone = AnswerOfPart(problem, photographs, WithEdges(photographs, part), blocks))
			farthest = farthest.cwiseMax(alone->step.cwiseAbs2() - alone->variance);
	return farthest;
}

/// Of these blocks, scaled by the residuals; none: singular.
std::optional<Eigen::MatrixXd> CovarianceByEdges(ceres::Problem& problem, const std::vector<const double*>& blocks)
{
	BlockCovariance covariance(problem);
	if (!covariance.Compute(blocks))
		return std::nullopt;
	return VarianceOfResiduals(problem) * covariance.Of(blocks);
}

}

std::vector<RealLensEdge> RealLensFit::EdgesAbout(const RealLensNumbers& x) const
{
	struct Place { size_t state, photo; const Edge* edge; };
	std::vector<Place> places;
	ForEachEdge(task, [&](size_t s, size_t p, const Edge& e) { places.push_back({ s, p, &e }); });
	const std::vector<RealLensNumbers> seen = x.AtEveryStop();
	std::vector<std::optional<RealLensEdge>> made(places.size());
	cv::parallel_for_(cv::Range(0, int(places.size())), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
		{
			const Place& at = places[size_t(k)];
			made[size_t(k)] = EdgeOf(*this, *at.edge, seen[task.states[at.state].photos[at.photo].stop], at.state, at.photo);
		}
	});
	std::vector<RealLensEdge> edges;
	for (auto& edge : made)
		edges.push_back(std::move(*edge));
	return edges;
}

std::vector<std::array<double, 2>> RealLensFit::Residuals(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x) const
{
	std::vector<std::array<double, 2>> all;
	const std::vector<RealLensNumbers> at_stops = x.AtEveryStop();
	ForEachEdge(task, [&](size_t s, size_t p, const Edge&)
	{
		double seen[2];
		const RealLensNumbers& own = at_stops[task.states[s].photos[p].stop];
		edges[all.size()].See(x.states[s].data(), x.PoseOf(s, p).data(), x.centres[s].data(), own.lens.data(), x.c.data(), own.rims.data(), seen);
		all.push_back({ seen[0], seen[1] });
	});
	return all;
}

bool RealLensFit::Minimise(const std::vector<RealLensEdge>& edges, RealLensNumbers& x, bool coarse) const
{
	ceres::Problem problem;
	Build(*this, edges, x, problem);
	LeastSquares how{ ceres::DENSE_SCHUR, 300, coarse ? 1e-4 : 1e-6 };
	how.threads = AllThreads();
	return SolveLeastSquares(how, problem).has_value();
}

std::optional<RealLensFit::Judged> RealLensFit::Judge(const std::vector<RealLensEdge>& edges, RealLensNumbers& x) const
{
	ceres::Problem problem;
	const std::vector<PhotographBlocks> photographs = Build(*this, edges, x, problem);
	const std::vector<const double*> shared = SharedBlocks(x);
	const std::optional<Eigen::MatrixXd> by_edges = CovarianceByEdges(problem, shared);
	if (!by_edges)
		return std::nullopt;
	Judged judged;
	judged.by_edges = *by_edges;
	if (const std::optional<CovarianceByPhotographs> jackknife = JackknifeOverPhotographs(problem, photographs))
	{
		judged.by_photographs = jackknife->Of(shared);
		judged.held_out = jackknife->HeldOut();
	}
	judged.variance_by_parts = VarianceByParts(problem, photographs, FourHalvesOfEdges(task), shared);
	return judged;
}

double RealLensFit::ErrorOfLight(const RealLensNumbers& x) const
{
	std::vector<double> residuals;
	for (const RealLensExposure& exposure : exposures)
	{
		const RealLensPatches& light = exposure.light;
		const size_t n = light.patches.size();
		const RealLensNumbers own = x.AtStop(exposure.stop);
		Eigen::VectorXd r = light.See(x.states[exposure.state].data(), own.lens.data(), x.c.data(), own.rims.data(), x.gradients[exposure.lit_alike ? *exposure.photo : 0].data());
		for (size_t i = 0; i < n; ++i)
			r[long(i)] *= light.patches[i].weight;
		r -= light.basis * (light.basis.transpose() * r);
		for (size_t i = 0; i < n; ++i)
			residuals.push_back(r[long(i)] / light.patches[i].weight);
	}
	return residuals.empty() ? 0 : std::max(RobustSigma(std::move(residuals)), 1e-4);
}

void RealLensFit::LearnLight(const RealLensNumbers& x)
{
	// The weights say what is projected out: twice.
	for (int round = 0; round < 2; ++round)
	{
		for (RealLensExposure& exposure : exposures)
			Weigh(light_error, exposure);
		light_error = std::max(ErrorOfLight(x), 1e-4);
	}
}

}
