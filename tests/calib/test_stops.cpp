// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs of one lens at several stops: the ratio of their openings, and what a stopped-down set tells apart. How they are told: test_told_stops.cpp.

#include "edge/soft_radius.h"
#include "solve/real_lens_edge_cost.h"
#include "solve/real_lens_fit.h"
#include "solve/stop_ratios.h"
#include "support/synthetic_lens.h"

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <ceres/sized_cost_function.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two residuals that know the opening as its block and by a logarithm of a length in units of it.
class Toy final : public ceres::SizedCostFunction<2, 3, 2>
{
public:
	bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override
	{
		const double *const a = x[0], *const b = x[1], length = a[1] * std::exp(b[0]);
		residuals[0] = a[0] * a[1] * a[1] + std::sin(b[1]);
		residuals[1] = length + a[2] * a[1];
		if (!jacobians)
			return true;
		const double by_a[] = { a[1] * a[1], 2 * a[0] * a[1], 0, 0, std::exp(b[0]) + a[2], a[1] }, by_b[] = { 0, std::cos(b[1]), length, 0 };
		if (jacobians[0])
			std::copy_n(by_a, 6, jacobians[0]);
		if (jacobians[1])
			std::copy_n(by_b, 4, jacobians[1]);
		return true;
	}
};

/// Central differences with a step h of numbers about 1 are off by h^2 and 1e-16 / h.
void ExpectDerivatives(const ceres::CostFunction& cost, std::vector<std::vector<double>> at)
{
	std::vector<std::vector<double>> by;
	std::vector<double*> to;
	const int n = cost.num_residuals();
	for (const int size : cost.parameter_block_sizes())
		by.emplace_back(size_t(n * size));
	for (auto& block : by)
		to.push_back(block.data());
	const auto evaluate = [&](double** jacobians)
	{
		std::vector<const double*> x;
		for (const auto& block : at)
			x.push_back(block.data());
		std::vector<double> seen(size_t(n), 0);
		EXPECT_TRUE(cost.Evaluate(x.data(), seen.data(), jacobians));
		return seen;
	};
	evaluate(to.data());
	for (size_t b = 0; b < at.size(); ++b)
		for (size_t k = 0; k < at[b].size(); ++k)
		{
			const double value = at[b][k], h = 1e-5 * std::max(std::abs(value), 1e-3);
			at[b][k] = value + h;
			const std::vector<double> above = evaluate(nullptr);
			at[b][k] = value - h;
			const std::vector<double> below = evaluate(nullptr);
			at[b][k] = value;
			for (size_t i = 0; i < size_t(n); ++i)
			{
				const double found = by[b][i * at[b].size() + k], exact = (above[i] - below[i]) / (2 * h);
				EXPECT_NEAR(found, exact, 1e-6 * std::max(std::abs(exact), 1.0)) << "residual " << i << ", block " << b << ", number " << k;
			}
		}
	// Held blocks are not asked for, and the others are the same.
	for (size_t b = 0; b < at.size(); ++b)
	{
		const std::vector<std::vector<double>> all = by;
		std::vector<double*> some(at.size(), nullptr);
		some[b] = to[b];
		evaluate(some.data());
		EXPECT_EQ(by, all) << b;
	}
}

TEST(CostAtStop, HasItsDerivatives)
{
	ExpectDerivatives(CostAtStop(std::make_unique<Toy>(), { 0, 1, 1 }), { { 0.7, 1.3, -0.4 }, { 0.2, 0.5 }, { -0.9 } });
	ExpectDerivatives(CostAtStop(std::make_unique<Toy>(), { 0, 1 }), { { 0.7, 1.3, -0.4 }, { 0.2, 0.5 }, { -0.9 } });
}

// A lens whose stop is closed to a ratio and whose rims stay where they are, mm.
TEST(CostAtStop, IsTheCostOfALensWithThatOpening)
{
	const double log_ratio = std::log(0.35), numbers[2][5] = { { 0.7, 1.3, -0.4, 0.2, 0.5 }, { 0.7, 1.3 * 0.35, -0.4, 0.2 - log_ratio, 0.5 - log_ratio } };
	const CostAtStop cost(std::make_unique<Toy>(), { 0, 1, 1 });
	const Toy toy;
	double seen[2], expected[2];
	const double* const x[] = { numbers[0], numbers[0] + 3, &log_ratio };
	const double* const own[] = { numbers[1], numbers[1] + 3 };
	ASSERT_TRUE(cost.Evaluate(x, seen, nullptr));
	ASSERT_TRUE(toy.Evaluate(own, expected, nullptr));
	for (int i = 0; i < 2; ++i)
		EXPECT_NEAR(seen[i], expected[i], 1e-15);
	RealLensNumbers lens;
	lens.r = 8;
	lens.lens = { 0.02 / 45, 1.1, 0.98, 1 };
	lens.sides = { 1, -1 };
	lens.rims = { 0.1, 0.5, 0.2, 0.3 };
	lens.stops = StopRatios(std::vector<Stop>{ { 2.8 }, { 8 } });
	const RealLensNumbers stopped = lens.AtStop(1);
	EXPECT_NEAR(stopped.lens[real_lens::OPENING], 0.98 * 0.35, 1e-12);
	for (size_t k = 0; k < 2; ++k)
	{
		EXPECT_NEAR(stopped.Rims()[k].radius, lens.Rims()[k].radius, 1e-12);
		EXPECT_NEAR(stopped.Rims()[k].distance, lens.Rims()[k].distance, 1e-12);
	}
}

TEST(CostAtStop, OfAnEdgeThroughARealLensHasItsDerivatives)
{
	using namespace real_lens;
	RealLensEdge edge{ 60, 45, true, 1300, 380, 0.6, -0.8, 8, 0.02, FitResponse(0.6, -0.8, 9, 10, 0.1, true), 0.2, 0.15, 1.1, OpeningPoints(), {} };
	for (size_t k = 0; k < edge.points.size(); ++k)
		edge.px_per_mm.push_back(3.6 + 0.01 * double(k));
	edge.at_rims = { 0.1, 0.5, 0.2, 0.3 };
	edge.by_rims = { { { 0.2, -0.1, 0.05, 0.3 }, { -0.4, 0.2, 0.6, -0.7 }, { 0.01, 0.02, -0.03, 0.01 }, { -0.02, 0.04, 0.01, 0.03 } } };
	edge.shape = EdgeShape{ { 0.02, -0.03 }, { 0.01, 0.01 } };
	std::vector<double> c;
	for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
		c.push_back(0.03 * (k % 5 - 2.2));
	const CostAtStop cost(std::make_unique<RealLensEdgeCost>(edge, RealLensEdge::Seen{ 2, 5, 30, 40 }), { 3, OPENING, 5 });
	const std::vector<double> state{ 0.09, -0.04, 2410, 905, 590 }, pose{ 0.3, -0.4, 3.0, -40, 25, 610 }, centre{ 0.4, -0.2, 0.1 }, lens{ 0.02 / 45, 1.07, 0.98, 1.3 }, rims{ 0.2, 0.5, 0.1, 0.4 };
	const std::vector<double> log_ratio{ -0.8 };
	const std::vector<std::vector<double>> at{ state, pose, centre, lens, c, rims, log_ratio };
	// Of the new number alone: the others are those of RealLensEdgeCost. The response of an edge is made of samples a tenth of a disc apart, between which its derivative is interpolated: 1e-4 of it.
	std::vector<const double*> x;
	for (const auto& block : at)
		x.push_back(block.data());
	RealLensEdge::Seen seen, above, below, by;
	double more = log_ratio[0] + 1e-5, less = log_ratio[0] - 1e-5;
	double* jacobians[] = { nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, by.data() };
	ASSERT_TRUE(cost.Evaluate(x.data(), seen.data(), jacobians));
	x.back() = &more;
	ASSERT_TRUE(cost.Evaluate(x.data(), above.data(), nullptr));
	x.back() = &less;
	ASSERT_TRUE(cost.Evaluate(x.data(), below.data(), nullptr));
	for (size_t i = 0; i < RealLensEdge::SEEN; ++i)
		EXPECT_NEAR(by[i], (above[i] - below[i]) / 2e-5, 1e-4 * std::abs(by[i]) + 1e-6) << i;
}

/// The states untilted and tilted by 5 degrees, six boards at f/2.8 and six nearer ones at f/8, where the opening is 4 % wider than that says.
const double RATIO = 0.35 * 1.04;
Task AtTwoStops(const synthetic::Noise& noise, double curvature = 0, double ratio = RATIO)
{
	std::vector<State> states;
	for (const bool tilted : { false, true })
	{
		synthetic::Lens wide = tilted ? synthetic::Tilted(5, 30) : synthetic::Lens();
		wide.curvature = curvature;
		synthetic::Lens stopped = wide;
		stopped.d *= ratio;
		synthetic::Noise own = noise, other = noise;
		own.seed += tilted;
		other.seed += 10 + tilted;
		states.push_back(synthetic::Photograph(tilted ? "tilted" : "untilted", wide, own, 6));
		for (Photo& photo : synthetic::Photograph("", stopped, other, 6, -15).photos)
		{
			photo.stop = 1;
			states.back().photos.push_back(photo);
		}
	}
	Task task = synthetic::MakeTask(states);
	task.stops = { { 2.8 }, { 8 } };
	return task;
}

// Numbers within 4 of their own sigmas: of five once in 3000 sets not. An f-number says the ratio to 5 %; 1900 edges of 0.06 px on blurs of some px say it a hundred times better.
TEST(Stops, TheRatioOfAThinLensIsFound)
{
	const Calibration c = Calibrate(AtTwoStops({ 0.03, 0.06, 1 }), { Model::PLANE, Poses::OWN });
	const Solution& s = c.solution;
	ASSERT_EQ(s.stop_ratios.size(), 2u);
	EXPECT_EQ(s.stop_ratios[0].value, 1);
	EXPECT_EQ(s.stop_ratios[0].sigma, 0);
	const Estimate& ratio = s.stop_ratios[1];
	std::printf("ratio %.5f +- %.5f (%.5f), d %.4f +- %.4f, tilt error %.4f +- %.4f\n", ratio.value, ratio.sigma, RATIO, s.aperture_diameter.value, s.aperture_diameter.sigma,
		synthetic::TiltError(s.states[1], synthetic::Tilted(5, 30)), s.states[1].lens_tilt.sigma);
	EXPECT_LT(ratio.sigma, 0.1 * STOP_SIGMA * RATIO) << "told by the photographs";
	EXPECT_NEAR(ratio.value, RATIO, 4 * ratio.sigma);
	EXPECT_NEAR(s.aperture_diameter.value, synthetic::Lens().d, 4 * s.aperture_diameter.sigma);
	EXPECT_NEAR(s.states[1].lens_tilt.value, 5, 4 * s.states[1].lens_tilt.sigma);
	EXPECT_NEAR(s.states[1].tilt_direction.value, 30, 4 * s.states[1].tilt_direction.sigma);
	EXPECT_NEAR(s.w_mm.value, synthetic::Lens().w, 4 * s.w_mm.sigma);
	EXPECT_FALSE(c.paper.failure.empty()) << "the paper's model has one aperture";
}

// Exact widths: what is left is the thin lens's second order in the aperture, 4e-4 of the blur at the widest (test_solve.cpp), and the solver's tolerance.
TEST(Stops, TheRatioComesBackWithoutNoise)
{
	const double curvature = -0.0006;
	const Calibration c = Calibrate(AtTwoStops({}, curvature), { Model::CURVED, Poses::OWN });
	EXPECT_NEAR(c.solution.stop_ratios.at(1).value, RATIO, 0.001 * RATIO);
	EXPECT_NEAR(c.solution.field_curvature.value, curvature, 1e-5);
	EXPECT_LT(synthetic::TiltError(c.solution.states[1], synthetic::Tilted(5, 30)), 0.003);
}

// One state at f/2.8 alone, the other at f/8 alone: what the board's blur says of the one is said of the other by its own.
TEST(Stops, AStateMayBeOfOneStop)
{
	Task task = AtTwoStops({ 0.03, 0.06, 5 });
	task.states[0].photos.resize(6);
	task.states[1].photos.erase(task.states[1].photos.begin(), task.states[1].photos.begin() + 6);
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::OWN });
	EXPECT_NEAR(c.solution.stop_ratios.at(1).value, RATIO, 4 * c.solution.stop_ratios[1].sigma);
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 4 * c.solution.states[1].lens_tilt.sigma);
}

TEST(Stops, ThePapersModelRefusesSeveral)
{
	EXPECT_THAT([] { Calibrate(AtTwoStops({ 0.03, 0.06, 1 }), { Model::PAPER }); }, ThrowsMessage<Error>(HasSubstr("one aperture")));
}

/// Edges moved to where a lens of glass has them, with noise of their own.
Task ThroughGlass(Task task, const RealLensNumbers& x, double offset, double blur)
{
	std::mt19937_64 random(7);
	std::normal_distribution<double> normal;
	double squares = 0;
	int count = 0;
	const int rounds = 12;
	for (int round = 0; round < rounds; ++round)
	{
		const RealLensFit fit{ task };
		const std::vector<std::array<double, 2>> residuals = fit.Residuals(fit.EdgesAbout(x), x);
		const bool last = round == rounds - 1;
		size_t k = 0;
		for (State& state : task.states)
			for (Photo& photo : state.photos)
				for (Edge& e : photo.edges)
				{
					const std::array<double, 2>& left = residuals[k++];
					squares += last ? std::pow(left[0] / offset, 2) + std::pow(left[1] / blur, 2) : 0;
					count += last ? 2 : 0;
					const double across = last ? offset * normal(random) : left[0], wider = last ? blur * normal(random) : left[1];
					e.x += across * e.nx;
					e.y += across * e.ny;
					e.blur = DiameterOfSoft(SoftDiameter(e.blur) + wider);
				}
	}
	EXPECT_LT(std::sqrt(squares / count), 0.1) << "converged, to little beside the noise";
	return task;
}

/// A lens whose rim's rays land 0.6 px off by spherical aberration, and a corner's 0.4 px by coma; its field is curved by 1.6e-4 per mm. Edges through more are none that a disc stands for,
/// and moving them to where it has them does not converge.
RealLensNumbers Glass(const Calibration& thin)
{
	RealLensNumbers x = StartOfRealLens(thin.task, thin.geometry, thin.solution, {});
	x.c.fill(0);
	x.c[tilt_lens::Spherical] = -0.0005;
	x.c[tilt_lens::Coma] = 0.001;
	x.c[tilt_lens::Curvature] = 0.005;
	x.lens[real_lens::FLOOR_SQUARED] = 0.5;
	for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		x.free[size_t(k)] = true;
	x.magnification_free = true;
	return x;
}

/// Photographs of the task whose number is in [from, to) of each state.
Task Some(const Task& task, size_t from, size_t to)
{
	Task some = task;
	for (State& state : some.states)
		state.photos.assign(state.photos.begin() + long(from), state.photos.begin() + long(to));
	return some;
}

/// Sigmas by the edges at these very numbers.
Eigen::VectorXd SigmasAt(const Task& task, RealLensNumbers x, size_t from, size_t to)
{
	for (auto& poses : x.poses)
		poses = std::vector<Pose>(poses.begin() + long(from), poses.begin() + long(to));
	const RealLensFit fit{ task, FEW, { 0.002, 0.01 } };
	const auto judged = fit.Judge(fit.EdgesAbout(x), x);
	return judged ? Eigen::VectorXd(judged->by_edges.diagonal().cwiseSqrt()) : Eigen::VectorXd();
}

const char* const NAMES[] = { "spherical", "coma", "astigmatism", "curvature", "distortion", "pupil" };

// What photographs say adds up, so no sigma grows when a set is added; those of what changes with the opening alone fall. By how much photographs as many at the widest stop would have lowered them is
// printed beside. VarianceOfResiduals scales each by what some 3800 residuals scatter: sqrt(2 / 3800) = 2.3 % of the variance, 1.2 % of a sigma, four times that at most.
TEST(Stops, AStoppedDownSetTellsPupilAndAberrationsApart)
{
	const Calibration thin = Calibrate(AtTwoStops({ 0.03, 0.06, 1 }), { Model::PLANE, Poses::OWN });
	const RealLensNumbers truth = Glass(thin);
	const Task both = ThroughGlass(thin.task, truth, 0.03, 0.06), wide = Some(both, 0, 6);
	Task wide_twice = AtTwoStops({ 0.03, 0.06, 1 }, 0, 1);
	for (State& state : wide_twice.states)
		for (Photo& photo : state.photos)
			photo.stop = 0;
	wide_twice = ThroughGlass(wide_twice, truth, 0.03, 0.06);
	const Eigen::VectorXd alone = SigmasAt(wide, truth, 0, 6), with = SigmasAt(both, truth, 0, 12), twice = SigmasAt(wide_twice, truth, 0, 12);
	ASSERT_EQ(alone.size(), with.size());
	const double scatter = 1 + 4 * 0.012;
	for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
	{
		const int at = real_lens::LENS_SIZE + k;
		std::printf("%-12s %.6f mm wide open alone, %.6f with as many at f/8, %.6f with as many more wide open\n", NAMES[k], alone[at], with[at], twice[at]);
		EXPECT_LT(with[at], alone[at] * scatter) << NAMES[k];
	}
	std::printf("%-12s %.6f, %.6f, %.6f\n", "m", alone[real_lens::MAGNIFICATION], with[real_lens::MAGNIFICATION], twice[real_lens::MAGNIFICATION]);
	EXPECT_LT(with[real_lens::MAGNIFICATION], alone[real_lens::MAGNIFICATION] * scatter);
	EXPECT_LT(with[real_lens::LENS_SIZE + tilt_lens::Spherical], alone[real_lens::LENS_SIZE + tilt_lens::Spherical]);
	EXPECT_LT(with[real_lens::LENS_SIZE + tilt_lens::PupilAberration], alone[real_lens::LENS_SIZE + tilt_lens::PupilAberration]);
}

// The whole fit from the thin lens on, which has neither aberrations nor an m: each number within 4 of its own sigmas, of a dozen once in 1300 runs not.
TEST(Stops, TheRatioOfARealLensIsFound)
{
	const Calibration start = Calibrate(AtTwoStops({ 0.03, 0.06, 1 }), { Model::PLANE, Poses::OWN });
	const RealLensNumbers truth = Glass(start);
	const Calibration c = Calibrate(ThroughGlass(start.task, truth, 0.03, 0.06), { Model::CURVED, Poses::OWN });
	const std::optional<RealLensAnswer> answer = SolveRealLens(c.task, c.geometry, c.solution, {});
	ASSERT_TRUE(answer);
	const RealLensNumbers& x = answer->numbers;
	const Eigen::MatrixXd& v = answer->judged.by_edges;
	const int last = int(v.rows()) - 1, state = last - real_lens::STATE_SIZE;
	const double sigma = std::sqrt(v(last, last)) * x.stops.Ratio(1), opening = x.r * x.lens[real_lens::OPENING];
	std::printf("ratio %.5f +- %.5f (%.5f), r %.4f (%.4f), m %.4f\n", x.stops.Ratio(1), sigma, truth.stops.Ratio(1), opening, truth.r, x.lens[real_lens::MAGNIFICATION]);
	EXPECT_NEAR(x.stops.Ratio(1), truth.stops.Ratio(1), 4 * sigma);
	EXPECT_NEAR(opening, truth.r, 4 * x.r * std::sqrt(v(real_lens::OPENING, real_lens::OPENING)));
	EXPECT_NEAR(x.lens[real_lens::MAGNIFICATION], truth.lens[real_lens::MAGNIFICATION], 4 * std::sqrt(v(real_lens::MAGNIFICATION, real_lens::MAGNIFICATION)));
	for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
	{
		// Stated at r, which is the thin lens's own: of the powers of q in a term.
		const double as_stated = x.c[size_t(k)] * std::pow(truth.r / x.r, 2 * tilt_lens::AberrationPowers[k][2] + tilt_lens::AberrationPowers[k][1]);
		EXPECT_NEAR(as_stated, truth.c[size_t(k)], 4 * std::sqrt(v(real_lens::LENS_SIZE + k, real_lens::LENS_SIZE + k))) << NAMES[k];
	}
	for (const int k : { real_lens::NX, real_lens::NY })
		EXPECT_NEAR(x.states[1][size_t(k)], truth.states[1][size_t(k)], 4 * std::sqrt(v(state + k, state + k)));
}

}
