// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is known beforehand: how it is told, and that it counts beside the photographs as much as it knows. How a real lens takes it is in test_real_lens.cpp.

#include "base/robust.h"
#include "model/priors.h"
#include "solve/joint_fit.h"
#include "solve/solve_geometry.h"
#include "solve/solve_joint.h"
#include "support/synthetic_lens.h"

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const CalibrateOptions PLANE{ Model::PLANE, Poses::OWN };

/// `told`: solves with what is known of a number, which is `free` without, by n residuals. As much is told as they say, three of their sigmas off: information adds, so the answer lies half-way and is surer by
/// sqrt 2. How well they say that they know it goes by their robust scatter, known to 1.17 / sqrt n, squared twice that; d more of it moves 3 / (1 + 1) by 3/4 d: four times that, 7 / sqrt n. And the sigma less.
template<typename Solve>
void ExpectHalfWay(const Estimate& free, int n, const Solve& told)
{
	const Estimate between = told(free.value + 3 * free.sigma, free.sigma);
	EXPECT_NEAR(between.value, free.value + 1.5 * free.sigma, 7 / std::sqrt(n) * free.sigma);
	EXPECT_NEAR(between.sigma, free.sigma / std::sqrt(2.0), 7 / std::sqrt(n) * free.sigma);
	// Ten times as much: the sigma is what was told, less a half per cent, and as sure as that scatter is, four times 1.17 / sqrt n.
	const Estimate held = told(free.value, free.sigma / 10);
	EXPECT_NEAR(held.sigma, free.sigma / 10 / std::sqrt(1.01), 4.7 / std::sqrt(n) * free.sigma / 10);
}

// The median of n distances |r| is known to 0.787 sigma / sqrt n, RobustSigma so to 1.17 / sqrt n of itself: of 20000, 0.8 %. Of the square twice that, and that of what is left out is 0.0025 of 0.00395.
TEST(ModelScatter, IsWhatResidualsHaveBesideTheirSigmas)
{
	std::mt19937_64 random(1);
	std::normal_distribution<double> normal;
	for (const double common : { 0.05, 0. })
	{
		std::vector<double> residuals, sigmas;
		for (int k = 0; k < 20000; ++k)
		{
			sigmas.push_back(k % 2 ? 0.02 : 0.05);
			residuals.push_back(std::hypot(sigmas.back(), common) * normal(random));
		}
		const double off = 4 * 2 * 1.17 / std::sqrt(20000.0) * (common * common + 0.00145);
		EXPECT_NEAR(std::pow(ModelScatter(residuals, sigmas, 1e-4), 2), common * common, off) << common;
	}
	EXPECT_EQ(ModelScatter({ 0, 0, 0 }, { 0, 0, 0 }, 0.01), 0.01);
	// Sigmas that say too much leave nothing out.
	EXPECT_EQ(ModelScatter({ 0.1, -0.1, 0.2 }, { 1, 1, 1 }, 0.01), 0.01);
	// But of the others: three fifths say twice as much as they scatter, the surer ones have 0.02 beside their 0.004. By n of them 2 * 1.17 / sqrt n of the square; four times that.
	std::vector<double> residuals, sigmas;
	const int n = 8000;
	for (int k = 0; k < 20000; ++k)
	{
		const bool sure = k < n;
		sigmas.push_back(sure ? 0.004 : 0.1);
		residuals.push_back((sure ? std::hypot(0.004, 0.02) : 0.05) * normal(random));
	}
	EXPECT_NEAR(std::pow(ModelScatter(residuals, sigmas, 1e-4), 2), 0.02 * 0.02, 4 * 2 * 1.17 / std::sqrt(n) * (0.02 * 0.02 + 0.004 * 0.004));
}

TEST(Priors, ReplaceWhatThePhotographsDoNotTell)
{
	const Lens tilted = Tilted(5);
	Task task = MakeTask({ Photograph("untilted", Lens(), { 0.3, 0.06, 2 }, 3), Photograph("tilted", tilted, { 0.3, 0.06, 3 }, 3) });
	const Calibration free = Calibrate(task, { Model::PLANE, Poses::AUTO });
	task.priors = { { Quantity::FOCAL_LENGTH, tilted.f, 1e-6 * tilted.f } };
	const Calibration fixed = Calibrate(task, { Model::PLANE, Poses::AUTO });
	EXPECT_NEAR(fixed.solution.focal_length.value, tilted.f, 1e-3);
	EXPECT_LT(fixed.solution.w_mm.sigma, 0.5 * free.solution.w_mm.sigma);
	EXPECT_LT(std::abs(fixed.solution.w_mm.value - tilted.w), 4 * fixed.solution.w_mm.sigma + 0.01);
}

TEST(Priors, CountInTheGeometryAsMuchAsTheyKnow)
{
	Task task = MakeTask({ Photograph("untilted", Lens(), { 0.3, 0.06, 2 }) });
	const Geometry free = SolveGeometry(task, {});
	ExpectHalfWay({ free.w_px * PITCH, free.w_px_sigma * PITCH }, 6 * 88 * 2, [&](double value, double sigma)
	{
		task.priors = { { Quantity::IMAGE_DISTANCE, value, sigma } };
		const Geometry g = SolveGeometry(task, {});
		return Estimate{ g.w_px * PITCH, g.w_px_sigma * PITCH };
	});
}

TEST(Priors, CountInTheJointFitAsMuchAsTheyKnow)
{
	Task task = TwoStates(Lens(), Tilted(5), { 0.03, 0.06, 2 }, { 0.03, 0.06, 3 });
	const Calibration c = Calibrate(task, PLANE);
	const auto solve = [&]
	{
		Geometry g = c.geometry;
		Unknowns x = UnknownsOf(c.solution);
		JointFit fit{ task, c.solution.lens, Refinement::EDGES, {}, false };
		for (int round = 0; round < 2; ++round)
		{
			fit.error = ErrorOf(task, fit.Residuals(g, x));
			EXPECT_TRUE(fit.Minimise(g, x));
		}
		const std::optional<JointCovariance> covariance = fit.Covariance(g, x);
		EXPECT_TRUE(covariance);
		return Estimate{ x.d, covariance ? covariance->by_edges.Sigma(LensCovariance::Number::APERTURE_DIAMETER) : 0 };
	};
	ExpectHalfWay(solve(), 12 * 157, [&](double value, double sigma)
	{
		task.priors = { { Quantity::APERTURE_DIAMETER, value, sigma } };
		return solve();
	});
}

TEST(Priors, AreParsed)
{
	const Prior fixed = ParseFix("focal_length=45"), known = ParsePrior("f_number=2.8:0.1");
	EXPECT_EQ(fixed.quantity, Quantity::FOCAL_LENGTH);
	EXPECT_DOUBLE_EQ(fixed.value, 45);
	EXPECT_EQ(known.quantity, Quantity::F_NUMBER);
	EXPECT_DOUBLE_EQ(known.sigma, 0.1);
	for (const char* const wrong : { "focal_length", "focal_length=", "focal_length=-1", "focal_length=45:1", "length=45", "focal_length=4x" })
		EXPECT_THROW(ParseFix(wrong), Error) << wrong;
	for (const char* const wrong : { "f_number=2.8", "f_number=2.8:", "f_number=2.8:0", "f_number=nan:1" })
		EXPECT_THROW(ParsePrior(wrong), Error) << wrong;
}

}
