// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a tilt_lens render says about itself afterwards. Free of POV-Ray.

#ifndef TILT_LENS_STATISTICS_H
#define TILT_LENS_STATISTICS_H

#include <cmath>
#include <cstdint>
#include <string>

#include "lens/convergence.h"
#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Light that few samples of a pixel meet, and other pixels may have met with none, after
/// Horvitz and Thompson: a pixel whose first n samples met light that one sample in 1/p meets stands for
/// (1 - p)^n / (1 - (1 - p)^n) like it whose first n did not. Those of them that went on for their
/// neighbours' sake, and met it later, are known, and taken off.
struct RareLight
{
	double missed = 0.0;            ///< sum over pixels of the squared light
	double variance = 0.0;          ///< of that sum

	RareLight& operator+=(const RareLight& o)
	{
		missed += o.missed;
		variance += o.variance;
		return *this;
	}

	/// What it may be, by one standard deviation.
	double Most() const { return missed + std::sqrt(variance); }

	/// Of a pixel: `light` that one of 1/p samples brings to it, and whether one of the first n brought it.
	static RareLight Of(double light, double p, int n, bool met)
	{
		const double none = std::pow(1.0 - p, n);
		if(!(none < 1.0))
			return RareLight();
		const double square = light * light, like_it = none / (1.0 - none);
		RareLight r;
		r.missed = square * (met ? like_it : -1.0);
		r.variance = met ? square * square * like_it * (1.0 + like_it) : 0.0;
		return r;
	}
};

/// What one thread counted while tracing; added up over the threads.
struct RenderCounts
{
	uint64_t pixels = 0;
	uint64_t samples = 0;
	uint64_t rays = 0;
	uint64_t early = 0;             ///< pixels that stopped before blur_samples were spent
	RareLight rare;
	unsigned int min_samples = ~0u;
	unsigned int max_samples = 0;
	/// By the number of samples taken: index 2k for 2^k of them, 2k + 1 for more, up to 2^(k+1).
	LevelChanges levels[64];
	unsigned int level_samples[64] = {};

	void AddPixel(unsigned int n, const LevelChanges& changes)
	{
		const int k = 31 - __builtin_clz(n);
		const int index = 2 * k + ((n & (n - 1)) ? 1 : 0);
		levels[index] += changes;
		// The most of them, whichever pixel is traced last.
		if(n > level_samples[index])
			level_samples[index] = n;
		pixels++;
		samples += n;
		if(n < min_samples)
			min_samples = n;
		if(n > max_samples)
			max_samples = n;
	}

	/// The same pixel's rays and light.
	void AddLight(unsigned int traced, const RareLight& light, bool stopped_early)
	{
		rays += traced;
		early += stopped_early ? 1 : 0;
		rare += light;
	}

	/// Whether the error may be larger than RmsError says by more than is promised of it, a quarter,
	/// for light that was missed.
	bool MayMissLight() const;

	RenderCounts& operator+=(const RenderCounts& o);

	/// Whether pixels tell of their error: one sample that was compared with none does not.
	bool ErrorIsKnown() const;

	/// Estimated error of the picture: root of the mean over pixels, red, green and
	/// blue of the squared error, in linear light clipped to 0..1. 0 without pixels.
	double RmsError() const;
};

/// Pixels by where they are in focus. `infinity`: kappa passes through 0 inside the
/// pixel, so that no finite focus distance holds for all of it. `empty`: the pixel
/// looks along or behind the lens plane.
struct FocusCounts
{
	uint64_t front = 0, infinity = 0, behind = 0, empty = 0;

	uint64_t All() const { return front + infinity + behind + empty; }
};

/// Pixel ranges are inclusive, (0, 0) is the top left pixel of width x height.
FocusCounts CountFocus(const TiltLens& lens, const CameraVectors& camera,
                       int width, int height, int left, int top, int right, int bottom);

/// The block of text for the render statistics, in POV-Ray's format, without the
/// rules above and below it. Distances in scene units. `denoised_rms`: the estimated
/// error of the denoised picture, below 0 where it was not denoised.
std::string StatisticsText(const TiltLens& lens, const FocusCounts& focus, const RenderCounts& counts, double denoised_rms = -1.0);

}

#endif
