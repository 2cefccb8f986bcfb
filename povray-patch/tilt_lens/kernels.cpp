// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernels.h"

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

/// to += weight * from, moved by (dx, dy), except on so many columns and rows along the
/// edges; what comes from beyond the plane is left out.
void AddMoved(const Plane& from, int dx, int dy, float weight, Plane& to, int columns, int rows)
{
	const int left = std::max(columns, -dx), right = from.width - std::max(columns, dx);
	for(int y = std::max(rows, -dy); y < from.height - std::max(rows, dy); y++)
	{
		const float *source = &from.v[size_t(y + dy) * from.width + dx];
		float *target = &to.v[size_t(y) * to.width];
		for(int x = left; x < right; x++)
			target[x] += weight * source[x];
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

/// Separable convolution with weights half[|i|], columns after rows; not on `edge` pixels
/// along the edges.
Plane Separable(const Plane& p, const std::vector<float>& half, int edge)
{
	Plane rows(p.width, p.height), both(p.width, p.height);
	for(int i = 1 - int(half.size()); i < int(half.size()); i++)
		AddMoved(p, i, 0, half[std::abs(i)], rows, edge, 0);
	for(int i = 1 - int(half.size()); i < int(half.size()); i++)
		AddMoved(rows, 0, i, half[std::abs(i)], both, edge, edge);
	return both;
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
		tap.weight = float(tap.weight / sum);
}

Plane Kernel::Apply(const Plane& p, bool squared) const
{
	Plane result(p.width, p.height);
	for(const Tap& tap : taps)
		AddMoved(p, tap.dx, tap.dy, squared ? tap.weight * tap.weight : tap.weight, result, KernelReach, KernelReach);
	if(half.empty())
		return result;

	// The centre is taken out of the separable kernel afterwards.
	const float centre = half[0] * half[0], rest = 1.0f - centre;
	std::vector<float> weights = half;
	if(squared)
		for(float& w : weights)
			w *= w;
	const float out = squared ? centre * centre : centre, scale = squared ? 1.0f / (rest * rest) : 1.0f / rest;
	result = Separable(p, weights, KernelReach);
	for(size_t i = 0; i < result.v.size(); i++)
		result.v[i] = (result.v[i] - out * p.v[i]) * scale;
	return result;
}

std::vector<Kernel> AllKernels()
{
	const double pi_4 = 0.78539816339744830962;
	std::vector<Kernel> kernels;
	for(double sigma : { 0.5, 0.8, 1.2, 1.8, 2.7, 4.0 })
		kernels.push_back(Kernel(sigma, sigma, 0.0));
	for(double along : { 1.0, 2.0, 4.0 })
		for(int direction = 0; direction < 4; direction++)
			kernels.push_back(Kernel(along, 0.35, direction * pi_4));
	return kernels;
}

Plane Smoothed(const Plane& p)
{
	static const std::vector<float> half = HalfGaussian(2.0, 6);
	return Separable(p, half, 0);
}

}
