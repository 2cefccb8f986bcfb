// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How the checks of a camera say no. Free of POV-Ray.

#ifndef TILT_LENS_REFUSAL_H
#define TILT_LENS_REFUSAL_H

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "lens/vec3.h"

namespace tilt_lens
{

/// Thrown inside ResolveTiltLens only; carries the text for the parse error.
struct Refusal
{
	std::string text;
};

[[noreturn]] __attribute__((format(printf, 1, 2)))
inline void Refuse(const char* format, ...)
{
	char buffer[512];
	va_list arguments;
	va_start(arguments, format);
	std::vsnprintf(buffer, sizeof(buffer), format, arguments);
	va_end(arguments);
	throw Refusal{ buffer };
}

// Compilers may assume away NaN under fast-math; comparisons that both ends fail
// survive it often enough, but POV-Ray is built without it for exactly this.
inline bool IsFinite(double x) { return std::isfinite(x); }
inline bool IsFinite(const Vec3<double>& v) { return IsFinite(v.x) && IsFinite(v.y) && IsFinite(v.z); }

}

#endif
