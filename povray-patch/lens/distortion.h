// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `distortion`: Brown-Conrady as in OpenCV (k1, k2, p1, p2, k3), forward
// from ideal to image. It belongs to the lens, so it acts about the lens axis: a
// direction is taken to the lens's own axes, distorted there in units of the axial
// distance, and taken back; the sensor then cuts it. For a lens that is not tilted
// that is OpenCV's projectPoints to the letter, with its centre at the principal
// point. x right, y down, as there.

#ifndef TILT_LENS_DISTORTION_H
#define TILT_LENS_DISTORTION_H

#include <cmath>

#include "lens/vec3.h"

namespace tilt_lens
{

/// Number of coefficients, in OpenCV's order k1, k2, p1, p2, k3.
const int DistortionTerms = 5;

/// From the ideal point (x, y) to the image point: Brown (1966), Conrady (1919).
template<typename T>
inline void Distort(const T* k, const T& x, const T& y, T* image)
{
	const T r2 = x * x + y * y;
	const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
	image[0] = x * radial + T(2) * k[2] * x * y + k[3] * (r2 + T(2) * x * x);
	image[1] = y * radial + k[2] * (r2 + T(2) * y * y) + T(2) * k[3] * x * y;
}

/// The derivative of Distort by (x, y), row by row: { dX/dx, dX/dy, dY/dx, dY/dy }.
template<typename T>
inline void DistortJacobian(const T* k, const T& x, const T& y, T* jacobian)
{
	const T r2 = x * x + y * y;
	const T radial = T(1) + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
	const T slope = T(2) * (k[0] + r2 * (T(2) * k[1] + r2 * T(3) * k[4]));
	jacobian[0] = radial + slope * x * x + T(2) * k[2] * y + T(6) * k[3] * x;
	jacobian[1] = slope * x * y + T(2) * k[2] * x + T(2) * k[3] * y;
	jacobian[2] = jacobian[1];
	jacobian[3] = radial + slope * y * y + T(6) * k[2] * y + T(2) * k[3] * x;
}

/// The ideal point of the image point (X, Y), by Newton's method from the point
/// (x, y) on, which is replaced. False where it does not converge on the branch
/// that holds the centre, on which the Jacobian's determinant is positive.
inline bool Undistort(const double* k, double X, double Y, double& x, double& y)
{
	const double size = 1.0 + std::fabs(X) + std::fabs(Y);
	double best = HUGE_VAL;

	for(int i = 0; i < 50; i++)
	{
		double image[2], j[4];
		Distort(k, x, y, image);
		const double ex = X - image[0], ey = Y - image[1];
		const double error = std::fabs(ex) + std::fabs(ey);
		DistortJacobian(k, x, y, j);
		const double determinant = j[0] * j[3] - j[1] * j[2];
		if(!(determinant > 0.0) || !(error < HUGE_VAL))
			return false;
		// Done at rounding, or where rounding lets it get no better.
		if(error <= 1e-15 * size || (i > 5 && !(error < best) && error <= 1e-13 * size))
			return true;
		best = error < best ? error : best;
		x += (j[3] * ex - j[1] * ey) / determinant;
		y += (j[0] * ey - j[2] * ex) / determinant;
	}
	return false;
}

/// Whether Undistort, started at the image point itself as the renderer does, gives
/// the point that the centre's branch leads to, for the image point (X, Y). Walks
/// there from the centre in small steps; false where the distortion folds on the way.
inline bool IsInvertible(const double* k, double X, double Y)
{
	const int steps = 64;
	double x = 0.0, y = 0.0;
	for(int i = 1; i <= steps; i++)
		if(!Undistort(k, X * i / steps, Y * i / steps, x, y))
			return false;
	double direct_x = X, direct_y = Y;
	return Undistort(k, X, Y, direct_x, direct_y) &&
	       std::fabs(direct_x - x) + std::fabs(direct_y - y) < 1e-9 * (1.0 + std::fabs(X) + std::fabs(Y));
}

/// The ideal direction of the image direction v (any length, v.n > 0) for a lens
/// with the orthonormal axes a, b (right, up) and n. Only defined where the camera
/// was accepted (see IsInvertible); elsewhere v comes back unchanged.
inline Vec3<double> UndistortDirection(const double* k, const Vec3<double>& a, const Vec3<double>& b,
                                       const Vec3<double>& n, const Vec3<double>& v)
{
	const double depth = Dot(v, n);
	const double X = Dot(v, a) / depth, Y = -Dot(v, b) / depth;
	double x = X, y = Y;
	if(!Undistort(k, X, Y, x, y))
		return v;
	return depth * (x * a - y * b + n);
}

}

#endif
