// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/optimal_design.h"

#include "calibrate/one_photograph.h"
#include "model/tilt_angles.h"
#include "solve/solve_joint.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

namespace
{

// What is wanted of a calibration. The first two are the verdict's (verdict.cpp); the others keep drawn blur within 1 %, so that discs of 10 px
// are right to 0.1 px, which nobody sees, and the place of the axis within what the verdict takes for told.
const double WANTED_OF_W = 0.003;                // of itself
const double WANTED_TILT = 0.03;                 // degrees
const double WANTED_OF_D = 0.01;                 // of itself
const double WANTED_OF_NEARNESS = 0.01;          // 1/U, of the boards' mean 1/z
const double WANTED_OF_WIDTH = 0.01;             // principal point, of the picture's width

}

void Design::Prepare(std::vector<NextPhotograph> all, std::vector<std::vector<Photo>> of_states)
{
	looks = std::move(all);
	Task task = c.task;
	Geometry g = c.geometry;
	Unknowns x = UnknownsOf(c.solution);
	x.untilted_free = c.task.untilted_free;
	std::vector<size_t> measured;
	for (const State& state : task.states)
		measured.push_back(state.photos.size());
	const double usual = EdgesOfAPhotograph();
	std::vector<double> weight;
	std::vector<size_t> order;
	for (size_t s = 0; s < task.states.size(); ++s)
		for (size_t k = 0; k < looks.size(); ++k)
			for (size_t n = 0; n < looks[k].states.size(); ++n)
				if (looks[k].states[n] == s)
				{
					task.states[s].photos.push_back(of_states[k][n]);
					g.states[s].poses.push_back(InState(looks[k].pose, s));
					g.states[s].pose_sigmas.push_back({});
					if (s == 0 || !g.shared_poses)
						order.push_back(k);
				}
	for (const std::vector<Photo>& photos : of_states)
		weight.push_back(photos.empty() || photos[0].edges.empty() ? 0 : usual / double(photos[0].edges.size()));
	JointFit fit{ task, c.solution.lens, Refinement::EDGES, {}, false };
	const JointFit of_measured{ c.task, c.solution.lens, Refinement::EDGES, {}, false };
	fit.error = ErrorOf(c.task, of_measured.Residuals(c.geometry, x));
	const JointInformation all_known = fit.Information(g, x, measured);
	information = all_known.measured;
	gains.assign(looks.size(), Eigen::MatrixXd::Zero(information.rows(), information.cols()));
	for (size_t n = 0; n < order.size() && n < all_known.expected.size(); ++n)
		gains[order[n]] += weight[order[n]] * all_known.expected[n];
	SetGoals(all_known);
}

bool Design::SigmasWith(const std::vector<size_t>& taken, std::vector<ExpectedSigma>& out) const
{
	const std::optional<std::vector<double>> then = Variances(taken);
	if (!then || fit_now.empty())
		return false;
	out.clear();
	for (size_t g = 0; g < goals.size(); ++g)
	{
		out.push_back(goals[g].sigma);
		out.back().then = Expected(g, (*then)[g]);
	}
	return true;
}

std::optional<double> Design::Badness(const std::vector<size_t>& taken) const
{
	std::vector<ExpectedSigma> sigmas;
	if (!SigmasWith(taken, sigmas))
		return std::nullopt;
	double sum = 0;
	for (const ExpectedSigma& s : sigmas)
		sum += std::pow(s.then / s.wanted, 2);
	return sum;
}

Pose Design::InState(Pose pose, size_t s) const
{
	if (!c.geometry.shared_poses)
		return pose;
	const Vec3<double>& centre = c.geometry.states[s].lens_centre;
	return { pose[0], pose[1], pose[2], pose[3] - centre.x, pose[4] - centre.y, pose[5] - centre.z };
}

double Design::EdgesOfAPhotograph() const
{
	double edges = 0, photos = 0;
	for (const State& state : c.task.states)
		for (const Photo& photo : state.photos)
		{
			edges += double(photo.edges.size());
			photos += 1;
		}
	return edges / std::max(photos, 1.0);
}

std::optional<std::vector<double>> Design::Variances(const std::vector<size_t>& taken) const
{
	Eigen::MatrixXd H = information;
	for (const size_t k : taken)
		H += gains[k];
	const Eigen::LLT<Eigen::MatrixXd> root(H);
	if (root.info() != Eigen::Success)
		return std::nullopt;
	std::vector<double> out;
	for (const Goal& goal : goals)
		out.push_back(root.matrixL().solve(goal.row).squaredNorm());
	return out;
}

double Design::Expected(size_t g, double variance) const
{
	const double now = goals[g].sigma.now, board = std::min(goals[g].board, now);
	return std::sqrt((now * now - board * board) * variance / std::max(fit_now[g], 1e-300) + board * board);
}

void Design::Add(const std::string& name, const std::string& unit, double now, double wanted, Eigen::VectorXd row, double board)
{
	goals.push_back({ { name, unit, now, now, wanted }, std::move(row), board });
}

void Design::SetGoals(const JointInformation& all)
{
	using At = LensCovariance::At;
	using Number = LensCovariance::Number;
	using Axis = LensCovariance::Axis;
	const Solution& s = c.solution;
	const double relative = c.task.board.square_sigma_mm / c.task.board.square_mm;
	const auto row = [&](At at) -> Eigen::VectorXd { return all.planes.row(at.index).transpose(); };
	Add("image_distance", "mm", s.w_mm.sigma, WANTED_OF_W * s.w_mm.value, row(Number::IMAGE_DISTANCE));
	Add("aperture_diameter", "mm", s.aperture_diameter.sigma, WANTED_OF_D * s.aperture_diameter.value, row(Number::APERTURE_DIAMETER), relative * s.aperture_diameter.value);
	Add("inverse_focus_distance", "1/m", 1000 * s.states[0].q_sigma.z, 1000 * WANTED_OF_NEARNESS * MeanNearness(c.geometry), 1000 * row(At(0, Axis::Z)), 1000 * relative * std::abs(s.states[0].q.z));
	for (size_t k = 0; k < c.task.states.size(); ++k)
	{
		const std::string& name = c.task.states[k].name;
		const Point& point = c.geometry.states[k].principal_point_sigma;
		for (const int axis : { 0, 1 })
			Add(name + (axis ? ".principal_point_v" : ".principal_point_u"), "px", point[size_t(axis)], WANTED_OF_WIDTH * c.task.width,
				all.principal_points.row(Eigen::Index(2 * k) + axis).transpose());
		if (k > 0)
			AddTilt(k, all);
	}
	fit_now = Variances({}).value_or(std::vector<double>());
}

void Design::AddTilt(size_t k, const JointInformation& all)
{
	using At = LensCovariance::At;
	using Axis = LensCovariance::Axis;
	const Vec3<double> q = c.solution.states[k].q;
	const double w = c.solution.w_mm.value;
	const auto tilt = [](const Vec3<double>& plane, double distance)
	{
		const TiltAngles a = AnglesFromPlane(plane, distance);
		return TiltVector(a.lens_tilt, a.tilt_direction);
	};
	const double h = 1e-5 / w;
	const std::pair<At, Eigen::Vector2d> by[] = {
		{ At(k, Axis::X), (tilt({ q.x + h, q.y, q.z }, w) - tilt({ q.x - h, q.y, q.z }, w)) / (2 * h) },
		{ At(k, Axis::Y), (tilt({ q.x, q.y + h, q.z }, w) - tilt({ q.x, q.y - h, q.z }, w)) / (2 * h) },
		{ At(k, Axis::Z), (tilt({ q.x, q.y, q.z + h }, w) - tilt({ q.x, q.y, q.z - h }, w)) / (2 * h) },
		{ LensCovariance::Number::IMAGE_DISTANCE, (tilt(q, w + 1e-4) - tilt(q, w - 1e-4)) / 2e-4 } };
	const Eigen::Vector2d at = tilt(q, w), along = at.norm() > 1e-6 ? Eigen::Vector2d(at.normalized()) : Eigen::Vector2d(1, 0), across(-along.y(), along.x());
	Eigen::VectorXd tilts = Eigen::VectorXd::Zero(all.planes.cols()), aside = tilts;
	for (const auto& [place, gradient] : by)
	{
		tilts += along.dot(gradient) * all.planes.row(place.index).transpose();
		aside += across.dot(gradient) * all.planes.row(place.index).transpose();
	}
	const StateLens& lens = c.TiltAsItScatters(k);
	const double relative = c.task.board.square_sigma_mm / c.task.board.square_mm, size = std::abs(lens.lens_tilt.value);
	Add(c.task.states[k].name + ".lens_tilt", "deg", lens.lens_tilt.sigma, WANTED_TILT, tilts, relative * size);
	// Of a tilt near 0 the direction is nothing.
	const double swing = std::min(lens.tilt_direction.sigma * M_PI / 180 * size, 10 * WANTED_TILT);
	if (size > 10 * lens.lens_tilt.sigma)
		Add(c.task.states[k].name + ".tilt_across", "deg", swing, WANTED_TILT, aside);
}

}
