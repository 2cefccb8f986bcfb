// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which point of an area light a camera ray asks: one for every lens sample, by two more
// dimensions of the pixel's sequence, instead of POV-Ray's whole grid. Free of POV-Ray.
//
// POV-Ray halves its grid until squares of four neighbours are left and averages those, a
// quarter each at every step. So its points do not weigh the same where halves share a row:
// three in a row weigh 1/4, 1/2, 1/4. Halving by the binary digits of a uniform number
// draws them with these weights, and stratified digits give stratified points.

#ifndef TILT_LENS_LIGHT_SAMPLES_H
#define TILT_LENS_LIGHT_SAMPLES_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lens/sampler.h"

namespace tilt_lens
{

/// A point in (0, 1) x (0, 1).
struct LightPoint
{
	double u, v;
};

/// A point of a row of the grid.
struct LightCell
{
	int index;      ///< 0 .. count - 1
	double place;   ///< the digits that were not needed: uniform in (0, 1), for jitter
};

/// The point that x in (0, 1) draws from a row of `count` >= 1.
inline LightCell CellOfLight(double x, int count)
{
	int low = 0, high = count - 1;
	while(low < high)
	{
		const bool upper = x >= 0.5;
		const int sum = low + high;
		x = upper ? 2.0 * x - 1.0 : 2.0 * x;
		if(high - low == 1)
			low = high = upper ? high : low;
		else if(upper)
			low = (sum + 1) / 2;
		else
			high = sum / 2;
	}
	return { low, x };
}

/// The points that one camera ray and all rays that follow from it ask.
class LightSamples
{
	public:
		LightSamples() : sample() {}

		/// For a lens sample.
		void Draw(const LightDimensions& of_sample)
		{
			sample = of_sample;
			Begin();
		}

		/// Once more from the start.
		void Begin() { std::fill(asked.begin(), asked.end(), 0u); }

		/// The next point of the light of that index: at the camera ray's own hit, or at a
		/// reflection's. Each has a scrambling of its own, the same for all samples of the pixel.
		LightPoint Next(size_t light)
		{
			if(light >= asked.size())
				asked.resize(light + 1, 0u);
			const uint64_t seed = sobol::Mix(sample.seed ^ ((uint64_t(light) << 32) | asked[light]++));
			LightPoint p;
			sobol::ScrambledPair(sample.point[0], uint32_t(seed), sample.point[1], uint32_t(seed >> 32), p.u, p.v);
			return p;
		}
	private:
		LightDimensions sample;
		std::vector<uint32_t> asked;    // of each light, how often
};

}

#endif
