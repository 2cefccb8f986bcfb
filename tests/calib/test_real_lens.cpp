// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A real lens beside the thin one: its start, a lens without aberrations, and what the two say of each other's sigmas.

#include "calibrate/beside_real_lens.h"
#include "edge/soft_radius.h"
#include "model/thin_lens_of_real.h"
#include "solve/real_lens_covariance.h"
#include "solve/real_lens_fit.h"
#include "solve/real_lens_light.h"
#include "solve/solve_real_lens.h"
#include "support/fewer_edges.h"
#include "support/shaded_lens.h"
#include "support/synthetic_lens.h"

#include <tiltcal/calibrate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace
{

using namespace tiltcal;

// m is the ratio of the stop's two images: where a rim is all that the axis's light meets, it is what is known of lenses, 0.35 (model/thin_lens_of_real.h), and the exit pupil with it.
TEST(RealLens, AHiddenStopTellsNoPupilMagnification)
{
	RealLens lens;
	lens.pupil_magnification = { 0.8, 0.02 };
	lens.aperture_diameter_mm = lens.opening_on_axis_mm = { 20, 0.1 };
	lens.states.resize(1);
	lens.states[0].image_distance_mm = { 40, 0.5 };
	lens.focal_length_mm = { 45, 0.1 };
	WidenHiddenStop(lens);
	EXPECT_EQ(lens.pupil_magnification.sigma, 0.02);
	EXPECT_EQ(lens.states[0].image_distance_mm.sigma, 0.5);
	lens.opening_on_axis_mm.value = 18;
	WidenHiddenStop(lens);
	// Its logarithm's; the exit pupil, 40 mm away, is as much farther or nearer.
	EXPECT_DOUBLE_EQ(lens.pupil_magnification.sigma, std::hypot(0.02, 0.8 * PUPIL_MAGNIFICATION_SIGMA));
	EXPECT_DOUBLE_EQ(lens.states[0].image_distance_mm.sigma, std::hypot(0.5, 40 * PUPIL_MAGNIFICATION_SIGMA));
	// w stays 50 mm and the plane of focus where it is: q = m (1/f - 1/w) does not change with m, so 1/f = 1/w + q/m.
	const double q = 0.8 * (1 / 45.0 - 1 / 50.0);
	const auto f = [&](double m) { return 1 / (1 / 50.0 + q / m); };
	EXPECT_NEAR(lens.focal_length_mm.sigma, std::hypot(0.1, 0.5 * (f(0.8 * (1 + PUPIL_MAGNIFICATION_SIGMA)) - f(0.8 * (1 - PUPIL_MAGNIFICATION_SIGMA)))), 1e-9);
}

// Nothing but the third-order terms with one P, R or Q less counts, at the slope that is asked for.
TEST(LikelyFifthOrder, IsOfTheTermsThatItContinues)
{
	std::array<double, tilt_lens::AberrationTerms> c{};
	c[tilt_lens::Spherical] = 0.3;
	c[tilt_lens::Distortion] = 0.8;
	const auto likely = LikelyFifthOrder(c, 0.5);
	EXPECT_EQ(likely[tilt_lens::Spherical], 0);
	EXPECT_NEAR(likely[tilt_lens::Fifth_QQQ], 0.3, 1e-12);
	EXPECT_EQ(likely[tilt_lens::Fifth_RRR], 0);
	// P R^2 comes from P R and R^2: at the rim 0.8 0.5^3 and 0, their RMS over the term's own 0.5^4.
	EXPECT_NEAR(likely[tilt_lens::Fifth_PRR], 0.8 * 0.125 / std::sqrt(2.0) / 0.0625, 1e-12);
}

// Each number by the lens that puts it farthest off, in quadrature; a focus that one of the two has at infinity is not compared.
TEST(BesideRealLens, SigmasHoldHowFarTheLensesDisagree)
{
	Calibration c;
	c.solution.focal_length = { 44.8, 0.03 };
	c.solution.w_mm = { 48, 0.3 };
	c.solution.aperture_diameter = { 16, 0.1 };
	c.solution.focus_distance = { 600, 2 };
	c.solution.states.resize(2);
	c.solution.states[0].q = { 0, 0, 1 / 600.0 };
	c.solution.states[0].q_sigma = { 0, 0, 2 / (600.0 * 600) };
	c.solution.states[0].focus_distance = c.solution.focus_distance;
	c.solution.states[1].focus_distance = { INFINITY, 1 };
	c.solution.states[1].lens_tilt = { 5.06, 0.03 };
	c.geometry.states.resize(1);
	c.geometry.states[0].poses = { { 0, 0, 0, 0, 0, 600 } };
	c.geometry.states[0].pose_sigmas = { { 0, 0, 0, 0, 0, 0.3 } };
	c.geometry.states[0].principal_point = { 900, 600 };
	c.geometry.states[0].principal_point_sigma = { 0.3, 0.4 };
	c.pinhole = c.geometry;
	RealLens six;
	six.focal_length_mm = { 44.84, 0.01 };
	six.aperture_diameter_mm = { 18, 0.01 };
	six.opening_on_axis_mm = { 16, 0.01 };
	six.pupil_magnification = { 1.1, 0 };
	six.states.resize(2);
	six.states[0].image_distance_mm = { 52.36, 0 };
	six.states[0].best_focus_mm = 601.5;
	six.states[0].poses = { { 0, 0.001, 0, 0, 0, 600.4 } };
	six.states[0].principal_point = { 900.4, 600 };
	six.states[1].best_focus_mm = -2000;
	six.states[1].lens.lens_tilt = { 4.98, 0.02 };
	c.real_lens = six;
	c.scene_lens = six;
	c.scene_lens->used = true;
	c.scene_lens->focal_length_mm = { 44.72, 0.01 };
	Calibration unused = c;
	WidenByRealLens(unused);
	EXPECT_EQ(unused.solution.focal_length.sigma, 0.03);
	c.real_lens->used = true;
	WidenByRealLens(c);
	// By the six's own, whose fifth order puts it 0.12 elsewhere: more than thin lens and glass are apart.
	EXPECT_NEAR(c.solution.focal_length.sigma, std::hypot(0.01, 0.12), 1e-12);
	EXPECT_NEAR(c.solution.w_mm.sigma, std::hypot(0.3, 0.4), 1e-9);
	EXPECT_NEAR(c.solution.aperture_diameter.sigma, 0.1, 1e-12);
	// By 1/U, which is one number with U: 1/600 - 1/601.5.
	EXPECT_NEAR(c.solution.focus_distance.sigma, std::hypot(2, 1.5 * 600 / 601.5), 1e-9);
	EXPECT_NEAR(c.solution.states[0].q_sigma.z * 600 * 600, c.solution.focus_distance.sigma, 1e-9);
	EXPECT_EQ(c.solution.states[1].focus_distance.sigma, 1);
	EXPECT_NEAR(c.solution.states[1].q_sigma.z, 1 / 2000.0, 1e-12) << "beyond infinity is as far from infinity as before it";
	EXPECT_NEAR(c.solution.states[1].lens_tilt.sigma, std::hypot(0.03, 0.08), 1e-12) << "the thin lens's own, which is told beside the answer";
	EXPECT_NEAR(c.geometry.states[0].pose_sigmas[0][5], 0.5, 1e-12);
	EXPECT_NEAR(c.geometry.states[0].pose_sigmas[0][1], 0.001, 1e-12);
	// A board's distance is no better known than w.
	c.render = c.solution;
	WidenPlacesByImageDistance(c);
	EXPECT_NEAR(c.geometry.states[0].pose_sigmas[0][5], 600 * c.solution.w_mm.sigma / 48, 1e-9);
	EXPECT_EQ(c.solution.focal_length.value, 44.8);
	EXPECT_NEAR(c.geometry.states[0].principal_point_sigma[0], 0.5, 1e-12);
	EXPECT_EQ(c.geometry.states[0].principal_point_sigma[1], 0.4);
}

/// With a fourth of their edges, for speed.
Calibration Plain(const std::function<void(Task&)>& change = [](Task&) {})
{
	Task task = synthetic::WithEveryNth(4, synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 }));
	change(task);
	return Calibrate(task, { Model::PLANE, Poses::OWN });
}

RealLens SixNumbers(const Task& task, const Calibration& c)
{
	return FindRealLens(task, task, c.geometry, c.solution, {}, [](RealLens&) { return false; }).tilts;
}

// Told 0.2 % off what the photographs say, and sure to 1e-6: it is kept. Edges know none of the five better than to 1e-4, so they pull by (1e-6 / 1e-4)^2 of the 0.2 %, 2e-7; ten of its sigmas.
TEST(RealLens, IsHeldByWhatIsFixed)
{
	const Calibration c = Plain();
	const std::pair<Quantity, std::function<double(const RealLens&)>> numbers[] = {
		{ Quantity::FOCAL_LENGTH, [](const RealLens& l) { return l.focal_length_mm.value; } },
		{ Quantity::F_NUMBER, [](const RealLens& l) { return l.focal_length_mm.value / l.aperture_diameter_mm.value; } },
		{ Quantity::IMAGE_DISTANCE, [](const RealLens& l) { return l.states[0].image_distance_mm.value / l.pupil_magnification.value; } },
		{ Quantity::FOCUS_DISTANCE, [](const RealLens& l) { return l.states[0].lens.focus_distance.value; } },
		{ Quantity::APERTURE_DIAMETER, [](const RealLens& l) { return l.aperture_diameter_mm.value; } },
	};
	const RealLens free = SixNumbers(c.task, c);
	ASSERT_EQ(free.failure, "");
	for (const auto& [quantity, number] : numbers)
	{
		Task task = c.task;
		const double told = 1.002 * number(free);
		task.priors = { { quantity, told, 1e-6 * told } };
		const RealLens held = SixNumbers(task, c);
		ASSERT_EQ(held.failure, "") << task.priors[0].Name();
		EXPECT_NEAR(number(held), told, 1e-5 * told) << task.priors[0].Name();
	}
}

// As much is known before as the photographs say, three sigmas off: the answer lies half-way, surer by sqrt 2. By 12 * 157 / 4 blurs: 7 / sqrt n, as test_priors.cpp has it.
TEST(RealLens, WeighsWhatIsKnownBefore)
{
	const Calibration c = Plain();
	Task task = c.task;
	const auto opening = [&]
	{
		const std::optional<RealLensAnswer> answer = SolveRealLens(task, c.geometry, c.solution, {});
		EXPECT_TRUE(answer);
		const double mm = answer ? 2 * answer->numbers.r : 0;
		return answer ? Estimate{ mm * answer->numbers.lens[real_lens::OPENING], mm * std::sqrt(answer->judged.by_edges(real_lens::OPENING, real_lens::OPENING)) } : Estimate{};
	};
	const Estimate free = opening();
	task.priors = { { Quantity::APERTURE_DIAMETER, free.value + 3 * free.sigma, free.sigma } };
	const Estimate between = opening();
	const double by_scatter = 7 / std::sqrt(12 * 157 / 4.0) * free.sigma;
	EXPECT_NEAR(between.value, free.value + 1.5 * free.sigma, by_scatter);
	EXPECT_NEAR(between.sigma, free.sigma / std::sqrt(2.0), by_scatter);
}

// As of the thin lens (BoardsAndPeople.TheSquaresSigmaReachesWhatGrowsWithTheBoard): what a board of another size gives, to first order. Here it is solved anew from another start and weights, whose
// answers differ by parts of a sigma.
TEST(RealLens, TheSquaresSigmaReachesWhatGrowsWithTheBoard)
{
	const Calibration c = Plain();
	const RealLens exact = SixNumbers(c.task, c);
	const double relative = 0.01;
	Task task = c.task;
	task.board.square_sigma_mm = relative * task.board.square_mm;
	const RealLens about = SixNumbers(task, c);
	const Calibration of_larger = Plain([relative](Task& t) { t.board.square_mm *= 1 + relative; });
	const RealLens larger = SixNumbers(of_larger.task, of_larger);
	for (const RealLens* lens : { &exact, &about, &larger })
		ASSERT_EQ(lens->failure, "");
	const auto expect = [](const Estimate& a, const Estimate& with, const Estimate& b, const char* what)
	{
		const double apart = std::abs(b.value - a.value);
		EXPECT_NEAR(std::sqrt(with.sigma * with.sigma - a.sigma * a.sigma), apart, 0.03 * apart + 0.1 * a.sigma) << what << ": " << a.sigma << ", " << with.sigma << ", " << apart;
	};
	expect(exact.aperture_diameter_mm, about.aperture_diameter_mm, larger.aperture_diameter_mm, "d");
	expect(exact.focal_length_mm, about.focal_length_mm, larger.focal_length_mm, "f");
	expect(exact.states[0].lens.focus_distance, about.states[0].lens.focus_distance, larger.states[0].lens.focus_distance, "U");
	expect(exact.states[1].lens.lens_tilt, about.states[1].lens.lens_tilt, larger.states[1].lens.lens_tilt, "tilt");
	EXPECT_NEAR(about.states[0].image_distance_mm.sigma, exact.states[0].image_distance_mm.sigma, 1e-6 * exact.states[0].image_distance_mm.sigma);
}

// One lamp lights photograph n of both states alike; what one photograph alone shows is its own, or with it left out nothing would tell it.
TEST(ExposuresOf, AGradientIsSharedByThoseThatShowIt)
{
	Task task = synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30));
	for (const auto& [s, p] : { std::pair{ 0, 0 }, std::pair{ 1, 0 }, std::pair{ 1, 3 } })
		task.states[size_t(s)].photos[size_t(p)].white.assign(20, BrightPatch{ 100, 100, 1, 0.01 });
	for (const bool shared_poses : { true, false })
	{
		const std::vector<RealLensExposure> all = ExposuresOf(task, shared_poses, 8, { 1 });
		ASSERT_EQ(all.size(), 3u);
		for (const RealLensExposure& exposure : all)
			EXPECT_EQ(exposure.lit_alike, shared_poses && *exposure.photo == 0) << exposure.state << ", " << *exposure.photo;
	}
}

// Lit by a tenth less on the left, more on the right: 0.2 over ten of the columns, of which the board has twelve, from -1 to 1. A photograph with a
// partner is told so beside one without, whose own gradient is projected out. A fifth for the logarithm's curvature, noise of 0.5 % among some 80 patches (0.001) and what the lenses' fall-offs differ by.
TEST(ExposuresOf, AGradientIsFreeBesideAPhotographOfItsOwn)
{
	Calibration c = synthetic::Shaded({ synthetic::Lens(), synthetic::Tilted(5) }, { true, 15, 33, 0.2 }, 0.005, 1);
	c.task.states[0].photos[1].white.clear();
	for (StateLens& state : c.solution.states)
		state.focal_length = c.solution.focal_length;
	RealLensFit fit{ c.task };
	RealLensNumbers x = StartOfRealLens(c.task, c.geometry, c.solution, { { 15, 33 } });
	fit.exposures = ExposuresOf(c.task, true, x.r, x.sides);
	ASSERT_EQ(std::count_if(fit.exposures.begin(), fit.exposures.end(), [](const RealLensExposure& e) { return !e.lit_alike; }), 1);
	const std::vector<RealLensEdge> edges = fit.EdgesAbout(x);
	fit.LearnErrors(edges, x);
	ASSERT_TRUE(fit.Minimise(edges, x, true));
	const double slope = 0.2 / 10 * 12 / 2;
	for (const size_t photo : { 0u, 2u, 3u })
		EXPECT_NEAR(x.gradients[photo][0], slope, 0.2 * slope) << photo;
	EXPECT_EQ(x.gradients[1][0], 0);
	EXPECT_EQ(x.no_gradient[0], 0);
}

/// Photographs whose edges are moved to where a lens of glass has them, with noise of their own.
Task ThroughGlass(Task task, const RealLensNumbers& x, double offset, double blur)
{
	const auto each = [&](const std::function<void(Edge&, const std::array<double, 2>&)>& change)
	{
		const RealLensFit fit{ task };
		const std::vector<std::array<double, 2>> residuals = fit.Residuals(fit.EdgesAbout(x), x);
		size_t k = 0;
		for (State& state : task.states)
			for (Photo& photo : state.photos)
				for (Edge& e : photo.edges)
					change(e, residuals[k++]);
	};
	for (int round = 0; round < 4; ++round)
		each([](Edge& e, const std::array<double, 2>& place_and_soft)
		{
			e.x += place_and_soft[0] * e.nx;
			e.y += place_and_soft[0] * e.ny;
			e.blur = DiameterOfSoft(SoftDiameter(e.blur) + place_and_soft[1]);
		});
	std::mt19937_64 random(3);
	std::normal_distribution<double> normal;
	double squares = 0;
	int count = 0;
	each([&](Edge& e, const std::array<double, 2>& left)
	{
		squares += std::pow(left[0] / offset, 2) + std::pow(left[1] / blur, 2);
		count += 2;
		const double across = offset * normal(random);
		e.x += across * e.nx;
		e.y += across * e.ny;
		e.blur = DiameterOfSoft(SoftDiameter(e.blur) + blur * normal(random));
	});
	EXPECT_LT(std::sqrt(squares / count), 0.1) << "converged, to little beside the noise";
	return task;
}

// Glass without aberrations, which keeps light's etendue, has none: each number within 4 of its own sigmas, of ten numbers once in 1500 runs not.
TEST(RealLens, GlassWithoutAberrationsHasNone)
{
	const Task thin = synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	const Calibration start = Calibrate(thin, { Model::PLANE, Poses::OWN });
	RealLensNumbers truth = StartOfRealLens(start.task, start.geometry, start.solution, {});
	truth.c.fill(0);
	truth.lens[real_lens::FLOOR_SQUARED] = 0;
	const Calibration c = Calibrate(ThroughGlass(thin, truth, 0.03, 0.06), { Model::PLANE, Poses::OWN });
	const std::optional<RealLensAnswer> answer = SolveRealLens(c.task, c.geometry, c.solution, {});
	ASSERT_TRUE(answer);
	const RealLensNumbers& x = answer->numbers;
	const Eigen::MatrixXd& v = answer->judged.by_edges;
	const int terms = real_lens::LENS_SIZE, state = terms + tilt_lens::AberrationTerms + real_lens::RIMS_SIZE + real_lens::STATE_SIZE;
	for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		EXPECT_LT(std::abs(x.c[size_t(k)]), 4 * std::sqrt(v(terms + k, terms + k))) << k;
	EXPECT_NEAR(x.lens[real_lens::MAGNIFICATION], truth.lens[real_lens::MAGNIFICATION], 4 * std::sqrt(v(real_lens::MAGNIFICATION, real_lens::MAGNIFICATION)));
	for (const int k : { real_lens::NX, real_lens::NY })
		EXPECT_NEAR(x.states[1][size_t(k)], truth.states[1][size_t(k)], 4 * std::sqrt(v(state + k, state + k)));

	// What of it calibration.json has: the names' units, nothing of the fifth order, and a covariance.
	const NamedCovariance told = CovarianceOfRealLens(c.task, *answer);
	const size_t n = told.names.size();
	// The untilted state's normal is held.
	ASSERT_EQ(n, 4 + tilt_lens::ThirdOrderTerms + 3 + 5u);
	ASSERT_EQ(told.matrix.size(), n * n);
	ASSERT_EQ(told.by_photographs.size(), n);
	EXPECT_EQ(told.names[0], "focal_length_mm");
	EXPECT_EQ(told.names[n - 5], c.task.states[1].name + ".normal_x");
	const auto focal_length = [&](double power) { return c.task.pitch_mm / power; };
	const double power = x.lens[real_lens::POWER], step = std::sqrt(v(real_lens::POWER, real_lens::POWER));
	// A sigma of f is some thousandths of it, and the next order of the difference their square.
	EXPECT_NEAR(std::sqrt(told.matrix[0]) / (0.5 * (focal_length(power - step) - focal_length(power + step))), 1, 1e-4);
	EXPECT_NEAR(told.matrix[(n - 5) * (n + 1)], v(state, state), 1e-12 * v(state, state));
	for (size_t i = 0; i < n; ++i)
		for (size_t j = 0; j < n; ++j)
		{
			// Rounding of a decomposition, some thousand times a double's.
			const double most = std::sqrt(told.matrix[i * (n + 1)] * told.matrix[j * (n + 1)]), rounding = 1e-9;
			EXPECT_NEAR(told.matrix[i * n + j], told.matrix[j * n + i], rounding * most);
			EXPECT_LE(std::abs(told.matrix[i * n + j]), most * (1 + rounding)) << told.names[i] << " " << told.names[j];
		}
}

// The aperture told a fifth too small, and a rim close before it that is smaller still: the blur wants the rim as large as the lens, so both must grow. The 18 points that
// stand for what a rim leaves have second moments of discs 0.3 to 2.5 % smaller, for rims of 0.95 to 0.8 of the opening (summed over them); and its own sigmas.
TEST(RealLens, ARimThatMeetsTheAxisGrowsWithTheOpening)
{
	const synthetic::Lens lens;
	const Task task = synthetic::TwoStates(lens, synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::OWN });
	Solution thin = c.solution;
	thin.aperture_diameter.value = 0.8 * lens.d;
	const std::optional<RealLensAnswer> answer = SolveRealLens(c.task, c.geometry, thin, { { 0.9 * 0.4 * lens.d, 0.5 } });
	ASSERT_TRUE(answer);
	const RealLensNumbers& x = answer->numbers;
	const double sigma = 2 * x.r * std::sqrt(answer->judged.by_edges(real_lens::OPENING, real_lens::OPENING));
	EXPECT_NEAR(2 * x.Rims()[0].radius, lens.d, 0.025 * lens.d + 4 * sigma);
	EXPECT_NEAR(std::exp(x.rims[real_lens::LOG_RADIUS]), 0.9, 1e-9) << "the six numbers leave the shape that light told, on whichever side the rim is";
}

}
