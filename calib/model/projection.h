// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the board to the picture, templated for Ceres.
//
// Frames (both left-handed, as POV-Ray's): board of frames.h; camera with its origin at
// the lens centre, x right, y up, z forward. Pixels: (0, 0) top left, v downwards.
// A change of handedness is the same flip of y on both sides, so that the rotation
// between the frames is a proper one: R_here = F R_opencv F with F = diag(1, -1, 1).

#ifndef TILTCAL_PROJECTION_H
#define TILTCAL_PROJECTION_H

#include <ceres/rotation.h>
#include "lens/distortion.h"
#include "lens/optics.h"
#include "lens/pupil_magnification.h"

#include <tiltcal/frames.h>

namespace tiltcal
{

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

/// A direction in the lens's own axes after distortion, and what it came from.
template<typename T>
struct SeenThroughLens
{
	T x, y;          ///< ideal, in units of the axial distance, y down
	Vec3<T> v;       ///< distorted, camera frame, v.n = 1
};

/// The distortion belongs to the lens, so it acts about the lens axis n: P is taken to the lens's
/// own axes (BasisOfLensPlane), distorted there in units of the axial distance, and taken back.
template<typename T>
inline SeenThroughLens<T> SeeThroughLens(const T* distortion, const Vec3<T>& n, const tilt_lens::LensBasis<T>& basis, const Vec3<T>& P)
{
	const T depth = Dot(P, n), x = Dot(P, basis.a) / depth, y = -Dot(P, basis.b) / depth;
	T d[2];
	tilt_lens::Distort(distortion, x, y, d);
	return { x, y, d[0] * basis.a - d[1] * basis.b + n };
}

template<typename T>
inline Vec3<T> Lifted(const Vec3<double>& v) { return { T(v.x), T(v.y), T(v.z) }; }

/// How one state puts points in its picture: image distance in pixels, distortion, principal point (px) and the unit lens normal
/// n with its axes.
template<typename T>
struct PictureOf
{
	T w_px;
	const T *distortion, *principal_point;
	Vec3<T> n;
	tilt_lens::LensBasis<T> basis;

	/// Pixel (u, v) of P = (x, y, z), z > 0, seen through the lens. With n = e_z this is OpenCV's model with its centre at the
	/// principal point. (Measured in photos-45mm: 0.10 px instead of 0.36.)
	void Project(const Vec3<T>& P, T* pixel) const
	{
		const Vec3<T> v = SeeThroughLens(distortion, n, basis, P).v;
		pixel[0] = principal_point[0] + w_px * v.x / v.z;
		pixel[1] = principal_point[1] - w_px * v.y / v.z;
	}

	/// Project for a lens whose exit pupil is m times as large as its entrance pupil (m 1: Project; lens/pupil_magnification.h).
	/// The principal point is that of the exit pupil.
	void ProjectThroughPupils(const T& m, const Vec3<T>& P, T* pixel) const
	{
		const Vec3<T> v = tilt_lens::DirectionBehindPupils(n, m, SeeThroughLens(distortion, n, basis, P).v);
		pixel[0] = principal_point[0] + m * w_px * v.x / v.z;
		pixel[1] = principal_point[1] - m * w_px * v.y / v.z;
	}

	/// Derivative by P of the pixel's place along the picture direction (nx, ny), y down: d(nx u + ny v)/dP, px/mm.
	Vec3<T> Gradient(const Vec3<T>& P, const T& nx, const T& ny) const
	{
		const T depth = Dot(P, n);
		const SeenThroughLens<T> seen = SeeThroughLens(distortion, n, basis, P);
		// By the chain rule backwards: pixel by v, v by the distorted point, that by the ideal one, that by P.
		const T a = nx * w_px / seen.v.z, b = -ny * w_px / seen.v.z;
		const Vec3<T> by_v{ a, b, -(a * seen.v.x + b * seen.v.y) / seen.v.z };
		const T by_X = Dot(by_v, basis.a), by_Y = -Dot(by_v, basis.b);
		T J[4];
		tilt_lens::DistortJacobian(distortion, seen.x, seen.y, J);
		const T by_x = by_X * J[0] + by_Y * J[2], by_y = by_X * J[1] + by_Y * J[3];
		return (T(1) / depth) * (by_x * basis.a - by_y * basis.b - (by_x * seen.x + by_y * seen.y) * n);
	}
};

/// Of a lens normal that is given.
template<typename T>
inline PictureOf<T> MakePicture(const T& w_px, const T* distortion, const T* principal_point, const Vec3<double>& n)
{
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	return { w_px, distortion, principal_point, Lifted<T>(n), { Lifted<T>(basis.a), Lifted<T>(basis.b) } };
}

}

#endif
