// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of everything at once: where edges lie and how wide they are, or their
// brightness itself, against one camera. Poses, image distance, distortion, principal points,
// aperture and planes of focus move together, so that each one's sigma knows of all others.

#ifndef TILTCAL_JOINT_FIT_H
#define TILTCAL_JOINT_FIT_H

#include "solve/blur_fit.h"

#include <tiltcal/calibrate.h>

#include <Eigen/Core>

#include <optional>

namespace tiltcal
{

/// What the model leaves out beside what measuring scatters, common to all edges, px.
struct ModelError
{
	double offset = 0.1, blur = 0.3;
};

/// Of the residuals of the task's edges as JointFit::Residuals gives them; not none.
ModelError ErrorOf(const Task& task, const std::vector<std::array<double, 2>>& residuals);

/// Robust standard deviations of residuals, noise and all, px; no less than ErrorOf may be.
struct EdgeScatter
{
	double offset, blur;
};
EdgeScatter ScatterOf(const std::vector<std::array<double, 2>>& residuals);

/// Of the edges, taken for independent; and by what the photographs say against each other (solve/by_photographs.h), where they can.
struct JointCovariance
{
	LensCovariance by_edges;
	std::optional<LensCovariance> by_photographs;
	double held_out = 0;   ///< RMS residual of each photograph as the others predict it, its pose its own, in sigmas; 0: cannot be had
};

/// What photographs say of the lens, to second order about a solution: by what is free of all that they have in common. Information adds up;
/// its inverse is a covariance, but for the residuals' variance; a row of `planes` and of `principal_points` takes that to what people read.
struct JointInformation
{
	Eigen::MatrixXd measured;                  ///< of all photographs and what is known beforehand
	std::vector<Eigen::MatrixXd> expected;     ///< of each further one
	Eigen::MatrixXd planes;                    ///< in the order of LensCovariance::At
	Eigen::MatrixXd principal_points;          ///< u and v of every state, px
};

struct JointFit
{
	const Task& task;
	LensModel model;
	Refinement kind = Refinement::EDGES;
	ModelError error;
	/// Blur counts nothing: what the places of edges say of the tilt, by the axis of the distortion and by the
	/// picture's keystone, which needs the pupil magnification free. Otherwise the axis is held: what a thin lens
	/// leaves out of a thick one's picture would pull at the tilt (photos-45mm: by 0.06 degrees).
	bool geometry_alone = false;

	/// Predicted minus measured place (across the edge) and blur width, px, of every edge; state by state.
	std::vector<std::array<double, 2>> Residuals(const Geometry& geometry, const Unknowns& x) const;

	/// Robust fit of both in place. False: no convergence.
	bool Minimise(Geometry& geometry, Unknowns& x) const;

	/// As BlurFit's, but of everything free; also fills the sigmas of `geometry`, each with the larger of both. None: singular.
	std::optional<JointCovariance> Covariance(Geometry& geometry, Unknowns& x) const;

	/// Of the task's photographs; those from number `measured` of their state on are further ones, not taken yet, state by state.
	JointInformation Information(Geometry& geometry, Unknowns& x, const std::vector<size_t>& measured) const;
};

}

#endif
