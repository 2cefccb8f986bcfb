// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/next_photographs.h"

#include "calibrate/candidates.h"
#include "calibrate/coverage.h"
#include "calibrate/next_words.h"
#include "model/tilt_angles.h"
#include "solve/joint_fit.h"
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
/// Photographs of a state, so that they can be held against each other (by_photographs.h).
const size_t LEAST_PHOTOGRAPHS = 3;
const size_t MOST_SUGGESTED = 3;
/// A part of the picture where no board was says nothing of the light and the distortion there, which no sigma here holds.
const double WORTH_OF_NEW_THIRDS = 0.5;

/// A number and the row that takes the inverse of the information to its variance.
struct Goal
{
	ExpectedSigma sigma;
	Eigen::VectorXd row;
	double board = 0;      ///< what the board's size adds to its sigma, whatever is photographed
};

class Design
{
public:
	explicit Design(const Calibration& calibration) : c(calibration) {}

	/// Photographs to compare, and what each shows in its states.
	void Prepare(std::vector<NextPhotograph> all, std::vector<std::vector<Photo>> of_states)
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
		fit.error = ErrorOf(of_measured.Residuals(c.geometry, x));
		const JointInformation all_known = fit.Information(g, x, measured);
		information = all_known.measured;
		gains.assign(looks.size(), Eigen::MatrixXd::Zero(information.rows(), information.cols()));
		for (size_t n = 0; n < order.size() && n < all_known.expected.size(); ++n)
			gains[order[n]] += weight[order[n]] * all_known.expected[n];
		SetGoals(all_known);
	}

	/// Sigmas with the photographs k beside what is measured; false: nothing is determined.
	bool SigmasWith(const std::vector<size_t>& taken, std::vector<ExpectedSigma>& out) const
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

	/// Sum over the goals of what a sigma is of what is wanted of it, squared.
	std::optional<double> Badness(const std::vector<size_t>& taken) const
	{
		std::vector<ExpectedSigma> sigmas;
		if (!SigmasWith(taken, sigmas))
			return std::nullopt;
		double sum = 0;
		for (const ExpectedSigma& s : sigmas)
			sum += std::pow(s.then / s.wanted, 2);
		return sum;
	}

	const NextPhotograph& Look(size_t k) const { return looks[k]; }
	size_t Count() const { return looks.size(); }

private:
	/// With shared poses the board stands still and the lens's centre moves.
	Pose InState(Pose pose, size_t s) const
	{
		if (!c.geometry.shared_poses)
			return pose;
		const Vec3<double>& centre = c.geometry.states[s].lens_centre;
		return { pose[0], pose[1], pose[2], pose[3] - centre.x, pose[4] - centre.y, pose[5] - centre.z };
	}

	double EdgesOfAPhotograph() const
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

	std::optional<std::vector<double>> Variances(const std::vector<size_t>& taken) const
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

	/// A sigma is the larger of what edges and what whole photographs say; both fall as the information grows.
	double Expected(size_t g, double variance) const
	{
		const double now = goals[g].sigma.now, board = std::min(goals[g].board, now);
		return std::sqrt((now * now - board * board) * variance / std::max(fit_now[g], 1e-300) + board * board);
	}

	void Add(const std::string& name, const std::string& unit, double now, double wanted, Eigen::VectorXd row, double board = 0)
	{
		goals.push_back({ { name, unit, now, now, wanted }, std::move(row), board });
	}

	void SetGoals(const JointInformation& all)
	{
		using At = LensCovariance::At;
		using Number = LensCovariance::Number;
		using Axis = LensCovariance::Axis;
		const Solution& s = c.solution;
		const double relative = c.task.board.square_sigma_mm / c.task.board.square_mm;
		const auto row = [&](At at) -> Eigen::VectorXd { return all.planes.row(at.index).transpose(); };
		Add("image_distance", "mm", s.w_mm.sigma, WANTED_OF_W * s.w_mm.value, row(Number::IMAGE_DISTANCE));
		Add("aperture_diameter", "mm", s.aperture_diameter.sigma, WANTED_OF_D * s.aperture_diameter.value, row(Number::APERTURE_DIAMETER), relative * s.aperture_diameter.value);
		Add("inverse_focus_distance", "1/m", 1000 * s.states[0].q_sigma.z, 1000 * WANTED_OF_NEARNESS * Nearness(), 1000 * row(At(0, Axis::Z)), 1000 * relative * std::abs(s.states[0].q.z));
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

	/// The tilt, and how far its direction moves it aside.
	void AddTilt(size_t k, const JointInformation& all)
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
		const StateLens& lens = c.TiltOf(k);
		const double relative = c.task.board.square_sigma_mm / c.task.board.square_mm, size = std::abs(lens.lens_tilt.value);
		Add(c.task.states[k].name + ".lens_tilt", "deg", lens.lens_tilt.sigma, WANTED_TILT, tilts, relative * size);
		// Of a tilt near 0 the direction is nothing.
		const double swing = std::min(lens.tilt_direction.sigma * M_PI / 180 * size, 10 * WANTED_TILT);
		if (size > 10 * lens.lens_tilt.sigma)
			Add(c.task.states[k].name + ".tilt_across", "deg", swing, WANTED_TILT, aside);
	}

	double Nearness() const
	{
		double sum = 0, count = 0;
		for (const StateGeometry& state : c.geometry.states)
			for (const Pose& pose : state.poses)
			{
				sum += 1 / pose[5];
				count += 1;
			}
		return sum / std::max(count, 1.0);
	}

	const Calibration& c;
	std::vector<NextPhotograph> looks;
	Eigen::MatrixXd information;
	std::vector<Eigen::MatrixXd> gains;
	std::vector<Goal> goals;
	std::vector<double> fit_now;
};

/// Its own states' photographs of a pose; empty where one of them cannot be taken.
std::vector<Photo> PhotosOf(const Calibration& c, const NextPhotograph& look)
{
	std::vector<Photo> photos;
	for (const size_t s : look.states)
	{
		Candidate one = Expect(c, s, look.pose);
		if (one.photo.edges.empty())
			return {};
		photos.push_back(std::move(one.photo));
	}
	return photos;
}

std::vector<size_t> AllStates(const Calibration& c)
{
	std::vector<size_t> all;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		all.push_back(s);
	return all;
}

/// Of many states: every so many-th.
const size_t MOST_CANDIDATES = 1500;

void Gather(const Calibration& c, std::vector<NextPhotograph>& looks, std::vector<std::vector<Photo>>& photos)
{
	const bool shared = c.geometry.shared_poses;
	std::vector<std::pair<size_t, Candidate>> all;
	for (size_t s = 0; s < (shared ? 1 : c.task.states.size()); ++s)
		for (Candidate& candidate : CandidatesOf(c, s))
			all.emplace_back(s, std::move(candidate));
	const size_t step = all.size() / MOST_CANDIDATES + 1;
	for (size_t k = 0; k < all.size(); k += step)
	{
		const size_t s = all[k].first;
		Candidate& candidate = all[k].second;
		candidate.look.states = shared ? AllStates(c) : std::vector<size_t>{ s };
		std::vector<Photo> own = shared ? PhotosOf(c, candidate.look) : std::vector<Photo>{ std::move(candidate.photo) };
		if (own.empty())
			continue;
		looks.push_back(std::move(candidate.look));
		photos.push_back(std::move(own));
	}
}

bool IsMissing(const ExpectedSigma& s, double ExpectedSigma::* which) { return s.*which > s.wanted; }

/// Where in the picture its corners will be, the outermost squares left out.
Thirds ThirdsOf(const Calibration& c, const NextPhotograph& look)
{
	Task one;
	one.width = c.task.width;
	one.height = c.task.height;
	one.states.resize(1);
	one.states[0].photos.resize(1);
	for (const Point& p : look.outline_px)
		one.states[0].photos[0].corners.push_back({ 0, 0, 0.8 * p[0] + 0.2 * look.middle_px[0], 0.8 * p[1] + 0.2 * look.middle_px[1], 0 });
	return SeenThirds(one);
}

/// The part of the empty thirds that are reached.
double NewThirds(const Thirds& seen, const Thirds& reached)
{
	double empty = 0, filled = 0;
	for (size_t k = 0; k < seen.size(); ++k)
	{
		empty += !seen[k];
		filled += !seen[k] && reached[k];
	}
	return empty > 0 ? filled / empty : 0;
}

/// A state with too few photographs comes first.
bool IsOfAPoorState(const Calibration& c, const NextPhotograph& look, const std::vector<NextPhotograph>& taken)
{
	for (const size_t s : look.states)
	{
		size_t photos = c.task.states[s].photos.size();
		for (const NextPhotograph& t : taken)
			photos += size_t(std::count(t.states.begin(), t.states.end(), s));
		if (photos < LEAST_PHOTOGRAPHS)
			return true;
	}
	return false;
}

}

NextPhotographs FindNextPhotographs(const Calibration& c)
{
	NextPhotographs out;
	std::vector<NextPhotograph> looks;
	std::vector<std::vector<Photo>> photos;
	Gather(c, looks, photos);
	Design design(c);
	design.Prepare(std::move(looks), std::move(photos));
	if (!design.SigmasWith({}, out.sigmas))
		return out;
	out.known = true;
	const Thirds seen = SeenThirds(c.task);
	out.missing = WhatIsMissing(c, out.sigmas, seen, LEAST_PHOTOGRAPHS);
	std::vector<size_t> taken;
	Thirds reached = seen;
	while (taken.size() < MOST_SUGGESTED)
	{
		std::optional<size_t> best;
		double least = HUGE_VAL;
		bool best_is_poor = false;
		for (size_t k = 0; k < design.Count(); ++k)
		{
			// Two of one pose see the same errors of the model.
			if (std::count(taken.begin(), taken.end(), k))
				continue;
			std::vector<size_t> with = taken;
			with.push_back(k);
			const std::optional<double> badness = design.Badness(with);
			const bool poor = IsOfAPoorState(c, design.Look(k), out.photographs);
			if (!badness || (best_is_poor && !poor))
				continue;
			const double value = *badness * (1 - WORTH_OF_NEW_THIRDS * NewThirds(reached, ThirdsOf(c, design.Look(k))));
			if (value < least || (poor && !best_is_poor))
			{
				best = k;
				least = value;
				best_is_poor = poor;
			}
		}
		if (!best)
			break;
		taken.push_back(*best);
		NextPhotograph next = design.Look(*best);
		design.SigmasWith(taken, next.sigmas);
		next.text = HowToTake(c, next);
		const Thirds own = ThirdsOf(c, next);
		for (size_t k = 0; k < reached.size(); ++k)
			reached[k] = reached[k] || own[k];
		out.sigmas = next.sigmas;
		out.photographs.push_back(std::move(next));
		// One shows what there is to gain where nothing is missing.
		if (out.missing.empty() || std::none_of(out.sigmas.begin(), out.sigmas.end(), [](const ExpectedSigma& s) { return IsMissing(s, &ExpectedSigma::then); }))
			break;
	}
	return out;
}

NextPhotograph PhotographOfPose(const Calibration& c, const std::vector<size_t>& states, const Pose& pose)
{
	NextPhotograph look = Expect(c, states.at(0), pose).look;
	look.states = states;
	return look;
}

std::vector<ExpectedSigma> ExpectSigmas(const Calibration& c, const std::vector<NextPhotograph>& photographs)
{
	std::vector<std::vector<Photo>> photos;
	for (const NextPhotograph& look : photographs)
		photos.push_back(PhotosOf(c, look));
	Design design(c);
	design.Prepare(photographs, std::move(photos));
	std::vector<size_t> all;
	for (size_t k = 0; k < photographs.size(); ++k)
		all.push_back(k);
	std::vector<ExpectedSigma> out;
	design.SigmasWith(all, out);
	return out;
}

}
