// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_POSE_FIT_H
#define TILTCAL_POSE_FIT_H

#include "camera/pose_points.h"
#include "camera/state_camera.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace tiltcal
{

/// A local minimum of the reprojection error. X_camera = rotation (X_world - location).
struct PoseMinimum
{
	Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
	Eigen::Vector3d location = Eigen::Vector3d::Zero();
	double misfit = 0;   ///< sum of squared residuals, over their points' sigmas, under the loss, px^2
};

/// The points of one photograph, their world moved to the centroid and scaled to a spread of
/// 1, so that coordinates of 1e7 and 1e-7 are fitted alike.
class PoseFit
{
public:
	/// `unit_mm`: of the world's unit, which a camera with aberrations needs to know.
	PoseFit(const StateCamera& camera, const std::vector<PosePoint>& points, double unit_mm);

	/// Every local minimum that is found, best first, in the normalised world; empty when no
	/// start has all points in front of the lens. `scale_px` receives the standard deviation
	/// that the residuals of the best one show, robustly, of points of sigma 1.
	std::vector<PoseMinimum> Minima(double& scale_px) const;

	/// Lines of the points that the closed form would have behind the lens.
	std::vector<int> LinesBehind() const;

	/// predicted - measured, px.
	std::vector<Eigen::Vector2d> Residuals(const PoseMinimum& minimum) const;

	/// Covariance of (rotation about the camera's axes in radians, location), residuals taken as 1 px.
	/// False when it is singular.
	bool Covariance(const PoseMinimum& minimum, double scale_px, Eigen::Matrix<double, 6, 6>& covariance) const;

	/// Singular values of the points' places: the second is 0 on a line, the third in a plane.
	Eigen::Vector3d Extents() const { return extents; }

	Eigen::Vector3d ToWorld(const Eigen::Vector3d& normalised) const { return centroid + spread * normalised; }
	double Spread() const { return spread; }

private:
	std::vector<PoseMinimum> Starts() const;
	PoseMinimum MirroredAboutSight(const PoseMinimum& minimum) const;
	bool Refine(double loss_px, PoseMinimum& minimum) const;
	double RobustScale(const PoseMinimum& minimum) const;

	StateCamera camera;
	Vec3<double> normal;
	std::vector<PosePoint> points;          ///< normalised; through a real lens the pixels of a pinhole that sees the same rays
	std::vector<Vec3<double>> origins;      ///< of these rays, camera frame, normalised
	Eigen::Vector3d centroid = Eigen::Vector3d::Zero(), extents = Eigen::Vector3d::Zero(), flat_normal = Eigen::Vector3d::UnitZ();
	double spread = 1;
};

/// Whether two minima are the same camera: less than half a degree and a hundredth of the distance apart.
bool SamePose(const PoseMinimum& a, const PoseMinimum& b);

}

#endif
