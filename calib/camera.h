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
#include <tilt_lens/distortion.h>
#include <tilt_lens/optics.h>

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

/// The direction of the picture's centre is (shift, w) in camera axes (x right, y up), pixels:
/// tilt_lens's `shift` divided by the pitch.
inline Point ShiftOfPicture(int width, int height, const Point& principal_point)
{
	return { 0.5 * (width - 1) - principal_point[0], -(0.5 * (height - 1) - principal_point[1]) };
}

/// X_camera = R X_board + t; the board is z = 0. mm.
template<typename T>
inline Vec3<T> CameraFromBoard(const T* pose, double x, double y)
{
	const T board[3] = { T(x), T(y), T(0) };
	T p[3];
	ceres::AngleAxisRotatePoint(pose, board, p);
	return { p[0] + pose[3], p[1] + pose[4], p[2] + pose[5] };
}

/// Pixel (u, v) of P = (x, y, z), z > 0, seen through a lens with unit normal n.
/// The distortion belongs to the lens, so it acts about the lens axis: P is taken to
/// the lens's own axes (BasisOfLensPlane), distorted there in units of the axial distance,
/// taken back, and projected on the sensor. With n = e_z this is OpenCV's model with
/// its centre at the principal point. (Measured in photos-45mm: 0.10 px instead of 0.36.)
template<typename T>
inline void Project(const T& w_px, const T* distortion, const T* principal_point, const Vec3<double>& n, const Vec3<T>& P, T* pixel)
{
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	const auto lift = [](const Vec3<double>& v) { return Vec3<T>{ T(v.x), T(v.y), T(v.z) }; };
	const Vec3<T> a = lift(basis.a), b = lift(basis.b), c = lift(n);
	const T depth = Dot(P, c);
	T d[2];
	tilt_lens::Distort(distortion, Dot(P, a) / depth, -Dot(P, b) / depth, d);
	const Vec3<T> v = d[0] * a - d[1] * b + c;
	pixel[0] = principal_point[0] + w_px * v.x / v.z;
	pixel[1] = principal_point[1] - w_px * v.y / v.z;
}

}

#endif
