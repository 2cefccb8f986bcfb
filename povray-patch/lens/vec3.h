// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The three-vector of the optics headers: templated on the scalar, so that it
// works with double, long double and Ceres Jets, and free of POV-Ray and Eigen.

#ifndef TILT_LENS_VEC3_H
#define TILT_LENS_VEC3_H

#include <cmath>

namespace tilt_lens
{

template<typename T>
struct Vec3
{
	T x, y, z;
};

template<typename T>
inline Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) { return { a.x + b.x, a.y + b.y, a.z + b.z }; }

template<typename T>
inline Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }

template<typename T>
inline Vec3<T> operator*(const T& s, const Vec3<T>& a) { return { s * a.x, s * a.y, s * a.z }; }

template<typename T>
inline T Dot(const Vec3<T>& a, const Vec3<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

template<typename T>
inline Vec3<T> Cross(const Vec3<T>& a, const Vec3<T>& b)
{
	return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/// Euclidean length. Plain, not hypot: Jets have no three-argument hypot, and
/// callers scale (see ScaledLength) where over- or underflow can happen.
template<typename T>
inline T Length(const Vec3<T>& a)
{
	using std::sqrt;
	return sqrt(Dot(a, a));
}

/// Largest absolute component.
template<typename T>
inline T MaxAbs(const Vec3<T>& a)
{
	using std::abs;
	const T x = abs(a.x), y = abs(a.y), z = abs(a.z);
	return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

/// Euclidean length without over- or underflow of the squares.
template<typename T>
inline T ScaledLength(const Vec3<T>& a)
{
	const T m = MaxAbs(a);
	if (!(m > T(0)))
		return m;
	return m * Length(Vec3<T>{ a.x / m, a.y / m, a.z / m });
}

/// a / |a|; domain |a| > 0 and finite (the caller checks).
template<typename T>
inline Vec3<T> Normalized(const Vec3<T>& a)
{
	const T m = MaxAbs(a);
	const Vec3<T> scaled{ a.x / m, a.y / m, a.z / m };
	const T length = Length(scaled);
	return { scaled.x / length, scaled.y / length, scaled.z / length };
}

}

#endif
