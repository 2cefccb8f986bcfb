// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From measured blur widths to the lens: the models of the same photographs.

#ifndef TILTCAL_SOLVE_LENS_H
#define TILTCAL_SOLVE_LENS_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// The exact model. Every measured edge at P = (x, y, z) in the camera frame has the width b
/// of the footprint of a disc in the lens plane (footprint.h); to first order it is the blur disc
///   b = w d |1 - q.P| / z,   seen as sqrt(b^2 + floor^2),
/// with d and the lens's own blur `floor` common, q = (0, 0, 1/U) untilted and q free in
/// each tilted state (the lens turns about a pivot, so U changes with the tilt). w and the
/// poses come from `geometry`. No sign is assumed: every side of the plane of focus and
/// every tilt direction is started from, and two answers of the same quality are a
/// refusal. Robust loss; measured sigmas plus a common model error.
/// Throws Refused when the photographs do not determine d, U or a state's q.
Solution SolvePlane(const Task& task, const Geometry& geometry);

/// The exact model of an ideal mount: SolvePlane, but the lens only turns about its centre and
/// keeps f, w and d in all states, so that q follows from the tilt by the vector lens equation,
/// q = n/f - e_z/w. Two unknowns per tilted state instead of three; the less a lens keeps to
/// this (a pivot away from the pupil), the more its tilt is off. Search, loss, sigmas and
/// refusals are SolvePlane's, except that the focal length cannot decide between two planes.
Solution SolveRigid(const Task& task, const Geometry& geometry);

/// SolvePlane, and the field curvature C common to all states (lens/field_curvature.h): the
/// plane q.P = 1 touches the bowl on the lens axis, so that its tilt is the lens's. One curvature, or a
/// tangential and a sagittal one where that predicts photographs left out better; C is then
/// their mean. Fills held_out_px.
/// A bowl seen in one part only looks like a tilted plane: without photographs on both sides of the axis
/// or without untilted ones the two are told apart badly, and sigma says so.
Solution SolveCurved(const Task& task, const Geometry& geometry);

/// rigid, plane or curved with held_out_px and left_out filled.
Solution SolveLeavingOut(Model model, const Task& task, const Geometry& geometry);

/// rigid, plane and curved with their held_out_px. Refusals of rigid and curved are their `failure`;
/// throws Refused where plane has no answer.
ModelComparison CompareExact(const Task& task, const Geometry& geometry);

/// A model with more unknowns must predict photographs better by 1 %: by chance alone a bowl does by some thousandths.
const double WORTH_IT = 0.99;

/// Whether `curved` is to be preferred to `plane`: C is 2 sigma from 0 and photographs left out are predicted better, by WORTH_IT.
bool CurvatureIsSeen(const Solution& plane, const Solution& curved);

/// The paper's model, printed equations (3), (4) and (1): stage 1 over all untilted
/// photographs for R, T, U, w, d; stage 2 one unknown tan(theta_F) per tilted state.
/// Features are the grid corners, their blur the mean of their edges' blur; no
/// distortion, no floor, principal point at the picture's centre, plain least squares.
/// Poses of tilted photographs are those of the untilted photograph of the same number
/// where `start` shares them, as in the paper, otherwise `start`'s.
/// `start` gives the first guess; `found` receives stage 1's camera and poses.
/// It has one aperture: photographs at several stops it fails.
/// Not an exception but Solution::failure says why it failed: it is also run for comparison.
Solution SolvePaper(const Task& task, const Geometry& start, Geometry& found);

/// One untilted blur observation for ScanUntilted.
struct DepthBlur
{
	double z, blur;   ///< mm, px
	double opening = 1;   ///< in those of which the diameter is found
};

struct UntiltedGuess
{
	double inverse_focus = 0, diameter = 0, cost = 0;   ///< 1/mm, mm
};

/// First guesses for 1/U and d of b = w d |1/U - 1/z|: local minima of the mean
/// absolute residual over 1/U, best first.
std::vector<UntiltedGuess> ScanUntilted(const std::vector<DepthBlur>& observations, double w_px);

}

#endif
