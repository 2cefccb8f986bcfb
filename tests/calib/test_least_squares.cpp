// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What every fit has in common: when it has converged, and on how many threads.

#include <tiltcal/calibrate.h>
#include "solve/least_squares.h"
#include "support/synthetic_lens.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#ifdef __linux__
#include <sched.h>
#endif

namespace
{

using namespace tiltcal;
using namespace synthetic;

struct Rosenbrock
{
	template<typename T>
	bool operator()(const T* x, T* residual) const
	{
		residual[0] = T(10) * (x[1] - x[0] * x[0]);
		residual[1] = T(1) - x[0];
		return true;
	}
};

TEST(LeastSquares, TheLimitOfIterationsIsNoConvergence)
{
	const auto solve = [](int iterations, bool may_stop_early)
	{
		double x[2] = { -1.2, 1 };
		ceres::Problem problem;
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Rosenbrock, 2, 2>(new Rosenbrock), nullptr, x);
		LeastSquares how{ ceres::DENSE_QR, iterations, 1e-12 };
		how.may_stop_early = may_stop_early;
		return SolveLeastSquares(how, problem).has_value();
	};
	EXPECT_FALSE(solve(3, false));
	EXPECT_TRUE(solve(3, true));
	EXPECT_TRUE(solve(200, false));
}

/// A measured number and two that stand beside the mean, held each in its own way.
struct Measured
{
	double value;

	template<typename T>
	bool operator()(const T* mean, const T* held, T* residual) const
	{
		residual[0] = mean[0] + mean[1] + held[0] - T(value);
		return true;
	}
};

TEST(LeastSquares, WhatIsHeldTakesNoDegreeOfFreedom)
{
	double mean[2] = { 0, 0 }, held[5] = {};
	ceres::Problem problem;
	for (const double value : { 1.0, 2.0, 4.0, 5.0 })
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Measured, 1, 2, 5>(new Measured{ value }), nullptr, mean, held);
	problem.SetManifold(mean, new ceres::SubsetManifold(2, { 1 }));
	problem.SetParameterBlockConstant(held);
	ASSERT_TRUE(SolveLeastSquares({ ceres::DENSE_QR, 50, 1e-14 }, problem));
	EXPECT_NEAR(mean[0], 3, 1e-6);   // as near as damped steps come
	EXPECT_NEAR(VarianceOfResiduals(problem), (4 + 1 + 1 + 4) / 3., 1e-9);   // a sample's variance
}

#ifdef __linux__
TEST(LeastSquares, OneThreadFindsTheSame)
{
	const Task task = TwoStates({}, Tilted(5), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	cpu_set_t all, one;
	ASSERT_EQ(sched_getaffinity(0, sizeof(all), &all), 0);
	if (CPU_COUNT(&all) < 2)
		GTEST_SKIP() << "one processor";
	EXPECT_GT(AllThreads(), 1);
	const Calibration many = Calibrate(task, { Model::PLANE, Poses::AUTO });
	CPU_ZERO(&one);
	for (int k = 0; k < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++k)
		if (CPU_ISSET(k, &all))
			CPU_SET(k, &one);
	ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
	EXPECT_EQ(AllThreads(), 1);
	const Calibration single = Calibrate(task, { Model::PLANE, Poses::AUTO });
	sched_setaffinity(0, sizeof(all), &all);
	// Where it stops may differ within the tolerance of the cost, 1e-9: 1e-4 of a sigma.
	EXPECT_NEAR(many.solution.w_mm.value, single.solution.w_mm.value, 1e-3 * single.solution.w_mm.sigma);
	EXPECT_NEAR(many.solution.states[1].lens_tilt.value, single.solution.states[1].lens_tilt.value, 1e-3 * single.solution.states[1].lens_tilt.sigma);
}
#endif

}
