// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>

#include "lens/denoise.h"
#include "lens/kernels.h"

namespace tilt_lens
{

void NoisyPicture::Resize(int w, int h)
{
	width = w;
	height = h;
	for(auto& plane : mean)
		plane.assign(size_t(w) * h, 0.0f);
	for(auto& plane : first)
		plane.assign(size_t(w) * h, 0.0f);
	share.assign(size_t(w) * h, 1.0f);
}

namespace
{

// Variance of a mean of n samples falls like n^-1.3 for nets in pictures with edges
// (measured: 1.1 to 1.7), so of the variance that the difference of the parts shows
// this much is left in the mean of both,
const float NetGain = 0.683f;           // 1 / (2^1.3 - 1)
// and the parts' errors are this much opposed, in units of the mean's variance.
const float Opposition = 0.462f;        // 2^1.3 - 2
// The least of eighteen estimates is below the truth: by 8 % of the error on average over
// five scenes at 8 to 64 samples (tests/accuracy, estimate).
const double Optimism = 1.08 * 1.08;
// Kernels reach KernelReach pixels, and what they promise is averaged over a few more.
const int Margin = KernelReach + SmoothingReach;
static_assert(Margin == DenoiseReach, "the header promises how far pixels look");

/// Two parts of a band of the picture, with margins, and what is best so far.
struct Band
{
	PixelPlane first[3], later[3], mean[PictureChannels];
	PixelPlane variance;                     // of the mean, own estimate, smoothed
	PixelPlane cost, best[PictureChannels];
	bool used[PictureChannels];         // not 0 everywhere, as transparency mostly is
	PixelPlane rows, smooth, other, bias, noise, weight;   // for TryKernel: fresh memory for every kernel is slow
};

PixelPlane CutPlane(const NoisyPicture& picture, const std::vector<float>& from, int top, int bottom)
{
	PixelPlane p(picture.width + 2 * Margin, bottom - top + 1 + 2 * Margin);
	for(int y = 0; y < p.height; y++)
	{
		const size_t row = size_t(Reflected(top - Margin + y, picture.height)) * picture.width;
		for(int x = 0; x < p.width; x++)
			p.At(x, y) = from[row + Reflected(x - Margin, picture.width)];
	}
	return p;
}

void CutBand(const NoisyPicture& picture, int top, int bottom, Band& band)
{
	const PixelPlane share = CutPlane(picture, picture.share, top, bottom);
	for(int c = 0; c < PictureChannels; c++)
		band.mean[c] = CutPlane(picture, picture.mean[c], top, bottom);
	PixelPlane variance(share.width, share.height);
	for(int c = 0; c < 3; c++)
	{
		band.first[c] = CutPlane(picture, picture.first[c], top, bottom);
		band.later[c] = band.mean[c];
		for(size_t i = 0; i < share.v.size(); i++)
		{
			const float s = share.v[i];
			if(!(s < 1.0f))
				continue;
			band.later[c].v[i] = (band.mean[c].v[i] - s * band.first[c].v[i]) / (1.0f - s);
			const float difference = band.first[c].v[i] - band.later[c].v[i];
			variance.v[i] += difference * difference * s * (1.0f - s) * (NetGain / 3.0f);
		}
	}
	for(PixelPlane *p : { &band.rows, &band.smooth, &band.other, &band.bias, &band.noise, &band.weight, &band.variance })
		*p = PixelPlane(share.width, share.height);
	Smooth(variance, band.rows, band.variance);
	for(float& v : band.variance.v)
		v += 1e-14f;                    // flat parts divide by it
	band.cost = band.variance;
	for(int c = 0; c < PictureChannels; c++)
	{
		band.best[c] = band.mean[c];
		band.used[c] = std::any_of(band.mean[c].v.begin(), band.mean[c].v.end(), [](float v) { return v != 0.0f; });
	}
}

/// Takes the kernel's result where it promises more than what is best so far.
void TryKernel(const Kernel& kernel, Band& band)
{
	const size_t pixels = band.cost.v.size();
	for(size_t i = 0; i < pixels; i++)
		band.other.v[i] = Opposition * band.variance.v[i];
	for(int c = 0; c < 3; c++)
	{
		kernel.Apply(band.first[c], band.rows, band.smooth);
		kernel.Apply(band.later[c], band.rows, band.noise);
		for(size_t i = 0; i < pixels; i++)
			band.other.v[i] += (band.smooth.v[i] - band.later[c].v[i]) * (band.noise.v[i] - band.first[c].v[i]) * (1.0f / 3.0f);
	}
	Smooth(band.other, band.rows, band.bias);
	kernel.ApplySquared(band.variance, band.rows, band.noise);

	bool any = false;
	for(size_t i = 0; i < pixels; i++)
	{
		const float own = band.variance.v[i], neighbours = std::max(band.bias.v[i], 0.0f) + band.noise.v[i];
		const float cost = own * neighbours / (own + neighbours);
		band.weight.v[i] = cost < band.cost.v[i] ? own / (own + neighbours) : 0.0f;
		band.cost.v[i] = std::min(cost, band.cost.v[i]);
		any |= band.weight.v[i] > 0.0f;
	}
	for(int c = 0; any && (c < PictureChannels); c++)
	{
		if(!band.used[c])
			continue;
		kernel.Apply(band.mean[c], band.rows, band.smooth);
		for(size_t i = 0; i < pixels; i++)
		{
			const float changed = band.mean[c].v[i] + band.weight.v[i] * (band.smooth.v[i] - band.mean[c].v[i]);
			band.best[c].v[i] = band.weight.v[i] > 0.0f ? changed : band.best[c].v[i];
		}
	}
}

}

double DenoiseRows(const NoisyPicture& picture, int top, int bottom, std::vector<float> (&denoised)[PictureChannels])
{
	static const std::vector<Kernel> kernels = AllKernels();
	Band band;
	double error = 0.0;

	CutBand(picture, top, bottom, band);
	for(const Kernel& kernel : kernels)
		TryKernel(kernel, band);

	for(int y = top; y <= bottom; y++)
		for(int x = 0; x < picture.width; x++)
		{
			const size_t from = size_t(y - top + Margin) * band.cost.width + x + Margin;
			for(int c = 0; c < PictureChannels; c++)
				denoised[c][size_t(y) * picture.width + x] = band.best[c].v[from];
			error += band.cost.v[from] * Optimism;
		}
	return error;
}

}
