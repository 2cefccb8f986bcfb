// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of the exact models: measured blur widths against the footprint of the lens (footprint.h).

#ifndef TILTCAL_BLUR_FIT_H
#define TILTCAL_BLUR_FIT_H

#include <tiltcal/calibration.h>
#include "model/lens_model.h"
#include "solve/lens_covariance.h"
#include "solve/stop_ratios.h"

#include <Eigen/Core>
#include <ceres/problem.h>

#include <optional>
#include <vector>

namespace tiltcal
{

/// One measured edge.
struct Observation
{
	size_t state, photo;
	Vec3<double> P;       // camera frame, mm
	Vec3<double> gradient;   // footprint.h, px/mm
	double blur, sigma;   // px
	size_t stop = 0;      // of the task
};

/// Every edge of the task, placed by `geometry`'s poses.
std::vector<Observation> Observe(const Task& task, const Geometry& geometry);

struct Unknowns
{
	double d = 0;              // mm
	double floor_squared = 1;  // px^2; squared, because the blur does not change with floor at 0
	double power = 0;          // 1/f, 1/mm; RIGID only
	std::array<double, 2> curvature{ 0, 0 };   // footprint.h, 1/mm; BOWL: the first, BOWLS: both
	std::vector<StateNumbers> state;
	bool untilted_free = false;   // state 0 has a tilt too
	StopRatios stops;
};

/// Which unknowns move in a fit.
enum class Free
{
	UNTILTED,    ///< d, floor and the untilted state, on its edges
	ONE_STATE,   ///< one tilted state's own numbers, on its edges
	EVERYTHING   ///< field curvature and the further stops too, which the others hold
};

/// Holds what the model does not have, and what the untilted state keeps at 0, of a problem's blocks.
void HoldUnused(LensModel model, Unknowns& x, ceres::Problem& problem);

/// Where w and the unknowns stand in the covariance of a fit.
struct UnknownIndex
{
	enum
	{
		W,
		D,
		FLOOR_SQUARED,
		POWER,
		CURVATURE,
		STATES = CURVATURE + 2
	};
	static int OfState(size_t state) { return STATES + 3 * static_cast<int>(state); }
	/// Of all of them: the states and, last, the further stops.
	static int Size(const Unknowns& x) { return OfState(x.state.size()) + static_cast<int>(x.stops.Further()); }
};

/// What LensCovariance holds, by w (mm) and the unknowns in the order of UnknownIndex; automatic derivatives.
Eigen::MatrixXd PlanesByUnknowns(LensModel model, const Unknowns& x, double w_mm);

/// From the covariance of w (mm) and the unknowns, in the order of UnknownIndex.
LensCovariance CovarianceOfPlanes(LensModel model, const Unknowns& x, double w_mm, const Eigen::MatrixXd& of_unknowns);

struct BlurFit
{
	LensModel model;
	const std::vector<Observation>& observations;
	double w_mm;
	double model_sigma;    ///< px: what the model leaves out, common to all edges
	const std::vector<Prior>& priors;
	const std::vector<Stop>& stops;

	/// Predicted minus measured, px.
	double Residual(const Observation& o, const Unknowns& x) const;

	Vec3<double> Plane(const Unknowns& x, size_t state) const;

	/// Robust fit from x, in place; `state` counts for ONE_STATE. Returns the final cost (half the
	/// weighted sum of squares), none without convergence.
	std::optional<double> Minimise(Unknowns& x, Free free, size_t state) const;

	/// Mean inverse depth of the edges, 1/mm: what is small beside it is small for a q, also where the focus is at infinity and q_z is 0.
	double Nearness() const;

	/// RobustSigma of the residuals, px.
	double Scale(const Unknowns& x) const;

	/// What model_sigma should be for these.
	double LeftOutBy(const Unknowns& x) const;

	/// w is held, and has the standard deviation given. Throws Refused when the fit is singular.
	LensCovariance Covariance(Unknowns x, double w_sigma_mm) const;
};

}

#endif
