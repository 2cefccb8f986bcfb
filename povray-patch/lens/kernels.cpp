// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "lens/angles.h"
#include "lens/kernels.h"

namespace tilt_lens
{

int Reflected(int i, int n)
{
	if(n == 1)
		return 0;
	const int period = 2 * (n - 1);
	i = std::abs(i) % period;
	return i < n ? i : period - i;
}

namespace
{

// GCC's and clang's vectors: plain loops over an array of sums are not kept in registers.
typedef float Lanes __attribute__((vector_size(32), aligned(4), may_alias));
const int LaneCount = sizeof(Lanes) / sizeof(float), LanesAtATime = 4 * LaneCount;

/// target[x] = sum of taps, 0 <= x < count; a tap's source is source + offset.
TILT_LENS_VECTORS
void SumTaps(const float *source, const std::ptrdiff_t *offset, const float *weight, size_t taps, float *target, int count)
{
	int x = 0;
	for(; x + LanesAtATime <= count; x += LanesAtATime)
	{
		Lanes a = {}, b = {}, c = {}, d = {};
		for(size_t t = 0; t < taps; t++)
		{
			const Lanes *from = reinterpret_cast<const Lanes *>(source + offset[t] + x);
			a += weight[t] * from[0];
			b += weight[t] * from[1];
			c += weight[t] * from[2];
			d += weight[t] * from[3];
		}
		Lanes *to = reinterpret_cast<Lanes *>(target + x);
		to[0] = a;
		to[1] = b;
		to[2] = c;
		to[3] = d;
	}
	for(; x + LaneCount <= count; x += LaneCount)
	{
		Lanes a = {};
		for(size_t t = 0; t < taps; t++)
			a += weight[t] * *reinterpret_cast<const Lanes *>(source + offset[t] + x);
		*reinterpret_cast<Lanes *>(target + x) = a;
	}
	for(; x < count; x++)
	{
		float sum = 0.0f;
		for(size_t t = 0; t < taps; t++)
			sum += weight[t] * source[offset[t] + x];
		target[x] = sum;
	}
}

TILT_LENS_VECTORS
void TakeOutCentre(const float *__restrict plane, float out, float scale, float *__restrict result, size_t count)
{
	for(size_t i = 0; i < count; i++)
		result[i] = (result[i] - out * plane[i]) * scale;
}

// In vectors too: a loop that might not need what it computes is left as it is by GCC.
TILT_LENS_VECTORS
void BlendRow(const float *plane, const float *smooth, const float *weight, const float *credit, const float *keep, float *sum, size_t count)
{
	size_t i = 0;
	for(; i + LaneCount <= count; i += LaneCount)
	{
		const Lanes p = *reinterpret_cast<const Lanes *>(plane + i), s = *reinterpret_cast<const Lanes *>(smooth + i);
		const Lanes w = *reinterpret_cast<const Lanes *>(weight + i), c = *reinterpret_cast<const Lanes *>(credit + i);
		const Lanes k = *reinterpret_cast<const Lanes *>(keep + i);
		Lanes& to = *reinterpret_cast<Lanes *>(sum + i);
		to = c > 0.0f ? k * to + c * (p + w * (s - p)) : to;
	}
	for(; i < count; i++)
		if(credit[i] > 0.0f)
			sum[i] = keep[i] * sum[i] + credit[i] * (plane[i] + weight[i] * (smooth[i] - plane[i]));
}

/// The sum of taps at every pixel, except so many columns and rows along the edges.
void Convolve(const PixelPlane& from, const std::vector<Tap>& taps, PixelPlane& to, int columns, int rows)
{
	std::vector<std::ptrdiff_t> offsets;
	std::vector<float> weights;
	for(const Tap& tap : taps)
	{
		offsets.push_back(std::ptrdiff_t(tap.dy) * from.width + tap.dx);
		weights.push_back(tap.weight);
	}
	for(int y = rows; y < from.height - rows; y++)
	{
		const size_t at = size_t(y) * from.width + columns;
		SumTaps(&from.v[at], offsets.data(), weights.data(), taps.size(), &to.v[at], from.width - 2 * columns);
	}
}

std::vector<float> HalfGaussian(double sigma, int reach)
{
	std::vector<float> half;
	double sum = 0.0;
	for(int i = 0; i <= reach; i++)
	{
		half.push_back(float(std::exp(-0.5 * i * i / (sigma * sigma))));
		sum += half.back() * (i > 0 ? 2.0 : 1.0);
	}
	for(float& w : half)
		w = float(w / sum);
	return half;
}

/// Separable convolution with weights half[|i|], columns after rows; not on `edge` >= the
/// kernel's reach pixels along the edges.
void Separable(const PixelPlane& p, const std::vector<float>& half, int edge, PixelPlane& rows, PixelPlane& result)
{
	std::vector<Tap> across, down;
	for(int i = 1 - int(half.size()); i < int(half.size()); i++)
	{
		across.push_back({ i, 0, half[std::abs(i)] });
		down.push_back({ 0, i, half[std::abs(i)] });
	}
	Convolve(p, across, rows, edge, 0);
	Convolve(rows, down, result, edge, edge);
}

}

Kernel::Kernel(double along, double across, double angle)
{
	const int reach = std::min(KernelReach, int(std::ceil(2.5 * std::max(along, across))));
	if(along == across)
	{
		half = HalfGaussian(along, reach);
		return;
	}
	double sum = 0.0;
	for(int y = -reach; y <= reach; y++)
		for(int x = -reach; x <= reach; x++)
		{
			const double u = (x * std::cos(angle) + y * std::sin(angle)) / along;
			const double v = (y * std::cos(angle) - x * std::sin(angle)) / across;
			const double w = std::exp(-0.5 * (u * u + v * v));
			if(((x == 0) && (y == 0)) || (w < 2e-3))
				continue;
			taps.push_back({ x, y, float(w) });
			sum += w;
		}
	for(Tap& tap : taps)
	{
		tap.weight = float(tap.weight / sum);
		squares.push_back({ tap.dx, tap.dy, tap.weight * tap.weight });
	}
}

void Kernel::Apply(const PixelPlane& p, bool squared, PixelPlane& rows, PixelPlane& result) const
{
	if(half.empty())
	{
		Convolve(p, squared ? squares : taps, result, KernelReach, KernelReach);
		return;
	}

	// The centre is taken out of the separable kernel afterwards.
	const float centre = half[0] * half[0], rest = 1.0f - centre;
	std::vector<float> weights = half;
	if(squared)
		for(float& w : weights)
			w *= w;
	const float out = squared ? centre * centre : centre, scale = squared ? 1.0f / (rest * rest) : 1.0f / rest;
	Separable(p, weights, KernelReach, rows, result);
	TakeOutCentre(p.v.data(), out, scale, result.v.data(), result.v.size());
}

std::vector<Kernel> AllKernels()
{
	const double pi_4 = 0.25 * Pi;
	std::vector<Kernel> kernels;
	for(double sigma : { 0.5, 0.8, 1.2, 1.8, 2.7, 4.0 })
		kernels.push_back(Kernel(sigma, sigma, 0.0));
	for(double along : { 1.0, 2.0, 4.0 })
		for(int direction = 0; direction < 4; direction++)
			kernels.push_back(Kernel(along, 0.35, direction * pi_4));
	return kernels;
}

void Smooth(const PixelPlane& p, PixelPlane& rows, PixelPlane& result)
{
	static const std::vector<float> half = HalfGaussian(2.0, SmoothingReach);
	Separable(p, half, SmoothingReach, rows, result);
}

void Blend(const PixelPlane& plane, const PixelPlane& smooth, const PixelPlane& weight, const PixelPlane& credit, const PixelPlane& keep, PixelPlane& sum)
{
	BlendRow(plane.v.data(), smooth.v.data(), weight.v.data(), credit.v.data(), keep.v.data(), sum.v.data(), plane.v.size());
}

}
