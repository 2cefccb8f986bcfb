// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The calibration's one call of Ceres' solver.

#ifndef TILTCAL_LEAST_SQUARES_H
#define TILTCAL_LEAST_SQUARES_H

#include <ceres/problem.h>
#include <ceres/types.h>

#include <optional>
#include <string>

namespace tiltcal
{

/// How a problem is solved; the tolerances are Ceres' relative ones.
struct LeastSquares
{
	ceres::LinearSolverType linear_solver = ceres::DENSE_QR;
	int iterations = 50;
	double function_tolerance = 1e-6, parameter_tolerance = 1e-8, gradient_tolerance = 1e-10;
	int threads = 1;
	bool may_stop_early = false;   ///< the limit of iterations is no failure
};

/// As many as this process may use. Sums come out in another order then, and results differ in their last digits.
int AllThreads();

/// AllThreads gives at most so many from now on; 0: no limit. Returns the limit before, or 0.
int LimitThreads(int most);

/// Solves in place, in silence. Returns the cost, half the sum of the squares as their losses count them; none where Ceres did not
/// converge; then `why` holds its words.
std::optional<double> SolveLeastSquares(const LeastSquares& how, ceres::Problem& problem, std::string* why = nullptr);

/// What residuals that should have a variance of 1 have where the problem stands, as their losses count them: the scale of its covariances. What is held constant, or by a manifold,
/// was not fitted and takes no degree of freedom.
double VarianceOfResiduals(ceres::Problem& problem);

}

#endif
