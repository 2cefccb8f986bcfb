// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Vectors of the oracle, which shares no code with the camera under test.
#pragma once
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

using Vector = std::array<double, 3>;

inline double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector Times(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline Vector Plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector Cross(const Vector& a, const Vector& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector Unit(const Vector& a) { return Times(a, 1 / std::sqrt(Dot(a, a))); }
inline double Radians(double degrees) { return degrees * 3.14159265358979323846 / 180; }

// To the last digit, for the scene language.
inline std::string Sdl(double number)
{
	std::ostringstream out;
	out << std::setprecision(17) << number;
	return out.str();
}
inline std::string Sdl(const Vector& a) { return "<" + Sdl(a[0]) + ", " + Sdl(a[1]) + ", " + Sdl(a[2]) + ">"; }
