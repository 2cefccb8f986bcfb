// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SOLVE_GEOMETRY_H
#define TILTCAL_SOLVE_GEOMETRY_H

#include <tiltcal/calibration.h>

#include <ceres/problem.h>

#include <optional>

namespace tiltcal
{

struct GeometryOptions
{
	/// Brown-Conrady coefficients: 0 none, 1 k1, 2 k1 k2, 4 k1 k2 p1 p2, 5 all.
	int terms = 0;
	/// Per state, camera frame; empty: untilted everywhere.
	std::vector<Vec3<double>> lens_normal;
	/// Photograph n of every state shows the board in the same place, only the lens was
	/// tilted in between (as in the paper). Then the principal point of a tilted state
	/// is the shift of the picture, told from the camera's rotation; with poses of their
	/// own the two compensate each other almost wholly (in photos-45mm: 14 px).
	/// Needs as many photographs in every state.
	bool shared_poses = false;
	bool may_distort = true;   ///< SelectGeometry: false leaves it at no terms
};

/// Least squares of the reprojection over all photographs of all states: common image
/// distance, common distortion about each state's own lens axis, a principal point per
/// state, and a pose per photograph or per photograph number.
/// Starts from cv::calibrateCamera. A principal point that the photographs do not
/// determine (sigma above 2 % of the picture's width) is held near the picture's centre, to those 2 %.
/// Throws Refused when w is not determined, naming what to photograph.
Geometry SolveGeometry(const Task& task, const GeometryOptions& options);

/// The same; none where it is refused.
std::optional<Geometry> SolveGeometryIfDetermined(const Task& task, const GeometryOptions& options);

/// The smallest distortion model after which the next larger one lowers the RMS by less
/// than 1.5 % or has no coefficient that is 2 sigma from 0: coefficients that only fit noise spoil the picture beyond the board.
/// `options.terms` is not used.
Geometry SelectGeometry(const Task& task, GeometryOptions options);

/// Of every state.
std::vector<Vec3<double>> LensNormals(const Geometry& geometry);

/// The block that holds a photograph's pose.
inline Pose& PoseOf(Geometry& g, size_t state, size_t photo) { return g.states[g.shared_poses ? 0 : state].poses[photo]; }

/// Keeps at 0 what the distortion model does not contain.
void HoldDistortion(Geometry& geometry, ceres::Problem& problem);

/// Adds what is known of the principal points that are `principal_point_fixed`: the picture's centre, give or take 2 % of its width.
void AddPrincipalPointPriors(const Task& task, Geometry& geometry, ceres::Problem& problem);

/// Fills photo_rms and rms.
void MeasureReprojection(const Task& task, Geometry& geometry);

}

#endif
