// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the exact models take a lens for: which numbers give a state's plane of focus.
// They differ in nothing else (solve/solve_lens.h).

#ifndef TILTCAL_LENS_MODEL_H
#define TILTCAL_LENS_MODEL_H

#include "lens/optics.h"
#include <tiltcal/calibration.h>

#include <array>

namespace tiltcal
{

using tilt_lens::Vec3;

/// q is free in every tilted state, not tied to the others by f and w.
inline bool HasFreePlanes(LensModel model) { return model != LensModel::RIGID; }
inline bool IsCurved(LensModel model) { return model == LensModel::BOWL || model == LensModel::BOWLS; }

/// A state's own numbers. With free planes: q, 1/mm; of a bowl, the plane that touches it on the lens axis. RIGID: n_x/n_z, n_y/n_z of the lens normal n, and
/// an unused 0; both are 0 without tilt, so nothing is singular there.
using StateNumbers = std::array<double, 3>;

/// q of a state, 1/mm. `power` is the common 1/f (1/mm; RIGID only), w in mm.
template<typename T>
inline Vec3<T> PlaneOfState(LensModel model, const T* power, const T* state, const T& w_mm)
{
	if (HasFreePlanes(model))
		return { state[0], state[1], state[2] };
	return tilt_lens::PlaneFromLens(tilt_lens::Normalized(Vec3<T>{ state[0], state[1], T(1) }), *power, T(1) / w_mm);
}

/// The numbers of the state whose plane of focus is q; RIGID keeps only q's lens normal.
inline StateNumbers StateOfPlane(LensModel model, const Vec3<double>& q, double w_mm)
{
	if (HasFreePlanes(model))
		return { q.x, q.y, q.z };
	const Vec3<double> n = tilt_lens::LensFromPlane(q, 1 / w_mm).normal;
	return { n.x / n.z, n.y / n.z, 0 };
}

}

#endif
