// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_real_lens.h"

#include "base/stopwatch.h"
#include "model/rims_on_lens.h"
#include "model/thin_lens_of_real.h"
#include "model/tilt_angles.h"
#include "solve/fill_solution.h"
#include "solve/real_lens_covariance.h"
#include "solve/real_lens_fit.h"
#include "solve/solve_joint.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace tiltcal
{

namespace
{

using namespace real_lens;

/// q (1/mm) and image distance (mm) of the thin lens that does near its axis what this one does.
Eigen::Vector4d ThinLensOf(const Eigen::VectorXd& state, const Eigen::VectorXd& lens, double pitch_mm)
{
	const double one = 1 / std::sqrt(state[NX] * state[NX] + state[NY] * state[NY] + 1), m = lens[MAGNIFICATION];
	const double w = state[W] * pitch_mm / m, power = PowerOfThinLens(m, lens[POWER] / pitch_mm, one, w);
	return { power * state[NX] * one, power * state[NY] * one, power * one - 1 / w, w };
}

/// The covariance of these by that of the numbers, by central differences.
Eigen::Matrix4d CovarianceOfThinLens(const RealLensNumbers& x, size_t s, const Eigen::MatrixXd& of_numbers, double pitch_mm)
{
	std::vector<int> at;
	for (int k = 0; k < STATE_SIZE; ++k)
		at.push_back(PlaceOfState(s) + k);
	for (int k = 0; k < LENS_SIZE; ++k)
		at.push_back(k);
	const int n = int(at.size());
	Eigen::VectorXd numbers(n);
	numbers << Eigen::Map<const Eigen::VectorXd>(x.states[s].data(), STATE_SIZE), Eigen::Map<const Eigen::VectorXd>(x.lens.data(), LENS_SIZE);
	Eigen::MatrixXd by(4, n), c(n, n);
	for (int j = 0; j < n; ++j)
	{
		const double h = 1e-6 * std::max(std::abs(numbers[j]), 1e-3);
		const auto at_step = [&](double step)
		{
			Eigen::VectorXd moved = numbers;
			moved[j] += step;
			return ThinLensOf(moved.head(STATE_SIZE), moved.tail(LENS_SIZE), pitch_mm);
		};
		by.col(j) = (at_step(h) - at_step(-h)) / (2 * h);
		for (int i = 0; i < n; ++i)
			c(i, j) = of_numbers(at[size_t(i)], at[size_t(j)]);
	}
	return by * c * by.transpose();
}

/// Along the sensor's normal to the point that the rays of the principal point's light come nearest to (least squares), mm: where a thin lens is told to be focused, for
/// it too goes by the blur. Spherical aberration puts it off the plane that the axis's nearest rays are focused on. Infinite or negative: at infinity, beyond.
double BestFocus(const RealLensNumbers& x, size_t s, double pitch_mm)
{
	const double u = x.states[s][CX], v = x.states[s][CY], radius = x.r * x.lens[OPENING] * x.lens[MAGNIFICATION];
	const MountedLens<double> mounted(x.states[s].data(), x.lens.data(), x.c.data(), x.r, pitch_mm, u, v);
	Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
	Eigen::Vector3d from = Eigen::Vector3d::Zero();
	for (const OpeningPoint& p : OpeningThroughRims({ mounted.lens, radius, mounted.x, mounted.y, mounted.depth, FINE }, x.Rims()))
	{
		Vec3<double> origin, direction;
		mounted.Ray(radius * p.x, radius * p.y, origin, direction);
		const Eigen::Vector3d d = Eigen::Vector3d(direction.x, direction.y, direction.z).normalized();
		const Eigen::Matrix3d beside = p.weight * (Eigen::Matrix3d::Identity() - d * d.transpose());
		across += beside;
		from += beside * Eigen::Vector3d(origin.x, origin.y, origin.z);
	}
	return across.inverse().row(2).dot(from);
}

/// `board`: relative sigma of the board's size.
RealLensState StateOf(const RealLensAnswer& answer, size_t s, size_t photographs, double pitch_mm, const std::vector<double>& sigma, double board)
{
	const RealLensNumbers &x = answer.numbers, &stands = answer.about_shared_poses ? *answer.about_shared_poses : x;
	const Eigen::Vector4d thin = ThinLensOf(Eigen::Map<const Eigen::VectorXd>(stands.states[s].data(), STATE_SIZE), Eigen::Map<const Eigen::VectorXd>(x.lens.data(), LENS_SIZE), pitch_mm);
	const Vec3<double> q{ thin[0], thin[1], thin[2] };
	RealLensState state;
	const size_t at = size_t(PlaceOfState(s));
	// Attitudes as parts put them apart; the linear part of the lens, which they put apart too, hardly moves a tilt.
	Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(answer.judged.by_edges.rows(), answer.judged.by_edges.cols());
	for (const size_t k : { at + NX, at + NY })
		apart(Eigen::Index(k), Eigen::Index(k)) = answer.judged.variance_by_parts[Eigen::Index(k)];
	// A larger board is farther away, and so is the plane of focus; image distances are of the pixels' size.
	const Eigen::Vector4d by_size(-q.x, -q.y, -q.z, 0);
	const auto fill = [&](const Eigen::MatrixXd& of_numbers, StateLens& lens)
	{
		FillStateLens(q, thin[3], CovarianceOfThinLens(x, s, of_numbers, pitch_mm) + board * board * by_size * by_size.transpose(), lens);
	};
	for (const auto& [lens, beside] : { std::pair(&state.as_it_scatters, Eigen::MatrixXd(0 * apart)), std::pair(&state.lens, apart) })
	{
		fill(answer.judged.by_edges + beside, *lens);
		if (!answer.judged.by_photographs)
			continue;
		StateLens by_photographs;
		fill(*answer.judged.by_photographs + beside, by_photographs);
		WidenSigmas(by_photographs, *lens);
	}
	state.image_distance_mm = { stands.states[s][W] * pitch_mm, sigma[at + W] * pitch_mm };
	state.principal_point = { stands.states[s][CX], stands.states[s][CY] };
	state.principal_point_sigma = { sigma[at + CX], sigma[at + CY] };
	state.best_focus_mm = BestFocus(stands, s, pitch_mm);
	const auto& centre = stands.centres[s];
	state.lens_centre_mm = { centre[0], centre[1], centre[2] };
	for (size_t p = 0; p < photographs; ++p)
	{
		state.poses.push_back(stands.PoseOf(s, p));
		for (size_t k = 0; k < 3; ++k)
			state.poses.back()[3 + k] -= centre[k];
	}
	return state;
}

/// Of the sum of a rim's logarithm, number `at`, the opening's, and `power` times the pupil magnification's (UnitsOfRim): what its radius or distance in mm has.
double RelativeSigma(const RealLensNumbers& x, const Eigen::MatrixXd& of_numbers, int at, int power)
{
	const std::array<std::pair<int, double>, 3> by{ { { at, 1 }, { OPENING, 1 / x.lens[OPENING] }, { MAGNIFICATION, power / x.lens[MAGNIFICATION] } } };
	double variance = 0;
	for (const auto& [i, by_i] : by)
		for (const auto& [j, by_j] : by)
			variance += by_i * by_j * of_numbers(i, j);
	return std::sqrt(std::max(0., variance));
}

/// `before`: as they were told before the lens; what they were told with stays theirs where the lens leaves them.
std::vector<RimEstimate> RimsOf(const RealLensAnswer& answer, const std::vector<RimEstimate>& before, double board)
{
	std::vector<RimEstimate> rims;
	for (const tilt_lens::Rim& rim : answer.numbers.Rims())
	{
		const int at = LENS_SIZE + tilt_lens::AberrationTerms + RIM_SIZE * int(rims.size());
		const auto sigma = [&](int number)
		{
			const int power = rim.distance > 0 ? 0 : number == LOG_RADIUS ? 1 : 2;
			const double by_edges = RelativeSigma(answer.numbers, answer.judged.by_edges, at + number, power);
			const double by_photographs = answer.judged.by_photographs ? RelativeSigma(answer.numbers, *answer.judged.by_photographs, at + number, power) : 0;
			// As parts of the edges put each of the three apart: by themselves.
			const double by_parts = RelativeSigma(answer.numbers, answer.judged.variance_by_parts.asDiagonal(), at + number, power);
			return std::hypot(std::max(by_edges, by_photographs), board, by_parts);
		};
		const RimEstimate& held = before[rims.size()];
		const auto with = [&](double value, double relative, const Estimate& told)
		{
			return Estimate{ value, std::abs(value) * std::hypot(relative, answer.numbers.rims_free ? 0 : told.sigma / told.value) };
		};
		rims.push_back({ with(rim.radius, sigma(LOG_RADIUS), held.radius_mm), with(rim.distance, sigma(LOG_DISTANCE), held.distance_mm) });
	}
	return rims;
}

/// The aperture, or where a rim is narrower for the light from the point in focus on the axis, that rim seen from there.
Estimate OpeningOnAxis(const RealLens& lens)
{
	const double m = lens.pupil_magnification.value, w = lens.states[0].image_distance_mm.value / m;
	Estimate least = lens.aperture_diameter_mm;
	for (const RimEstimate& rim : lens.rims)
		if (const double d = DiameterOnAxis({ rim.radius_mm.value, rim.distance_mm.value }, 1 / lens.states[0].lens.focus_distance.value, w, m); d < least.value)
			least = { d, d * rim.radius_mm.sigma / rim.radius_mm.value };
	return least;
}

/// As the numbers scatter, and the lens's and where it stands as parts of the edges put them apart, too. Not the aberrations, which parts share out otherwise among
/// themselves while their sum stays.
std::vector<double> SigmasOf(const RealLensAnswer& answer)
{
	std::vector<double> sigma;
	for (int k = 0; k < answer.judged.by_edges.rows(); ++k)
	{
		const bool aberration = k >= LENS_SIZE && k < LENS_SIZE + tilt_lens::AberrationTerms;
		sigma.push_back(std::sqrt(std::max(answer.judged.Variance(k), 0.) + (aberration ? 0 : answer.judged.variance_by_parts[k])));
	}
	return sigma;
}

RealLens Described(const Task& task, const RealLensAnswer& answer, const std::vector<RimEstimate>& rims)
{
	RealLens found;
	const RealLensNumbers& x = answer.numbers;
	const std::vector<double> sigma = SigmasOf(answer);
	const double board = task.board.square_sigma_mm / task.board.square_mm;
	const double f = task.pitch_mm / x.lens[POWER], d = 2 * x.r * x.lens[OPENING];
	found.focal_length_mm = { f, f * sigma[POWER] / x.lens[POWER] };
	found.pupil_magnification = { x.lens[MAGNIFICATION], sigma[MAGNIFICATION] };
	found.aperture_diameter_mm = { d, std::hypot(2 * x.r * sigma[OPENING], board * d) };
	found.psf_floor_squared = { x.lens[FLOOR_SQUARED], sigma[FLOOR_SQUARED] };
	for (size_t k = 0; k < task.stops.size(); ++k)
		found.stop_ratios.push_back({ x.stops.Ratio(k), k ? x.stops.Ratio(k) * sigma[size_t(PlaceOfState(task.states.size())) + k - 1] : 0 });
	found.radius_mm = x.r;
	found.rims = RimsOf(answer, rims, board);
	for (size_t k = 0; k < found.aberrations_mm.size(); ++k)
		found.aberrations_mm[k] = { x.c[k], sigma[LENS_SIZE + k] };
	for (size_t s = 0; s < task.states.size(); ++s)
		found.states.push_back(StateOf(answer, s, task.states[s].photos.size(), task.pitch_mm, sigma, board));
	// f changes with 1/U alone: 1/f is 1/w + 1/(m U).
	found.focal_length_mm.sigma = std::hypot(found.focal_length_mm.sigma, board * f * f * found.states[0].lens.q.z / x.lens[MAGNIFICATION]);
	found.opening_on_axis_mm = OpeningOnAxis(found);
	WidenHiddenStop(found);
	for (const std::array<double, 2>& place_and_blur : answer.residuals)
	{
		found.place_errors_px.push_back(place_and_blur[0]);
		found.blur_errors_px.push_back(place_and_blur[1]);
	}
	found.rms_place = answer.scatter.offset;
	found.rms_blur = answer.scatter.blur;
	found.rms_shape = answer.shape_scatter;
	found.held_out = answer.judged.held_out;
	found.covariance = CovarianceOfRealLens(task, answer);
	return found;
}

}

void WidenHiddenStop(RealLens& lens)
{
	if (!lens.RimHoldsBackTheAxis())
		return;
	// Of a ratio, relative; the exit pupil is as much farther away, and f follows as it does for a thin lens's real ones (WidenByPupils).
	const auto widen = [](Estimate& e, double by) { e.sigma = std::hypot(e.sigma, by); };
	const double m = lens.pupil_magnification.value, relative = PUPIL_MAGNIFICATION_SIGMA;
	if (!lens.states.empty())
	{
		const double w = lens.states[0].image_distance_mm.value / m, thin_power = PowerOfThinLens(m, 1 / lens.focal_length_mm.value, 1.0, w);
		widen(lens.focal_length_mm, 0.5 * (FocalLengthOfReal(m * (1 + relative), thin_power, 1, w) - FocalLengthOfReal(m * (1 - relative), thin_power, 1, w)));
	}
	for (RealLensState& state : lens.states)
		widen(state.image_distance_mm, state.image_distance_mm.value * relative);
	widen(lens.pupil_magnification, m * relative);
}

RealLenses FindRealLens(const Task& task, const Task& through_rims, const Geometry& geometry, const Solution& thin, const std::vector<RimEstimate>& rims,
	const std::function<bool(RealLens& tilts)>& judge)
{
	RealLenses found;
	const Stopwatch time;
	const std::optional<RealLensAnswer> six = SolveRealLens(through_rims, geometry, thin, RimsOf(rims));
	// Without the poses that are shared nobody knows where the pupil of a tilted lens is.
	if (!six || (geometry.shared_poses && !six->about_shared_poses))
	{
		found.tilts.failure = "the fit did not converge, or the photographs do not tell its numbers apart: photograph more inclined boards, sharp in one part and blurred in another, to the picture's corners";
		return found;
	}
	found.tilts = Described(task, *six, rims);
	found.fits_without_answer = six->judged.parts_without_answer;
	found.tilts.held_out_thin = HeldOutOf(task, geometry, thin, six->error);
	found.tilts.seconds = time.Seconds();
	if (!judge(found.tilts))
		return found;
	const Stopwatch more;
	const std::optional<RealLensAnswer> fifth = SolveSceneLens(through_rims, geometry, six->numbers);
	if (fifth && (!geometry.shared_poses || fifth->about_shared_poses))
	{
		found.scene = Described(task, *fifth, rims);
		found.scene->fifth_order = true;
		found.scene->held_out_thin = fifth->held_out_before;
		found.scene->seconds = more.Seconds();
	}
	return found;
}

}
