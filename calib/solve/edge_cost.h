// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What one edge says of the camera, for joint_fit.cpp.

#ifndef TILTCAL_EDGE_COST_H
#define TILTCAL_EDGE_COST_H

#include "model/projection.h"
#include <tiltcal/calibration.h>
#include "model/footprint.h"
#include "model/lens_model.h"

#include <ceres/cost_function.h>

namespace tiltcal
{

/// Where the camera puts an edge and how wide it blurs it.
struct EdgeModel
{
	LensModel model;
	double X, Y;       ///< board, mm
	double u, v;       ///< where it was measured, px
	double nx, ny;     ///< its normal in the picture, unit, y down
	double pitch_mm;
	Vec3<double> axis;     ///< lens normal about which the distortion acts, unless axis_is_free
	bool axis_is_free;     ///< it is the normal of the lens whose plane of focus the state has

	/// seen[0]: place along the normal from (u, v); seen[1]: blur width; px. Blocks: w_px 1, distortion 5,
	/// principal point 2, pose 6, d 1, floor^2 1, power 1, curvature 2, the state's numbers 3, its lens centre 3
	/// (subtracted from what the pose gives), pupil magnification 1.
	template<typename T>
	bool operator()(const T* w_px, const T* distortion, const T* principal_point, const T* pose,
		const T* d, const T* floor_squared, const T* power, const T* curvature, const T* state, const T* lens_centre, const T* pupil_magnification, T* seen) const
	{
		using std::sqrt;
		const Vec3<T> P = CameraFromBoard(pose, X, Y) - Vec3<T>{ lens_centre[0], lens_centre[1], lens_centre[2] };
		if (P.z <= T(1e-9))
			return false;
		const T w_mm = *w_px * T(pitch_mm);
		const Vec3<T> q = PlaneOfState(model, power, state, w_mm);
		const Vec3<T> n = tilt_lens::LensFromPlane(q, T(1) / w_mm).normal;
		const Vec3<T> seen_about = axis_is_free ? n : Lifted<T>(axis);
		const tilt_lens::LensBasis<T> basis = tilt_lens::BasisOfLensPlane(seen_about);
		T pixel[2];
		ProjectThroughPupils(*w_px, *pupil_magnification, distortion, principal_point, seen_about, basis, P, pixel);
		seen[0] = T(nx) * (pixel[0] - T(u)) + T(ny) * (pixel[1] - T(v));
		const Vec3<T> G = PixelGradient(*w_px, distortion, seen_about, basis, P, T(nx), T(ny));
		// The tiny constant keeps the root smooth where blur and floor both vanish.
		seen[1] = sqrt(SquaredFootprintWidth(*d, q, n, curvature, P, G) + *floor_squared + T(1e-6));
		return true;
	}
};

EdgeModel MakeEdgeModel(const Task& task, LensModel model, const Edge& edge, const Vec3<double>& axis, bool axis_is_free);

/// 1/px.
struct EdgeWeights
{
	double offset, blur;
};

/// Two residuals: place and blur width, against the measured ones.
ceres::CostFunction* NewEdgeCost(const EdgeModel& edge, double blur_px, const EdgeWeights& weights);

/// A residual for every bin of the edge's profile: its brightness against that of an edge where and as wide
/// as the camera says (disc_edge.h), dark and bright side fitted to every edge anew (variable projection;
/// the derivatives are Kaufman's, 1975). Weighted so that the edge counts for its blur as much as in NewEdgeCost.
ceres::CostFunction* NewPhotometricCost(const EdgeModel& edge, const Edge& measured, const EdgeWeights& weights);

}

#endif
