// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a tilt_lens render says about itself afterwards. Free of POV-Ray.

#ifndef TILT_LENS_STATISTICS_H
#define TILT_LENS_STATISTICS_H

#include <cstdint>
#include <string>

#include "lens/convergence.h"
#include "lens/lens_spec.h"

namespace tilt_lens
{

/// How much of the spread of samples rests on one or two bright ones a pixel. Where much of it
/// does, pixels are likely that have the same light and no sample of it.
struct RareLight
{
	double spread = 0.0;            ///< sum of variances of the means, as of independent samples
	double rests_on_few = 0.0;      ///< the part of it

	RareLight& operator+=(const RareLight& o)
	{
		spread += o.spread;
		rests_on_few += o.rests_on_few;
		return *this;
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

	/// Whether the error is likely larger than RmsError says: pixels that stopped early, in a
	/// picture whose spread rests on few samples, may have missed the light that others caught.
	bool MayMissLight() const { return (early > 0) && (rare.rests_on_few > RareShare * rare.spread); }
	/// Scenes without such lights have up to 0.2 where pixels stop at 4 samples, and 0.05 at 16;
	/// those with them 0.5 to 1 (tests/render/statistics.sh, bound).
	static constexpr double RareShare = 0.25;

	RenderCounts& operator+=(const RenderCounts& o);

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
