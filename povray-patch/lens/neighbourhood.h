// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What pixels know of those around them, for a whole rectangle of pixels at once: where most take but a sample or two, asking every
// neighbour for every pixel would cost a good part of a ray. Free of POV-Ray, as adaptive.h is.

#ifndef TILT_LENS_NEIGHBOURHOOD_H
#define TILT_LENS_NEIGHBOURHOOD_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "lens/adaptive.h"

namespace tilt_lens
{

/// How many of `size` places in a row are no farther than `reach` from place i.
inline int Within(int i, int size, int reach) { return std::min(i, reach) + 1 + std::min(size - 1 - i, reach); }

/// Compares the means of the first `samples` of each pixel with those of the eight around it. `means` are `channels` (three or more,
/// red, green and blue first) a pixel, row by row; pixels beyond the rectangle do not count, so that it must reach a pixel farther than
/// what is asked for, where the picture does.
inline std::vector<Between> BetweenNeighbours(const std::vector<float>& means, int columns, int rows, int channels, int samples)
{
	const size_t row = size_t(columns) * channels;
	std::vector<float> most(means.size(), 0.0f), sum(means.size(), 0.0f), square(row);
	std::vector<Between> between(size_t(columns) * rows);

	// Each pair once, and rows of pairs, which compilers turn into vectors.
	const auto note = [&](size_t pixel, size_t count)
	{
		float *const m = most.data() + pixel, *const s = sum.data() + pixel;
		for(size_t i = 0; i < count; i++)
		{
			m[i] = std::max(m[i], square[i]);
			s[i] += square[i];
		}
	};
	const auto compare = [&](size_t one, size_t other, size_t count)
	{
		for(size_t i = 0; i < count; i++)
			square[i] = (means[one + i] - means[other + i]) * (means[one + i] - means[other + i]);
		note(one, count);
		note(other, count);
	};
	for(int y = 0; y < rows; y++)
	{
		const size_t here = y * row, below = here + row;
		compare(here, here + channels, row - channels);
		if(y + 1 == rows)
			break;
		compare(here, below, row);
		compare(here, below + channels, row - channels);
		compare(here + channels, below, row - channels);
	}

	// Half the square of a difference of means, as the variance of a sample.
	const double half = 0.5 * samples;
	for(int y = 0; y < rows; y++)
		for(int x = 0; x < columns; x++)
		{
			const size_t pixel = size_t(y) * columns + x;
			const float *const m = &most[pixel * channels], *const s = &sum[pixel * channels];
			between[pixel].most = half * *std::max_element(m, m + channels);
			between[pixel].mean = half * (double(s[0]) + s[1] + s[2]) / (3.0 * std::max(Within(x, columns, 1) * Within(y, rows, 1) - 1, 1));
			between[pixel].known = columns * rows > 1;
		}
	return between;
}

/// `combine` over the (2 reach + 1)^2 places around each of a rectangle, as far as they lie in it: along rows, then across.
template<class T, class Combine>
std::vector<T> OverSquares(const std::vector<T>& of, int columns, int rows, int reach, Combine combine)
{
	std::vector<T> along = of;
	for(int y = 0; y < rows; y++)
	{
		const T *const in = &of[size_t(y) * columns];
		T *const out = &along[size_t(y) * columns];
		for(int far = 1; far <= reach; far++)
		{
			for(int x = far; x < columns; x++)
				out[x] = combine(out[x], in[x - far]);
			for(int x = 0; x + far < columns; x++)
				out[x] = combine(out[x], in[x + far]);
		}
	}

	std::vector<T> all = along;
	const auto add = [&](int to, int from)
	{
		T *const out = &all[size_t(to) * columns];
		const T *const in = &along[size_t(from) * columns];
		for(int x = 0; x < columns; x++)
			out[x] = combine(out[x], in[x]);
	};
	for(int y = 0; y < rows; y++)
		for(int far = 1; far <= reach; far++)
		{
			if(y >= far)
				add(y, y - far);
			if(y + far < rows)
				add(y, y + far);
		}
	return all;
}

/// Pixels this far away count in a pixel's decision.
const int NeighbourReach = 2;

/// What pixels and those around found by themselves, for each of a rectangle, row by row. Pixels beyond the rectangle do not count, so
/// that it must reach NeighbourReach farther than what is asked for, where the picture does.
struct Neighbourhoods
{
	/// Variance per sample that the statistics assume of a pixel. A few samples can miss what covers a few percent of the lens
	/// and then find nothing to be uncertain about; of 25 pixels hardly all miss it. Near neighbours count most.
	std::vector<double> variance;
	/// The most uncertain of the nine pixels within 1, and of the 25 within NeighbourReach.
	std::vector<Uncertainty> near, far;

	Neighbourhoods(const std::vector<Uncertainty>& of, int columns, int rows)
	{
		const auto most = [](Uncertainty a, Uncertainty b) { return std::max(a, b); };
		near = OverSquares(of, columns, rows, 1, most);
		far = OverSquares(of, columns, rows, NeighbourReach, most);

		std::vector<double> own(of.size());
		std::transform(of.begin(), of.end(), own.begin(), FromUncertainty);
		variance = OverSquares(own, columns, rows, 1, std::plus<double>());
		const std::vector<double> wide = OverSquares(own, columns, rows, NeighbourReach, std::plus<double>());
		for(int y = 0; y < rows; y++)
			for(int x = 0; x < columns; x++)
			{
				double& v = variance[size_t(y) * columns + x];
				v = 0.5 * (v / (Within(x, columns, 1) * Within(y, rows, 1)) +
				           wide[size_t(y) * columns + x] / (Within(x, columns, NeighbourReach) * Within(y, rows, NeighbourReach)));
			}
	}
};

}

#endif
