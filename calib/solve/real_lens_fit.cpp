// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_fit.h"

#include "base/robust.h"
#include "lens/optical_vignetting.h"
#include "model/thin_lens_of_real.h"
#include "solve/block_covariance.h"
#include "solve/by_photographs.h"
#include "solve/each_edge.h"
#include "solve/half_of_edges.h"
#include "solve/least_squares.h"
#include "solve/real_lens_edge_cost.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using namespace real_lens;

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

/// --fix, --prior and EXIF, of this lens and of how it stands in the untilted state.
struct LikelyByPrior
{
	Prior prior;
	double pitch_mm, r;   // r: of the opening that f-numbers count, that on the axis, where OPENING is 1

	template<typename T>
	bool operator()(const T* lens, const T* state, T* residual) const
	{
		using std::sqrt;
		const T f = T(pitch_mm) / lens[POWER], d = T(2 * r) * lens[OPENING], w = state[W] * T(pitch_mm) / lens[MAGNIFICATION];
		const T normal_z = T(1) / sqrt(state[NX] * state[NX] + state[NY] * state[NY] + T(1));
		const double value = prior.value;
		switch (prior.quantity)
		{
		case Quantity::FOCAL_LENGTH: residual[0] = f - T(value); break;
		case Quantity::F_NUMBER: residual[0] = f / d - T(value); break;
		case Quantity::IMAGE_DISTANCE: residual[0] = w - T(value); break;
		case Quantity::APERTURE_DIAMETER: residual[0] = d - T(value); break;
		// 1/U to first order: a lens may be focused beyond infinity on the way.
		case Quantity::FOCUS_DISTANCE: residual[0] = (T(1 / value) - (PowerOfThinLens(lens[MAGNIFICATION], T(1) / f, normal_z, w) * normal_z - T(1) / w)) * T(value * value); break;
		}
		residual[0] /= T(prior.sigma);
		return true;
	}
};

/// What rims leave of the opening's diameter on the axis: they grow with it.
double ShareOnAxis(const RealLensNumbers& x, double pitch_mm)
{
	const double m = x.lens[MAGNIFICATION], w = x.states[0][W] * pitch_mm / m, d = 2 * x.r * x.lens[OPENING];
	const double inverse_focus = PowerOfThinLens(m, x.lens[POWER] / pitch_mm, 1.0, w) - 1 / w;
	double least = d;
	for (const tilt_lens::Rim& rim : x.Rims())
		least = std::min(least, DiameterOnAxis(rim, inverse_focus, w, m));
	return least / d;
}

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
	for (const Prior& prior : fit.task.priors)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LikelyByPrior, 1, LENS_SIZE, STATE_SIZE>(new LikelyByPrior{ prior, fit.task.pitch_mm, x.r * ShareOnAxis(x, fit.task.pitch_mm) }), nullptr,
			x.lens.data(), x.states[0].data());
	for (int k = 0; x.rims_free && k < RIM_SIZE * int(x.sides.size()); ++k)
		AddLikely<RIMS_SIZE>(x.rims.data(), k, fit.rims_about[size_t(k)], SIGMA_OF_LOG_RIM, problem);
}

/// What photographs that are left out are predicted by, whether shapes count or not.
const int PLACE_AND_BLUR = 2;

const OpeningNumbers EDGE_BY_OPENING{ 3, OPENING, 5 }, LIGHT_BY_OPENING{ 1, OPENING, 3 };

void AddLight(const RealLensFit& fit, RealLensNumbers& x, ceres::Problem& problem, std::vector<PhotographBlocks>& photographs)
{
	for (const RealLensExposure& exposure : fit.exposures)
	{
		double* const gradient = x.GradientOf(exposure).data();
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

RealLensEdge::Seen WeightsOf(const RealLensFit& fit, const Edge& e, const std::optional<EdgeShape>& shape)
{
	RealLensEdge::Seen weights{ 1 / std::hypot(e.offset_sigma, fit.error.offset), 1 / std::hypot(e.blur_sigma, fit.error.blur) };
	for (size_t i = 0; shape && i < SHAPES; ++i)
		weights[2 + i] = 1 / std::hypot(shape->sigma[i], fit.shape_error[i]);
	return weights;
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
			photographs.push_back({ {}, pose, s, {}, PLACE_AND_BLUR });
		const RealLensEdge& edge = edges[k++];
		auto* const cost = new RealLensEdgeCost(edge, WeightsOf(fit, e, edge.shape));
		photographs.back().residuals.push_back(AddAtStop(cost, EDGE_BY_OPENING, new ceres::HuberLoss(2.5 * std::sqrt(double(edge.CountOfSeen()))),
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

/// RealLensEdge::See of every edge; 0 for what is not seen.
std::vector<RealLensEdge::Seen> SeenOf(const RealLensFit& fit, const std::vector<RealLensEdge>& edges, const RealLensNumbers& x)
{
	std::vector<RealLensEdge::Seen> all;
	const std::vector<RealLensNumbers> at_stops = x.AtEveryStop();
	ForEachEdge(fit.task, [&](size_t s, size_t p, const Edge&)
	{
		RealLensEdge::Seen seen{};
		const RealLensNumbers& own = at_stops[fit.task.states[s].photos[p].stop];
		edges[all.size()].See(x.states[s].data(), x.PoseOf(s, p).data(), x.centres[s].data(), own.lens.data(), x.c.data(), own.rims.data(), seen.data());
		all.push_back(seen);
	});
	return all;
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

Eigen::VectorXd VarianceByParts(ceres::Problem& problem, const std::vector<PhotographBlocks>& photographs, const std::vector<EdgeSubset>& parts, const std::vector<const double*>& blocks, int& without_answer)
{
	Eigen::VectorXd farthest = Eigen::VectorXd::Zero(Eigen::Index(PlacesOfBlocks(problem, {}).Of(blocks).size()));
	for (const EdgeSubset& part : parts)
		if (const std::optional<PartsAnswer> alone = AnswerOfPart(problem, photographs, WithEdges(photographs, part), blocks))
			farthest = farthest.cwiseMax(alone->step.cwiseAbs2() - alone->variance);
		else
			++without_answer;
	return farthest;
}

/// Of every edge, px; `residuals` as RealLensFit::Residuals gives them.
std::vector<double> BlursAsFitted(const Task& task, const std::vector<std::array<double, 2>>& residuals)
{
	std::vector<double> blurs;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e) { blurs.push_back(e.blur + residuals[blurs.size()][1]); });
	return blurs;
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

double DiameterOnAxis(const tilt_lens::Rim& rim, double inverse_focus_distance, double w, double m)
{
	const Vec3<double> axis{ 0, 0, 1 };
	const double Z = rim.distance;
	return 2 * rim.radius / std::abs(Z > 0 ? tilt_lens::ViewOfRim(axis, axis, inverse_focus_distance, Z).scale : tilt_lens::ViewOfRimBehind(axis, axis, axis, w, m, Z).scale);
}

std::vector<std::array<double, 2>> RealLensFit::Residuals(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x) const
{
	std::vector<std::array<double, 2>> places_and_blurs;
	for (const RealLensEdge::Seen& seen : SeenOf(*this, edges, x))
		places_and_blurs.push_back({ seen[0], seen[1] });
	return places_and_blurs;
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
	const std::vector<EdgeSubset> halves = FourHalvesOfEdges(task, BlursAsFitted(task, Residuals(edges, x)));
	Judged judged;
	judged.by_edges = *by_edges;
	if (const std::optional<CovarianceByPhotographs> jackknife = JackknifeOverPhotographs(problem, photographs))
	{
		judged.by_photographs = jackknife->Of(shared);
		judged.held_out = jackknife->HeldOut();
	}
	judged.variance_by_parts = VarianceByParts(problem, photographs, halves, shared, judged.parts_without_answer);
	return judged;
}

double RealLensFit::ErrorOfLight(const RealLensNumbers& x) const
{
	const std::vector<RealLensNumbers> at_stops = x.AtEveryStop();
	std::vector<double> residuals, sigmas;
	for (const RealLensExposure& exposure : exposures)
	{
		const RealLensPatches& light = exposure.light;
		const size_t n = light.patches.size();
		const RealLensNumbers& own = at_stops[exposure.stop];
		Eigen::VectorXd r = light.See(x.states[exposure.state].data(), own.lens.data(), x.c.data(), own.rims.data(), x.GradientOf(exposure).data());
		for (size_t i = 0; i < n; ++i)
			r[long(i)] *= light.patches[i].weight;
		r -= light.basis * (light.basis.transpose() * r);
		for (size_t i = 0; i < n; ++i)
		{
			residuals.push_back(r[long(i)] / light.patches[i].weight);
			sigmas.push_back(light.patches[i].sigma);
		}
	}
	return residuals.empty() ? 0 : ModelScatter(residuals, sigmas, 1e-4);
}

void RealLensFit::LearnErrors(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x)
{
	const std::vector<RealLensEdge::Seen> all = SeenOf(*this, edges, x);
	std::vector<std::array<double, 2>> places_and_blurs;
	std::array<std::vector<double>, SHAPES> of_shapes, sigmas_of_shapes;
	for (size_t k = 0; k < all.size(); ++k)
	{
		places_and_blurs.push_back({ all[k][0], all[k][1] });
		for (size_t i = 0; edges[k].shape && i < SHAPES; ++i)
		{
			of_shapes[i].push_back(all[k][2 + i]);
			sigmas_of_shapes[i].push_back(edges[k].shape->sigma[i]);
		}
	}
	error = ErrorOf(task, places_and_blurs);
	scatter = ScatterOf(places_and_blurs);
	for (size_t i = 0; i < SHAPES; ++i)
		if (!of_shapes[i].empty())
		{
			shape_error[i] = ModelScatter(of_shapes[i], sigmas_of_shapes[i], 1e-3);
			shape_scatter[i] = RobustSigma(std::move(of_shapes[i]));
		}
	// The weights of patches say what is projected out: twice.
	for (int round = 0; round < 2; ++round)
	{
		for (RealLensExposure& exposure : exposures)
			Weigh(light_error, exposure);
		light_error = std::max(ErrorOfLight(x), 1e-4);
	}
}

}
