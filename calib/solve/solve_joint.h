// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SOLVE_JOINT_H
#define TILTCAL_SOLVE_JOINT_H

#include "solve/joint_fit.h"

namespace tiltcal
{

/// Where a fit goes on from a solution.
Unknowns UnknownsOf(const Solution& solution);

/// Refines a solution of an exact model and its geometry together (joint_fit.h), in place: the numbers, all
/// sigmas (correlations between geometry and blur included) and the RMS values. False, and nothing changed, where
/// the fit does not converge or is singular.
bool RefineJointly(const Task& task, Refinement kind, Geometry& geometry, Solution& solution);

/// How well the others predict each photograph (JointCovariance::held_out) where the model's error is `error`, whatever this solution's own; 0: cannot be said.
double HeldOutOf(const Task& task, const Geometry& geometry, const Solution& solution, const ModelError& error);

/// The lens tilts as the places of the edges alone tell them, blur aside (JointFit::geometry_alone). The other
/// numbers of the states are `solution`'s. Nothing where they tell nothing: without distortion, with poses of every
/// state's own, which take up what a tilt does to the picture, or singular. The untilted state's is held, unless
/// `untilted_free`: then all are known less well.
GeometryAlone TiltFromGeometryAlone(const Task& task, const Geometry& geometry, const Solution& solution, bool untilted_free = false);

}

#endif
