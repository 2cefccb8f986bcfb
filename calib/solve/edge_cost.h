// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What one edge says of the camera, for joint_fit.cpp.

#ifndef TILTCAL_EDGE_COST_H
#define TILTCAL_EDGE_COST_H

#include "model/projection.h"
#include <tiltcal/calibration.h>
#include "model/footprint.h"
#include "edge/soft_radius.h"
#include "model/lens_model.h"

#include <ceres/autodiff_cost_function.h>

#include <array>

namespace tiltcal
{

/// The parameter blocks of one edge, in the order of EdgeCostFunction.
template<typename T>
struct EdgeBlocks
{
	const T *w_px, *distortion, *principal_point, *pose;
	const T *d, *floor_squared, *power, *curvature;
	const T *state;                ///< its numbers (model/lens_model.h)
	const T *lens_centre;          ///< subtracted from what the pose gives, mm
	const T *pupil_magnification;
};

/// A cost function of `Cost` with so many residuals and the blocks of EdgeBlocks.
template<typename Cost, int Residuals>
using EdgeCostFunction = ceres::AutoDiffCostFunction<Cost, Residuals, 1, 5, 2, 6, 1, 1, 1, 2, 3, 3, 1>;

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

	/// seen[0]: place along the normal from (u, v); seen[1]: soft blur width (edge/soft_radius.h); px.
	template<typename T>
	bool See(const EdgeBlocks<T>& b, T* seen) const
	{
		const Vec3<T> P = CameraFromBoard(b.pose, X, Y) - Vec3<T>{ b.lens_centre[0], b.lens_centre[1], b.lens_centre[2] };
		if (P.z <= T(1e-9))
			return false;
		const T w_mm = *b.w_px * T(pitch_mm);
		const Vec3<T> q = PlaneOfState(model, b.power, b.state, w_mm);
		const Vec3<T> n = tilt_lens::LensFromPlane(q, T(1) / w_mm).normal;
		const Vec3<T> seen_about = axis_is_free ? n : Lifted<T>(axis);
		const PictureOf<T> picture{ *b.w_px, b.distortion, b.principal_point, seen_about, tilt_lens::BasisOfLensPlane(seen_about) };
		T pixel[2];
		picture.ProjectThroughPupils(*b.pupil_magnification, P, pixel);
		seen[0] = T(nx) * (pixel[0] - T(u)) + T(ny) * (pixel[1] - T(v));
		const Vec3<T> G = picture.Gradient(P, T(nx), T(ny));
		seen[1] = SoftDiameterOfSquare(T(SquaredFootprintWidth(*b.d, q, n, b.curvature, P, G) + *b.floor_squared));
		return true;
	}

	/// For Ceres: the blocks' pointers one by one, then `seen`.
	template<typename T, typename... Rest>
	bool operator()(const T* w_px, Rest... rest) const
	{
		const std::array<const T*, 12> all{ w_px, rest... };
		return See<T>({ all[0], all[1], all[2], all[3], all[4], all[5], all[6], all[7], all[8], all[9], all[10] }, const_cast<T*>(all[11]));
	}
};

EdgeModel MakeEdgeModel(const Task& task, LensModel model, const Edge& edge, const Vec3<double>& axis, bool axis_is_free);

/// 1/px.
struct EdgeWeights
{
	double offset, blur;
};

/// Two residuals: place and soft blur width, against the measured ones.
ceres::CostFunction* NewEdgeCost(const EdgeModel& edge, double soft_blur_px, const EdgeWeights& weights);

/// The place alone. A second residual that is always 0 would count as one that fits, and halve the variance of all.
ceres::CostFunction* NewPlaceCost(const EdgeModel& edge, double weight);

/// A residual for every bin of the edge's profile: its brightness against that of an edge where and as wide
/// as the camera says (disc_edge.h), dark and bright side fitted to every edge anew (variable projection;
/// the derivatives are Kaufman's, 1975). Weighted so that the edge counts for its blur as much as in NewEdgeCost.
ceres::CostFunction* NewPhotometricCost(const EdgeModel& edge, const Edge& measured, const EdgeWeights& weights);

}

#endif
