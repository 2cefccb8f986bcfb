// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the board to the picture, templated for Ceres.
//
// Frames (both left-handed, as POV-Ray's): board of board.h; camera with its origin at
// the lens centre, x right, y up, z forward. Pixels: (0, 0) top left, v downwards.
// A change of handedness is the same flip of y on both sides, so that the rotation
// between the frames is a proper one: R_here = F R_opencv F with F = diag(1, -1, 1).

#ifndef TILTCAL_CAMERA_H
#define TILTCAL_CAMERA_H

#include <ceres/rotation.h>
#include <tilt_lens/vec3.h>

#include <array>

namespace tiltcal
{

using tilt_lens::Vec3;

/// cam_from_board: angle-axis rotation (radians) and translation (mm).
using Pose = std::array<double, 6>;
/// k1, k2, p1, p2, k3 of Brown-Conrady, in OpenCV's order and axes (y down).
using Distortion = std::array<double, 5>;
/// Principal point, pixels.
using Point = std::array<double, 2>;

/// X_camera = R X_board + t; the board is z = 0. mm.
template<typename T>
inline Vec3<T> CameraFromBoard(const T* pose, double x, double y)
{
	const T board[3] = { T(x), T(y), T(0) };
	T p[3];
	ceres::AngleAxisRotatePoint(pose, board, p);
	return { p[0] + pose[3], p[1] + pose[4], p[2] + pose[5] };
}

/// Pixel (u, v) of P = (x, y, z), z > 0: Brown-Conrady from ideal to image in units of w
/// (OpenCV, "Camera Calibration and 3D Reconstruction"), then w_px and the principal point.
template<typename T>
inline void Project(const T& w_px, const T* distortion, const T* principal_point, const Vec3<T>& P, T* pixel)
{
	const T x = P.x / P.z, y = -P.y / P.z;
	const T r2 = x * x + y * y;
	const T radial = T(1) + r2 * (distortion[0] + r2 * (distortion[1] + r2 * distortion[4]));
	const T& p1 = distortion[2];
	const T& p2 = distortion[3];
	const T xd = x * radial + T(2) * p1 * x * y + p2 * (r2 + T(2) * x * x);
	const T yd = y * radial + p1 * (r2 + T(2) * y * y) + T(2) * p2 * x * y;
	pixel[0] = principal_point[0] + w_px * xd;
	pixel[1] = principal_point[1] + w_px * yd;
}

}

#endif
