// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The samples of one pixel: an Owen-scrambled Sobol sequence in six dimensions,
// lens u, lens v, pixel x, pixel y, and two for area lights (light_samples.h). Seeded by the pixel's coordinates and the scene's
// `seed` alone, so that the picture does not depend on threads, tiles or strips.
//
// Sources: direction numbers from Joe and Kuo, "Constructing Sobol sequences with
// better two-dimensional projections" (2008); scrambling by hashing from Burley,
// "Practical Hash-based Owen Scrambling" (JCGT 2020), with the hash constants of
// Vegdahl's refinement of the Laine-Karras permutation.

#ifndef TILT_LENS_SAMPLER_H
#define TILT_LENS_SAMPLER_H

#include <cstdint>

namespace tilt_lens
{

/// The dimensions of area lights, before they are scrambled: every light scrambles them its own way.
struct LightDimensions
{
	uint32_t point[2];
	uint64_t seed;
};

/// One sample; every component lies in (0, 1).
struct LensSample
{
	double pixel_x, pixel_y, lens_u, lens_v;
};

namespace sobol
{

const int Dimensions = 6;
const int OwnDimensions = 4;   ///< of lens and pixel; those of lights are worked out where there are such lights
const int Bits = 32;

/// Direction numbers, bit-reversed: bit k of a point is its (k+1)th binary digit,
/// which is the order in which the scrambling hash carries.
struct Directions
{
	uint32_t v[Bits][OwnDimensions], light[Bits][Dimensions - OwnDimensions];
	Directions();
};

inline uint32_t ReverseBits(uint32_t x)
{
	x = __builtin_bswap32(x);
	x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
	x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
	return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

inline uint64_t ReverseBits(uint64_t x)
{
	x = __builtin_bswap64(x);
	x = ((x & 0x0f0f0f0f0f0f0f0full) << 4) | ((x >> 4) & 0x0f0f0f0f0f0f0f0full);
	x = ((x & 0x3333333333333333ull) << 2) | ((x >> 2) & 0x3333333333333333ull);
	return ((x & 0x5555555555555555ull) << 1) | ((x >> 1) & 0x5555555555555555ull);
}

inline Directions::Directions()
{
	// Joe and Kuo's new-joe-kuo-6, dimensions 2 to 6: degree s, coefficients a,
	// initial m. Dimension 1 is the van der Corput sequence.
	static const struct { int s; uint32_t a; uint32_t m[4]; } polynomial[Dimensions] =
	{
		{ 0, 0, { 0, 0, 0, 0 } }, { 1, 0, { 1, 0, 0, 0 } }, { 2, 1, { 1, 3, 0, 0 } }, { 3, 1, { 1, 3, 1, 0 } },
		{ 3, 2, { 1, 1, 1, 0 } }, { 4, 1, { 1, 1, 3, 3 } }
	};

	for(int d = 0; d < Dimensions; d++)
	{
		uint32_t w[Bits];
		const int s = polynomial[d].s;

		for(int i = 0; i < Bits; i++)
		{
			if(s == 0)
				w[i] = 1u << (31 - i);
			else if(i < s)
				w[i] = polynomial[d].m[i] << (31 - i);
			else
			{
				w[i] = w[i - s] ^ (w[i - s] >> s);
				for(int k = 1; k < s; k++)
					if((polynomial[d].a >> (s - 1 - k)) & 1u)
						w[i] ^= w[i - k];
			}
		}
		for(int i = 0; i < Bits; i++)
			(d < OwnDimensions ? v[i][d] : light[i][d - OwnDimensions]) = ReverseBits(w[i]);
	}
}

inline const Directions& DirectionTable()
{
	static const Directions table;
	return table;
}

/// Nested uniform (Owen) scrambling of a bit-reversed point, as a hash in which
/// every bit depends only on the bits below it.
inline uint32_t ScrambleReversed(uint32_t x, uint32_t seed)
{
	x ^= x * 0x3d20adeau;
	x += seed;
	x *= (seed >> 16) | 1u;
	x ^= x * 0x05526c56u;
	x ^= x * 0x53a22864u;
	return x;
}

/// Two dimensions of a point as numbers in (0, 1); two at a time, because one word holds both
/// to be reversed.
inline void ScrambledPair(uint32_t first_point, uint32_t first_seed, uint32_t second_point, uint32_t second_seed, double& first, double& second)
{
	const uint64_t pair = (uint64_t(ScrambleReversed(first_point, first_seed)) << 32) | ScrambleReversed(second_point, second_seed);
	const uint64_t bits = ReverseBits(pair);
	first = (double(uint32_t(bits)) + 0.5) * (1.0 / 4294967296.0);
	second = (double(uint32_t(bits >> 32)) + 0.5) * (1.0 / 4294967296.0);
}

/// A well-mixed 64-bit hash (the finaliser of splitmix64).
inline uint64_t Mix(uint64_t z)
{
	z += 0x9e3779b97f4a7c15ull;
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
	return z ^ (z >> 31);
}

}

/// Which random numbers other than its samples a pixel begins with, when it has `count` of them.
inline uint32_t RandomSeedOfPixel(int x, int y, uint32_t scene_seed, int count)
{
	return uint32_t(sobol::Mix(sobol::Mix((uint64_t(uint32_t(y)) << 32) | uint32_t(x)) ^ ((uint64_t(scene_seed) << 32) | uint32_t(count))));
}

/// The sequence of one pixel. Any 2^k samples from the start are a scrambled
/// digital net; Next() walks in Gray-code order, which permutes samples only
/// within such blocks.
class PixelSampler
{
	public:
		/// x, y: the pixel's coordinates; equal coordinates and seeds give equal samples.
		PixelSampler(uint32_t x, uint32_t y, uint32_t scene_seed = 0) :
			table(&sobol::DirectionTable()), index(0)
		{
			const uint64_t a = sobol::Mix(((uint64_t(y) << 32) | x) ^ (scene_seed ? sobol::Mix(scene_seed) : 0));
			const uint64_t b = sobol::Mix(a);
			seed[0] = uint32_t(a); seed[1] = uint32_t(a >> 32);
			seed[2] = uint32_t(b); seed[3] = uint32_t(b >> 32);
			for(int d = 0; d < sobol::OwnDimensions; d++)
				point[d] = 0;
		}

		/// The next sample; up to 2^32 - 1 of them.
		LensSample Next()
		{
			// The lens gets the first two dimensions, the best of the sequence:
			// blur needs many samples where the pixel's area needs few.
			LensSample s;
			Values(0, s.lens_u, s.lens_v);
			Values(2, s.pixel_x, s.pixel_y);
			const int bit = __builtin_ctz(++index);
			for(int d = 0; d < sobol::OwnDimensions; d++)
				point[d] ^= table->v[bit][d];
			return s;
		}

		/// Of the sample that Next() gave last.
		LightDimensions Light() const
		{
			LightDimensions light = { { 0, 0 }, sobol::Mix((uint64_t(seed[3]) << 32) | seed[2]) };
			const uint32_t last = index - 1;
			for(uint32_t gray = last ^ (last >> 1); gray != 0; gray &= gray - 1)
				for(int d = 0; d < 2; d++)
					light.point[d] ^= table->light[__builtin_ctz(gray)][d];
			return light;
		}

	private:
		void Values(int d, double& first, double& second) const
		{
			sobol::ScrambledPair(point[d], seed[d], point[d + 1], seed[d + 1], first, second);
		}

		const sobol::Directions *table;
		uint32_t index;
		uint32_t seed[sobol::OwnDimensions];
		uint32_t point[sobol::OwnDimensions];
};

}

#endif
