// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve_blur.h"

#include "error.h"
#include "solve_geometry.h"
#include "tilt_angles.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <tilt_lens/optics.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tiltcal
{

namespace
{

struct Observation
{
	size_t state;
	Vec3<double> P;       // camera frame, mm
	double blur, sigma;   // px
};

struct BlurCost
{
	Vec3<double> P;
	double blur, weight, w_px;

	template<typename T>
	bool operator()(const T* d, const T* floor_squared, const T* q, T* residual) const
	{
		using std::sqrt;
		const T b = tilt_lens::SignedBlurWidth(T(w_px), *d, Vec3<T>{ q[0], q[1], q[2] }, Vec3<T>{ T(P.x), T(P.y), T(P.z) });
		// The tiny constant keeps the root smooth where blur and floor both vanish.
		residual[0] = weight * (sqrt(b * b + *floor_squared + T(1e-6)) - blur);
		return true;
	}
};

using Plane = std::array<double, 3>;

struct Unknowns
{
	double d = 0;
	double floor_squared = 1;  // px^2; squared, because the blur does not change with floor at 0
	std::vector<Plane> q;      // per state
};

double Residual(const Observation& o, const Unknowns& x, double w_px)
{
	double r = 0;
	BlurCost{ o.P, o.blur, 1, w_px }(&x.d, &x.floor_squared, x.q[o.state].data(), &r);
	return r;
}

std::vector<Observation> Observe(const Task& task, const Geometry& g)
{
	std::vector<Observation> all;
	for (size_t s = 0; s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			for (const Edge& e : task.states[s].photos[p].edges)
				all.push_back({ s, EdgeInCamera(task, g.poses[s][p], e), e.blur, e.blur_sigma });
	return all;
}

/// Which unknowns move in a solve.
enum Free { UNTILTED, ONE_STATE, EVERYTHING };

struct Solver
{
	const std::vector<Observation>& observations;
	double w_px;
	double model_sigma;    // px: what the model leaves out, common to all edges
	size_t state_count;

	void Build(ceres::Problem& problem, Unknowns& x, Free free, size_t state) const
	{
		for (const Observation& o : observations)
		{
			if (free != EVERYTHING && o.state != state)
				continue;
			const double weight = 1 / std::hypot(o.sigma, model_sigma);
			auto* cost = new ceres::AutoDiffCostFunction<BlurCost, 1, 1, 1, 3>(new BlurCost{ o.P, o.blur, weight, w_px });
			problem.AddResidualBlock(cost, new ceres::HuberLoss(2.0), &x.d, &x.floor_squared, x.q[o.state].data());
		}
		problem.SetParameterLowerBound(&x.floor_squared, 0, 0);
		if (free != ONE_STATE)
			problem.SetManifold(x.q[0].data(), new ceres::SubsetManifold(3, { 0, 1 }));
		else
		{
			problem.SetParameterBlockConstant(&x.d);
			problem.SetParameterBlockConstant(&x.floor_squared);
		}
	}

	/// Returns the final cost.
	double Minimise(Unknowns& x, Free free, size_t state) const
	{
		ceres::Problem problem;
		Build(problem, x, free, state);
		ceres::Solver::Options options;
		options.linear_solver_type = ceres::DENSE_QR;
		options.max_num_iterations = 100;
		options.function_tolerance = 1e-10;
		options.logging_type = ceres::SILENT;
		ceres::Solver::Summary summary;
		ceres::Solve(options, &problem, &summary);
		x.d = std::abs(x.d);
		return summary.IsSolutionUsable() ? summary.final_cost : 1e300;
	}

	/// 1.4826 median |residual|.
	double Scale(const Unknowns& x) const
	{
		std::vector<double> r;
		for (const Observation& o : observations)
			r.push_back(std::abs(Residual(o, x, w_px)));
		std::nth_element(r.begin(), r.begin() + long(r.size() / 2), r.end());
		return 1.4826 * r[r.size() / 2];
	}
};

double DifferenceOf(const Plane& a, const Plane& b)
{
	return std::hypot(a[0] - b[0], std::hypot(a[1] - b[1], a[2] - b[2])) / std::hypot(b[0], std::hypot(b[1], b[2]));
}

struct Candidate
{
	Unknowns x;
	double cost;
};

/// Costs are half chi-squares of errors that are not independent: 20 rather than the 5
/// that would be 3 sigma.
const double SAME_COST = 20;

void SortByCost(std::vector<Candidate>& candidates)
{
	std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

/// The best one different from the best, if it explains the blur as well; else null.
const Candidate* Rival(const std::vector<Candidate>& candidates, size_t state)
{
	for (const Candidate& other : candidates)
		if (DifferenceOf(other.x.q[state], candidates.front().x.q[state]) > 0.05 && other.cost - candidates.front().cost < SAME_COST)
			return &other;
	return nullptr;
}

/// Tilting a lens does not change its power: the relative change that q asks for.
double PowerChange(const Unknowns& x, size_t state, double w_mm)
{
	const auto power = [&](const Plane& q) { return tilt_lens::LensFromPlane(Vec3<double>{ q[0], q[1], q[2] }, 1 / w_mm).power; };
	return std::abs(power(x.q[state]) / power(x.q[0]) - 1);
}

/// Two planes of focus explain the blur of one board equally well, q and its mirror image
/// in the board: |1 - q.P| is the same. The focal length tells them apart when it can.
/// `by_power` says that it had to.
Unknowns Choose(const std::vector<Candidate>& candidates, size_t state, const std::string& name, double w_mm, bool& by_power)
{
	const Candidate* best = &candidates.front();
	const Candidate* rival = Rival(candidates, state);
	by_power = rival != nullptr;
	if (!rival)
		return best->x;
	if (PowerChange(rival->x, state, w_mm) < PowerChange(best->x, state, w_mm))
		std::swap(best, rival);
	if (PowerChange(best->x, state, w_mm) > 0.01 || PowerChange(rival->x, state, w_mm) < 3 * PowerChange(best->x, state, w_mm))
		throw Refused(fmt::format("state {}: the blur fits two different planes of focus equally well. "
			"Photograph the board in more poses, inclined in several directions, partly before and partly behind the plane of focus", name));
	return best->x;
}

void SolveUntilted(const Solver& solver, const Task& task, Unknowns& x)
{
	std::vector<DepthBlur> data;
	for (const Observation& o : solver.observations)
		if (o.state == 0)
			data.push_back({ o.P.z, o.blur });
	std::vector<Candidate> candidates;
	for (const UntiltedGuess& guess : ScanUntilted(data, solver.w_px))
	{
		Candidate c{ x, 0 };
		c.x.d = guess.diameter;
		c.x.q[0] = { 0, 0, guess.inverse_focus };
		c.cost = solver.Minimise(c.x, UNTILTED, 0);
		candidates.push_back(c);
	}
	SortByCost(candidates);
	if (Rival(candidates, 0))
		throw Refused(fmt::format("state {}: the blur fits two focus distances equally well. "
			"Photograph boards that lie partly before and partly behind the plane of focus", task.states[0].name));
	x = candidates.front().x;
}

/// Every direction, tilts up to a plane of focus along the axis, distances around U; then
/// the mirror images of the best in the boards.
void SolveTilted(const Solver& solver, const Task& task, size_t state, const std::vector<Plane>& boards, Unknowns& x, bool& by_power)
{
	std::vector<Candidate> starts;
	const double k = x.q[0][2];
	for (const double distance : { 0.6, 0.8, 1.0, 1.25 })
		for (const double slope : { 0.0, 0.3, 0.7, 1.3, 2.5, 5.0 })
			for (int direction = 0; direction < (slope > 0 ? 12 : 1); ++direction)
			{
				Candidate c{ x, 0 };
				const auto m = tilt_lens::FocalPlaneDirection(std::atan(slope), direction * 3.14159265358979 / 6);
				const auto q = tilt_lens::PlaneAtDistance(m, k * distance);
				c.x.q[state] = { q.x, q.y, q.z };
				size_t n = 0;
				for (const Observation& o : solver.observations)
					if (o.state == state && n++ % 5 == 0)
						c.cost += std::min(std::abs(Residual(o, c.x, solver.w_px)), 20.0);
				starts.push_back(c);
			}
	std::sort(starts.begin(), starts.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
	starts.resize(std::min<size_t>(starts.size(), 12));
	for (Candidate& c : starts)
		c.cost = solver.Minimise(c.x, ONE_STATE, state);
	SortByCost(starts);
	const Plane found = starts.front().x.q[state];
	for (const Plane& board : boards)
	{
		Candidate mirrored = starts.front();
		for (size_t i = 0; i < 3; ++i)
			mirrored.x.q[state][i] = 2 * board[i] - found[i];
		mirrored.cost = solver.Minimise(mirrored.x, ONE_STATE, state);
		starts.push_back(mirrored);
	}
	SortByCost(starts);
	x = Choose(starts, state, task.states[state].name, solver.w_px * task.pitch_mm, by_power);
}

/// The planes of a state's boards as vectors m with m.P = 1.
std::vector<Plane> BoardPlanes(const Geometry& g, size_t state)
{
	std::vector<Plane> planes;
	for (const Pose& pose : g.poses[state])
	{
		const Vec3<double> o = CameraFromBoard(pose.data(), 0, 0), x = CameraFromBoard(pose.data(), 1, 0), y = CameraFromBoard(pose.data(), 0, 1);
		const Vec3<double> m = tilt_lens::PlaneThroughPoint(Cross(x - o, y - o), o);
		planes.push_back({ m.x, m.y, m.z });
	}
	return planes;
}

/// Covariance of (d, floor^2, q of every state) in that order, rescaled by the residuals.
Eigen::MatrixXd CovarianceOf(const Solver& solver, Unknowns& x)
{
	ceres::Problem problem;
	solver.Build(problem, x, EVERYTHING, 0);
	double cost = 0;
	problem.Evaluate(ceres::Problem::EvaluateOptions(), &cost, nullptr, nullptr, nullptr);
	ceres::Covariance::Options options;
	options.algorithm_type = ceres::DENSE_SVD;
	options.min_reciprocal_condition_number = 1e-22;
	ceres::Covariance covariance(options);
	std::vector<const double*> blocks{ &x.d, &x.floor_squared };
	for (Plane& q : x.q)
		blocks.push_back(q.data());
	if (!covariance.Compute(blocks, &problem))
		throw Refused("the blur does not determine the lens: photograph inclined boards whose blur differs clearly from one end to the other");
	const int n = 2 + 3 * int(x.q.size());
	Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> c(n, n);
	covariance.GetCovarianceMatrix(blocks, c.data());
	const double freedom = std::max(1.0, double(problem.NumResiduals()) - (n - 2));
	return c * (2 * cost / freedom);
}

/// mm for the image distance, 4x4 covariance of (q, w) per state.
void FillSolution(const Task& task, const Geometry& g, const Solver& solver, const Unknowns& x, const Eigen::MatrixXd& c, Solution& out)
{
	const double w = g.w_px * task.pitch_mm, w_sigma = g.w_px_sigma * task.pitch_mm;
	out.w_mm = { w, w_sigma };
	out.aperture_diameter = { x.d, std::sqrt(c(0, 0)) };
	const double floor = std::sqrt(x.floor_squared), floor_squared_sigma = std::sqrt(c(1, 1));
	out.psf_floor_px = { floor, floor_squared_sigma / std::max(2 * floor, std::sqrt(floor_squared_sigma)) };
	for (size_t s = 0; s < x.q.size(); ++s)
	{
		Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
		const int at = 2 + 3 * int(s);
		block.topLeftCorner<3, 3>() = c.block<3, 3>(at, at);
		block(3, 3) = w_sigma * w_sigma;
		StateLens lens;
		FillStateLens({ x.q[s][0], x.q[s][1], x.q[s][2] }, w, block, lens);
		out.states.push_back(lens);
	}
	double total = 0;
	for (const Observation& o : solver.observations)
	{
		const double r = Residual(o, x, g.w_px);
		out.states[o.state].rms_blur += r * r;
		++out.states[o.state].edges;
		total += r * r;
	}
	for (StateLens& lens : out.states)
		lens.rms_blur = std::sqrt(lens.rms_blur / std::max(lens.edges, 1));
	out.rms_blur = std::sqrt(total / double(solver.observations.size()));
	out.focus_distance = out.states[0].focus_distance;
	out.focal_length = out.states[0].focal_length;
}

void RefuseUndetermined(const Task& task, const Solution& s)
{
	if (!(s.aperture_diameter.sigma < 0.1 * s.aperture_diameter.value) || !(s.states[0].q_sigma.z < 0.05 * std::abs(s.states[0].q.z)))
		throw Refused(fmt::format("the untilted photographs do not determine aperture ({:.2f} +- {:.2f} mm) and focus: "
			"photograph inclined boards whose blur changes clearly along the board", s.aperture_diameter.value, s.aperture_diameter.sigma));
	for (size_t k = 1; k < s.states.size(); ++k)
		if (!(s.states[k].lens_tilt.sigma < 0.5))
			throw Refused(fmt::format("state {}: its photographs do not determine the tilt ({:.2f} +- {:.2f} degrees): "
				"photograph the board inclined, sharp in one part and blurred in another", task.states[k].name,
				s.states[k].lens_tilt.value, s.states[k].lens_tilt.sigma));
}

}

Solution SolvePlane(const Task& task, const Geometry& geometry)
{
	const std::vector<Observation> observations = Observe(task, geometry);
	std::vector<int> count(task.states.size(), 0);
	for (const Observation& o : observations)
		++count[o.state];
	for (size_t s = 0; s < count.size(); ++s)
		if (count[s] < 20)
			throw Refused(fmt::format("state {}: only {} edges could be measured, 20 are needed: "
				"use a smaller blur, a larger picture of the board, or more photographs", task.states[s].name, count[s]));

	// First with a coarse common error, then with the one that the residuals show.
	Solver solver{ observations, geometry.w_px, 0.5, task.states.size() };
	Unknowns x;
	x.q.assign(task.states.size(), Plane{ 0, 0, 0 });
	SolveUntilted(solver, task, x);
	std::vector<char> by_power(task.states.size(), false);
	for (size_t s = 1; s < task.states.size(); ++s)
	{
		bool chosen = false;
		SolveTilted(solver, task, s, BoardPlanes(geometry, s), x, chosen);
		by_power[s] = chosen;
	}
	for (int round = 0; round < 3; ++round)
	{
		if (solver.Minimise(x, EVERYTHING, 0) >= 1e300)
			throw Refused("the blur fit did not converge");
		solver.model_sigma = std::max(solver.Scale(x), 0.01);
	}
	Solution solution;
	solution.model = "plane";
	FillSolution(task, geometry, solver, x, CovarianceOf(solver, x), solution);
	for (size_t s = 0; s < by_power.size(); ++s)
		solution.states[s].chosen_by_power = by_power[s];
	RefuseUndetermined(task, solution);
	return solution;
}

}
