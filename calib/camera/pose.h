// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where a calibrated camera stood, from points of known place in one photograph.

#ifndef TILTCAL_POSE_H
#define TILTCAL_POSE_H

#include "camera/pose_points.h"
#include "camera/state_camera.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace tiltcal
{

/// X_camera = camera_from_world (X_world - location). World: left-handed, scene units; camera
/// axes of camera.h, so that the rows of camera_from_world are right, up and forward in the world.
struct CameraPose
{
	Eigen::Matrix3d camera_from_world = Eigen::Matrix3d::Identity();
	Eigen::Vector3d location = Eigen::Vector3d::Zero();
	/// One standard deviation, from the points' scatter alone; NaN with fewer than 6 points.
	Eigen::Vector3d location_sigma = Eigen::Vector3d::Zero();   ///< along x, y, z of the world, scene units
	Eigen::Vector3d rotation_sigma_deg = Eigen::Vector3d::Zero();   ///< about the camera's right, up and forward
	std::vector<Eigen::Vector2d> residuals;                     ///< px, predicted - measured, in the points' order
	double rms = 0;                                             ///< px, sqrt(mean(dx^2 + dy^2))
	double misfit = 0;                                          ///< sum of the squared residuals as the fit weighs them, px^2
	size_t worst = 0;                                           ///< index of the largest residual
	double far_off = 0;                                         ///< px, times the point's sigma, beyond which it is no noise; the fit hardly counts it
	int outliers = 0;                                           ///< points farther off than that
};

/// Pixel where the camera sees a point of the world. False: the point is not in front of the lens.
bool SeenAt(const StateCamera& camera, const CameraPose& pose, const Vec3<double>& world, Point& pixel);

/// Throws Refused, naming the line, where a point's pixel is given and lies outside the calibrated picture.
void RefuseOutside(const StateCamera& camera, const std::vector<PosePoint>& points, const std::string& file);

/// Fits the pose: closed-form starts (SQPnP, RANSAC, the mirror image about the line of sight that
/// a flat set of points confuses with the truth), each refined with Project of camera.h and a
/// loss that is quadratic to three robust standard deviations. Throws Refused, naming `file` and
/// line: fewer than 4 points, a point without a pixel, points on one line, outside the picture, behind the camera; a
/// mirrored world fits far better; two poses fit equally; no camera fits.
/// Of a camera with aberrations by the mean of all rays to a pixel, for which it must know the scene's unit.
CameraPose SolvePose(const StateCamera& camera, const std::vector<PosePoint>& points, const std::string& file, double unit_mm = 1);

/// A camera block for the patched POV-Ray: location, direction, right and up are exact, so roll is kept. Before it
/// TiltCal_Pose_Location, _Look_At and _Sky, for the macros of the other states; TiltCal_Pose_Camera = 0 leaves the block out.
/// `unit_mm`: millimetres to a scene unit.
std::string PoseInc(const StateCamera& camera, const CameraPose& pose, double unit_mm);

/// RMS, sigmas and every point's residual, for people.
std::string PoseText(const CameraPose& pose, const std::vector<PosePoint>& points);

}

#endif
