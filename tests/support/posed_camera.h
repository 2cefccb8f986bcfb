// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Points of a scene in a tilted, distorted camera's picture, put there by OpenCV's own model.

#ifndef POSED_CAMERA_H
#define POSED_CAMERA_H

#include "camera/pose_points.h"
#include "camera/state_camera.h"

#include <Eigen/Core>

#include <vector>

/// 1800 x 1200 pixels, tilted by 8 degrees towards 40, distorted.
tiltcal::StateCamera TiltedCamera();

struct PosedScene
{
	Eigen::Matrix3d camera_from_world;
	Eigen::Vector3d location;
};

/// A camera at `location` that looks at `at`, rolled by 20 degrees.
PosedScene LookAt(const Eigen::Vector3d& location, const Eigen::Vector3d& at);

/// Pixels by OpenCV's tilted sensor model, with Gaussian noise (px); lines count from 2.
std::vector<tiltcal::PosePoint> Photographed(const tiltcal::StateCamera& camera, const PosedScene& scene, const std::vector<Eigen::Vector3d>& world,
	double noise = 0, unsigned seed = 1);

/// Angle between two rotations.
double DegreesBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

#endif
