// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_lens.h"

#include "lens/angles.h"
#include "model/projection.h"
#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "solve/least_squares.h"
#include "solve/solve_geometry.h"
#include "model/tilt_angles.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include "lens/optics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tiltcal
{

namespace
{

struct Feature
{
	size_t photo;
	double x, y;          // board, mm
	double u, v;          // from the picture's centre, px, v up
	double blur;          // px
};

/// Grid corners with the mean blur of their edges.
std::vector<Feature> FeaturesOf(const Task& task, const State& state)
{
	std::vector<Feature> features;
	for (size_t p = 0; p < state.photos.size(); ++p)
		for (const Corner& c : state.photos[p].corners)
		{
			double sum = 0;
			int n = 0;
			for (const Edge& e : state.photos[p].edges)
				if (e.Touches(c.column, c.row))
					sum += e.blur, ++n;
			if (n)
				features.push_back({ p, task.board.X(c.column), task.board.Y(c.row),
					c.x - 0.5 * (task.width - 1), 0.5 * (task.height - 1) - c.y, sum / n });
		}
	return features;
}

/// The three squares of (3), in pixels.
struct StageOneCost
{
	Feature f;

	template<typename T>
	bool operator()(const T* w_px, const T* U, const T* d, const T* pose, T* residual) const
	{
		using std::abs;
		const Vec3<T> P = CameraFromBoard(pose, f.x, f.y);
		if (P.z <= T(1e-9))
			return false;
		const T b = abs(tilt_lens::SignedBlurWidth(*w_px, *d, Vec3<T>{ T(0), T(0), T(1) / *U }, P));
		residual[0] = b - f.blur;
		residual[1] = *w_px * P.x / P.z - f.u;
		residual[2] = *w_px * P.y / P.z - f.v;
		return true;
	}
};

/// The square of (4): the focal depth is taken at the feature's height y.
struct StageTwoCost
{
	Vec3<double> P;
	double blur, w_px, U, d;

	template<typename T>
	bool operator()(const T* tan_tilt, T* residual) const
	{
		using std::abs;
		const T depth = U + P.y * *tan_tilt;
		const Vec3<T> q{ T(0), T(0), T(1) / depth };
		residual[0] = abs(tilt_lens::SignedBlurWidth(T(w_px), T(d), q, Vec3<T>{ T(P.x), T(P.y), T(P.z) })) - blur;
		return true;
	}
};

struct StageOne
{
	double w_px, U, d;
	std::vector<Pose> poses;
	double w_sigma = 0, U_sigma = 0, d_sigma = 0, cost = 0;
};

const LeastSquares HOW{ ceres::DENSE_QR, 200, 1e-12 };

void Build(const std::vector<Feature>& features, StageOne& s, ceres::Problem& problem)
{
	for (const Feature& f : features)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<StageOneCost, 3, 1, 1, 1, 6>(new StageOneCost{ f }),
			nullptr, &s.w_px, &s.U, &s.d, s.poses[f.photo].data());
}

/// Throws Refused where the features determine no camera.
void StageOneSigmas(const std::vector<Feature>& features, StageOne& s)
{
	ceres::Problem problem;
	Build(features, s, problem);
	ceres::Covariance::Options options;
	options.algorithm_type = ceres::DENSE_SVD;
	options.min_reciprocal_condition_number = 1e-22;
	ceres::Covariance covariance(options);
	if (!covariance.Compute({ { &s.w_px, &s.w_px }, { &s.U, &s.U }, { &s.d, &s.d } }, &problem))
		throw Refused("the features do not determine the paper's stage 1: photograph the board inclined by 20 to 45 degrees");
	const double scale = VarianceOfResiduals(problem);
	const auto sigma = [&](const double* block)
	{
		double c = 0;
		covariance.GetCovarianceBlock(block, block, &c);
		return std::sqrt(std::max(c, 0.0) * scale);
	};
	s.w_sigma = sigma(&s.w_px);
	s.U_sigma = sigma(&s.U);
	s.d_sigma = sigma(&s.d);
}

void NeedFeatures(size_t count, int stage, const std::string& state)
{
	const size_t least = 5;
	if (count < least)
		throw Refused(fmt::format("the paper's stage {} needs at least {} features, state {} has {}", stage, least, state, count));
}

/// The starting poses moved so that the principal point is the picture's centre.
std::vector<Pose> CentredPoses(const Task& task, const Geometry& start, size_t state)
{
	std::vector<Pose> poses = start.states[state].poses;
	for (Pose& pose : poses)
	{
		pose[3] += (start.states[state].principal_point[0] - 0.5 * (task.width - 1)) * pose[5] / start.w_px;
		pose[4] -= (start.states[state].principal_point[1] - 0.5 * (task.height - 1)) * pose[5] / start.w_px;
	}
	return poses;
}

StageOne SolveStageOne(const Task& task, const Geometry& start)
{
	const std::vector<Feature> features = FeaturesOf(task, task.states[0]);
	NeedFeatures(features.size(), 1, task.states[0].name);
	const std::vector<Pose> poses = CentredPoses(task, start, 0);
	std::vector<DepthBlur> data;
	for (const Feature& f : features)
		data.push_back({ CameraFromBoard(poses[f.photo].data(), f.x, f.y).z, f.blur });
	std::optional<StageOne> best;
	for (const UntiltedGuess& guess : ScanUntilted(data, start.w_px))
	{
		if (std::abs(guess.inverse_focus) < 1e-9)
			continue;
		StageOne s{ start.w_px, 1 / guess.inverse_focus, guess.diameter, poses };
		ceres::Problem problem;
		Build(features, s, problem);
		const std::optional<double> cost = SolveLeastSquares(HOW, problem);
		if (cost && (!best || *cost < best->cost))
		{
			s.cost = *cost;
			best = s;
		}
	}
	if (!best)
		throw Refused("the paper's stage 1 did not converge");
	best->d = std::abs(best->d);
	StageOneSigmas(features, *best);
	return *best;
}

std::vector<StageTwoCost> StageTwoCosts(const Task& task, const State& state, const StageOne& one, const std::vector<Pose>& poses)
{
	std::vector<StageTwoCost> costs;
	for (const Feature& f : FeaturesOf(task, state))
		costs.push_back({ CameraFromBoard(poses[f.photo].data(), f.x, f.y), f.blur, one.w_px, one.U, one.d });
	return costs;
}

double SumOfSquares(const std::vector<StageTwoCost>& costs, double tan_tilt)
{
	double total = 0, r = 0;
	for (const StageTwoCost& c : costs)
	{
		c(&tan_tilt, &r);
		total += r * r;
	}
	return total;
}

/// tan(theta_F) by (4): the sum is scanned over all tilts, then refined from its lowest point.
Estimate SolveStageTwo(const std::vector<StageTwoCost>& costs, StateLens& lens)
{
	double best = 0, least = std::numeric_limits<double>::infinity();
	for (int k = -440; k <= 440; ++k)
	{
		const double t = std::tan(k * 0.2 * tilt_lens::Pi / 180);
		const double value = SumOfSquares(costs, t);
		if (value < least)
			least = value, best = t;
	}
	ceres::Problem problem;
	for (const StageTwoCost& c : costs)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<StageTwoCost, 1, 1>(new StageTwoCost(c)), nullptr, &best);
	lens.converged = SolveLeastSquares(HOW, problem).has_value();
	ceres::CRSMatrix J;
	problem.Evaluate(ceres::Problem::EvaluateOptions(), nullptr, nullptr, nullptr, &J);
	double information = 0;
	for (const double j : J.values)
		information += j * j;
	const double variance = SumOfSquares(costs, best) / std::max(1.0, double(costs.size()) - 1);
	return { best, std::sqrt(variance / std::max(information, 1e-30)) };
}

void FillState(const StageOne& one, double w_mm, double w_sigma, const Estimate& slope, StateLens& lens)
{
	// q = (0, -t, 1) / U; covariance of (q, w) from those of t, U and w, first order.
	const double U = one.U, t = slope.value;
	Eigen::Matrix<double, 4, 3> J = Eigen::Matrix<double, 4, 3>::Zero();
	J(1, 0) = -1 / U;
	J(1, 1) = t / (U * U);
	J(2, 1) = -1 / (U * U);
	J(3, 2) = 1;
	const Eigen::Vector3d variances(slope.sigma * slope.sigma, one.U_sigma * one.U_sigma, w_sigma * w_sigma);
	FillStateLens({ 0, -t / U, 1 / U }, w_mm, J * variances.asDiagonal() * J.transpose(), lens);
}

void Solve(const Task& task, const Geometry& start, Geometry& found, Solution& out)
{
	const StageOne one = SolveStageOne(task, start);
	const double w = one.w_px * task.pitch_mm, w_sigma = one.w_sigma * task.pitch_mm;
	found = start;
	found.w_px = one.w_px;
	found.w_px_sigma = one.w_sigma;
	found.distortion_terms = 0;
	found.distortion = found.distortion_sigma = Distortion{};
	found.states[0].poses = one.poses;
	out.w_mm = { w, w_sigma };
	out.aperture_diameter = { one.d, one.d_sigma };
	double total = 0;
	int count = 0;
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		StateGeometry& state = found.states[s];
		state.lens_normal = { 0, 0, 1 };
		state.principal_point = { 0.5 * (task.width - 1), 0.5 * (task.height - 1) };
		state.principal_point_sigma = { 0, 0 };
		state.principal_point_fixed = true;
		if (s > 0)
			state.poses = start.shared_poses ? one.poses : CentredPoses(task, start, s);
		StateLens lens;
		Estimate slope{ 0, 0 };
		const std::vector<StageTwoCost> costs = StageTwoCosts(task, task.states[s], one, found.states[s].poses);
		if (s > 0)
		{
			NeedFeatures(costs.size(), 2, task.states[s].name);
			slope = SolveStageTwo(costs, lens);
		}
		lens.edges = int(costs.size());
		lens.rms_blur = std::sqrt(SumOfSquares(costs, slope.value) / double(std::max<size_t>(costs.size(), 1)));
		FillState(one, w, w_sigma, slope, lens);
		total += lens.rms_blur * lens.rms_blur * lens.edges;
		count += lens.edges;
		out.states.push_back(lens);
	}
	out.rms_blur = std::sqrt(total / std::max(count, 1));
	MeasureReprojection(task, found);
	out.focus_distance = out.states[0].focus_distance;
	out.focal_length = out.states[0].focal_length;
}

}

Solution SolvePaper(const Task& task, const Geometry& start, Geometry& found)
{
	Solution solution;
	solution.model = Model::PAPER;
	if (!task.stops.empty())
	{
		solution.failure = "it has one aperture, and the photographs several: leave out those of further f-numbers";
		return solution;
	}
	try
	{
		Solve(task, start, found, solution);
	}
	catch (const Error& e)
	{
		solution.failure = e.what();
	}
	return solution;
}

}
