// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/least_squares.h"

#include <ceres/solver.h>

namespace tiltcal
{

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
	if (summary.IsSolutionUsable())
		return summary.final_cost;
	if (why)
		*why = summary.message;
	return std::nullopt;
}

}
