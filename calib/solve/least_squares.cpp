// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/least_squares.h"

#include <ceres/solver.h>

#include <algorithm>
#include <atomic>
#include <thread>
#ifdef __linux__
#include <sched.h>
#endif

namespace tiltcal
{

namespace
{

std::atomic<int> most_threads{ 0 };

}

int LimitThreads(int most) { return most_threads.exchange(most); }

int AllThreads()
{
	int threads = static_cast<int>(std::thread::hardware_concurrency());
#ifdef __linux__
	// The machine's processors are not always this process's (taskset, a container).
	cpu_set_t mine;
	if (sched_getaffinity(0, sizeof(mine), &mine) == 0)
		threads = CPU_COUNT(&mine);
#endif
	if (const int most = most_threads; most > 0)
		threads = std::min(threads, most);
	// More gain nothing at the size of these problems.
	return std::clamp(threads, 1, 16);
}

std::optional<double> SolveLeastSquares(const LeastSquares& how, ceres::Problem& problem, std::string* why)
{
	ceres::Solver::Options options;
	options.linear_solver_type = how.linear_solver;
	options.max_num_iterations = how.iterations;
	options.function_tolerance = how.function_tolerance;
	options.parameter_tolerance = how.parameter_tolerance;
	options.gradient_tolerance = how.gradient_tolerance;
	options.num_threads = how.threads;
	options.logging_type = ceres::SILENT;
	ceres::Solver::Summary summary;
	ceres::Solve(options, &problem, &summary);
	// Usable, to Ceres, is also where it stopped at the limit of iterations.
	if (summary.termination_type == ceres::CONVERGENCE || (how.may_stop_early && summary.IsSolutionUsable()))
		return summary.final_cost;
	if (why)
		*why = summary.message;
	return std::nullopt;
}

double VarianceOfResiduals(ceres::Problem& problem)
{
	std::vector<double*> blocks;
	problem.GetParameterBlocks(&blocks);
	int free_numbers = 0;
	for (const double* block : blocks)
		free_numbers += problem.IsParameterBlockConstant(block) ? 0 : problem.ParameterBlockTangentSize(block);
	double cost = 0;
	problem.Evaluate(ceres::Problem::EvaluateOptions(), &cost, nullptr, nullptr, nullptr);
	return 2 * cost / std::max(problem.NumResiduals() - free_numbers, 1);
}

}
