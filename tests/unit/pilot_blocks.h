// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pilots whose answers are known without tiltcost.

#ifndef TILT_LENS_TESTS_PILOT_BLOCKS_H
#define TILT_LENS_TESTS_PILOT_BLOCKS_H

#include "prediction.h"

#include "lens/pilot.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

const int Side = tilt_lens::PilotBlockSize;

/// A block's text as the renderer writes it; `level(pixel, k)` is the pixel at 2^k samples.
inline std::string BlockText(int left, double seconds, int samples, const std::function<tilt_lens::PilotLevel(int pixel, int k)>& level)
{
	std::vector<std::vector<tilt_lens::PilotLevel>> pixels(Side * Side);
	for (int i = 0; i < Side * Side; ++i)
		for (int k = 0; (1 << k) <= samples; ++k)
		{
			pixels[size_t(i)].push_back(level(i, k));
			pixels[size_t(i)].back().samples = 1 << k;
		}
	return tilt_lens::PilotText(left, 0, Side, Side, seconds, seconds / samples, {0, 16, 0.0001, 0.9, false}, pixels);
}

inline tilt_lens::PilotLevel Grey(double mean, double variance) { return {1, {mean, mean, mean}, variance}; }

inline std::string Flat(int left, double seconds, int samples, double mean, double variance)
{
	return BlockText(left, seconds, samples, [=](int, int) { return Grey(mean, variance); });
}

/// Number among the 16 pixels by which pixels inside a block are told apart, whose neighbours all lie in it too.
inline int InsideNumber(int pixel)
{
	return (pixel % Side - 2 + 4) % 4 + 4 * ((pixel / Side - 2 + 4) % 4);
}

inline int Parity(int bits)
{
	int parity = 0;
	for (; bits; bits &= bits - 1)
		parity ^= 1;
	return parity;
}

/// Means whose squared changes are v(n/2) - v(n) for v(n) = size n^-exponent in every pixel, with signs
/// (Walsh functions) that are orthogonal over the inside: averaged there, (m(n) - m(N))^2 is v(n) - v(N) exactly.
inline std::string PowerLaw(int left, int samples, double mean, double size, double exponent)
{
	return BlockText(left, 1, samples, [=](int pixel, int k)
	{
		double m = mean;
		for (int j = 1; j <= k; ++j)
		{
			const double change = std::sqrt(size * (std::pow(2.0, -exponent * (j - 1)) - std::pow(2.0, -exponent * j)));
			m += Parity(InsideNumber(pixel) & j) ? change : -change;
		}
		return Grey(m, 0.01);
	});
}

inline tiltcost::Setting Fixed(int samples) { return {0, samples, 0, 0.9}; }

#endif
