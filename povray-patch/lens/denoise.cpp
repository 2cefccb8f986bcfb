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
	count.assign(size_t(w) * h, 1.0f);
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
// What is brighter than a picture shows is not seen. A half of the samples that met a rare light is brighter
// than all of them, so kernels are chosen by halves up to here,
const float ChoiceRange = 1.5f;
// and blocks are judged by predicting halves up to twice what is shown: one sample of a half counts as two of all.
const float JudgedRange = 2.0f;
// A mean of all samples has 1 / 2^1.3 = 0.41 of a half's variance. What is to replace it must predict the other half as well as
// a half without noise but that would; a little more, because two predictions are but samples.
const float AllowedError = 0.5f;
// Results by fewer samples than this are averaged by the squares of what they promise. On six scenes that takes 8 % off the error at 4 samples and 5 %
// at 8; from 16 samples on choosing is better. The first power is better still on them, but makes flat parts a fifth worse.
const float FewSamples = 16.0f;
// Bounds for sums to stay finite.
const float MostPromised = 1e6f, MostLight = 1e30f;
// Kernels reach KernelReach pixels, and what they promise is averaged over a few more.
const int Margin = KernelReach + SmoothingReach;
static_assert(Margin + JudgedBlock - 1 <= DenoiseReach, "the header promises how far pixels look");

inline float UpTo(float range, float x) { return std::min(range, std::max(0.0f, x)); }

/// Two parts of a band of the picture, with margins, and what is best so far.
struct Band
{
	PixelPlane first[PictureChannels], later[PictureChannels], mean[PictureChannels], share;
	PixelPlane seen_first[PictureChannels], seen_later[PictureChannels];    // up to ChoiceRange
	PixelPlane variance;                // of the mean as chosen by, own estimate, smoothed
	PixelPlane light;                   // of that, red's, green's and blue's; empty where there is nothing else
	PixelPlane linear;                  // the same of all its light: what of it neighbours get
	PixelPlane cost, least;             // of what is best so far, summed by credit; of the best kernel alone
	PixelPlane best[PictureChannels], best_first[PictureChannels], best_later[PictureChannels];     // the same of results; best is made of the parts
	PixelPlane total;                   // credit
	PixelPlane few;                     // 1 in pixels that average, 0 in those that take the best kernel alone
	std::vector<int> channels;          // red, green and blue, and those of transparency, which mostly is 0 everywhere, where it is not
	PixelPlane rows, smooth_first[PictureChannels], smooth_later[PictureChannels], other, bias, noise, weight, credit, keep;   // for TryKernel: fresh memory for every kernel is slow
};

PixelPlane CutPlane(const NoisyPicture& picture, const std::vector<float>& from, int top, int bottom)
{
	PixelPlane p(picture.width + 2 * Margin, bottom - top + 1 + 2 * Margin);
	for(int y = 0; y < p.height; y++)
	{
		const size_t row = size_t(Reflected(top - Margin + y, picture.height)) * picture.width;
		std::copy_n(&from[row], picture.width, &p.At(Margin, y));
		for(int x = 1; x <= Margin; x++)
		{
			p.At(Margin - x, y) = from[row + Reflected(-x, picture.width)];
			p.At(p.width - 1 - Margin + x, y) = from[row + Reflected(picture.width - 1 + x, picture.width)];
		}
	}
	return p;
}

/// Of the first part in `count` samples; 1 of a single one.
float ShareOfFirst(float count)
{
	float part = 1.0f;
	while(2.0f * part < count)
		part *= 2.0f;
	return part / count;
}

/// What follows from the numbers of samples.
void Count(const PixelPlane& count, Band& band)
{
	band.share = band.few = PixelPlane(count.width, count.height);
	for(size_t i = 0; i < count.v.size(); i++)
	{
		band.share.v[i] = ShareOfFirst(count.v[i]);
		band.few.v[i] = count.v[i] < FewSamples ? 1.0f : 0.0f;
	}
}

void CutBand(const NoisyPicture& picture, int top, int bottom, Band& band)
{
	Count(CutPlane(picture, picture.count, top, bottom), band);
	const PixelPlane& share = band.share;
	band.channels.clear();
	for(int c = 0; c < PictureChannels; c++)
	{
		band.best[c] = band.mean[c] = CutPlane(picture, picture.mean[c], top, bottom);
		if((c < 3) || std::any_of(band.mean[c].v.begin(), band.mean[c].v.end(), [](float v) { return v != 0.0f; }))
			band.channels.push_back(c);
	}
	const bool transparent = band.channels.size() > 3;
	PixelPlane variance(share.width, share.height), light, linear(share.width, share.height);
	for(const int c : band.channels)
	{
		band.first[c] = CutPlane(picture, picture.first[c], top, bottom);
		band.later[c] = band.mean[c];
		band.seen_first[c] = band.seen_later[c] = PixelPlane(share.width, share.height);
		for(size_t i = 0; i < share.v.size(); i++)
		{
			const float s = share.v[i];
			band.seen_first[c].v[i] = band.seen_later[c].v[i] = UpTo(ChoiceRange, band.first[c].v[i]);
			if(!(s < 1.0f))
				continue;
			band.later[c].v[i] = (band.mean[c].v[i] - s * band.first[c].v[i]) / (1.0f - s);
			band.seen_later[c].v[i] = UpTo(ChoiceRange, band.later[c].v[i]);
			const float whole = band.first[c].v[i] - band.later[c].v[i];
			const float difference = band.seen_first[c].v[i] - band.seen_later[c].v[i];
			const float part = s * (1.0f - s) * (NetGain / 3.0f);
			linear.v[i] += whole * whole * part;
			variance.v[i] += difference * difference * part;
		}
		if(transparent && (c == 2))
			light = variance;
	}
	for(PixelPlane *p : { &band.rows, &band.other, &band.bias, &band.noise, &band.weight, &band.credit, &band.keep, &band.variance, &band.linear })
		*p = PixelPlane(share.width, share.height);
	for(const int c : band.channels)
		band.smooth_first[c] = band.smooth_later[c] = band.other;
	Smooth(variance, band.rows, band.variance);
	Smooth(linear, band.rows, band.linear);
	band.light = light;
	if(transparent)
		Smooth(light, band.rows, band.light);
	for(PixelPlane *p : { &band.variance, &band.light })
		for(float& v : p->v)
			v += 1e-14f;                // flat parts divide by it
	for(float& v : band.linear.v)
		v += 1e-14f;
	band.cost = band.least = band.variance;
	band.total = PixelPlane(share.width, share.height);
	std::fill(band.total.v.begin(), band.total.v.end(), 1.0f);      // of the pixels as they are
	for(const int c : band.channels)
	{
		band.best_first[c] = band.first[c];
		band.best_later[c] = band.later[c];
	}
}

/// Adds to `sum` a third of (smoothed first - later) (smoothed later - first).
TILT_LENS_VECTORS
void AddProducts(const float *__restrict smooth_first, const float *__restrict smooth_later, const float *__restrict seen_first,
                 const float *__restrict seen_later, float *__restrict sum, size_t count)
{
	for(size_t i = 0; i < count; i++)
		sum[i] += (UpTo(ChoiceRange, smooth_first[i]) - seen_later[i]) * (UpTo(ChoiceRange, smooth_later[i]) - seen_first[i]) * (1.0f / 3.0f);
}

/// What a kernel's result counts, and how much of what was best before is kept.
struct Credit
{
	const float *variance, *bias, *noise, *few;
	float *weight, *credit, *keep, *least, *total, *cost;
};

TILT_LENS_VECTORS
void GiveCredit(const Credit& of, size_t count)
{
	const float *__restrict variance = of.variance, *__restrict bias = of.bias, *__restrict noise = of.noise;
	const float *__restrict few = of.few;
	float *__restrict weight = of.weight, *__restrict credit = of.credit, *__restrict keep = of.keep;
	float *__restrict least = of.least, *__restrict total = of.total, *__restrict sum = of.cost;
	for(size_t i = 0; i < count; i++)
	{
		const float own = variance[i], neighbours = std::max(bias[i], 0.0f) + noise[i];
		const float part = own / (own + neighbours), cost = part * neighbours;
		const float promise = std::min(own / cost, MostPromised), better = cost < least[i] ? 1.0f - few[i] : 0.0f;
		weight[i] = part;
		credit[i] = better + few[i] * promise * promise;
		keep[i] = 1.0f - better;
		least[i] = std::min(cost, least[i]);
		total[i] = keep[i] * total[i] + credit[i];
		sum[i] = keep[i] * sum[i] + credit[i] * cost;
	}
}

/// Takes the kernel's result where it promises more than what is best so far.
void TryKernel(const Kernel& kernel, Band& band)
{
	const size_t pixels = band.cost.v.size();
	for(size_t i = 0; i < pixels; i++)
		band.other.v[i] = Opposition * band.variance.v[i];
	for(const int c : band.channels)
	{
		kernel.Apply(band.first[c], band.rows, band.smooth_first[c]);
		kernel.Apply(band.later[c], band.rows, band.smooth_later[c]);
		AddProducts(band.smooth_first[c].v.data(), band.smooth_later[c].v.data(), band.seen_first[c].v.data(), band.seen_later[c].v.data(), band.other.v.data(), pixels);
	}
	Smooth(band.other, band.rows, band.bias);
	kernel.ApplySquared(band.linear, band.rows, band.noise);
	GiveCredit({ band.variance.v.data(), band.bias.v.data(), band.noise.v.data(), band.few.v.data(),
	             band.weight.v.data(), band.credit.v.data(), band.keep.v.data(), band.least.v.data(), band.total.v.data(), band.cost.v.data() }, pixels);

	if(std::none_of(band.credit.v.begin(), band.credit.v.end(), [](float credit) { return credit > 0.0f; }))
		return;
	for(const int c : band.channels)
	{
		Blend(band.first[c], band.smooth_first[c], band.weight, band.credit, band.keep, band.best_first[c]);
		Blend(band.later[c], band.smooth_later[c], band.weight, band.credit, band.keep, band.best_later[c]);
	}
}

/// `sum` becomes the mean; where a light without bounds spoilt it, the pixel's own.
void Divide(PixelPlane& sum, const PixelPlane& total, const PixelPlane& own)
{
	for(size_t i = 0; i < sum.v.size(); i++)
	{
		const float mean = sum.v[i] / total.v[i];
		sum.v[i] = std::fabs(mean) < MostLight ? mean : own.v[i];
	}
}

/// Sums become means, and what was made of the two parts is added up like the parts themselves.
void Unite(Band& band)
{
	for(const int c : band.channels)
	{
		Divide(band.best_first[c], band.total, band.first[c]);
		Divide(band.best_later[c], band.total, band.later[c]);
		for(size_t i = 0; i < band.share.v.size(); i++)
			if(band.least.v[i] < band.variance.v[i])
				band.best[c].v[i] = band.share.v[i] * band.best_first[c].v[i] + (1.0f - band.share.v[i]) * band.best_later[c].v[i];
	}
	Divide(band.cost, band.total, band.variance);
}

/// Whether what was made of either half predicts the other, over a rectangle of the band (right, bottom exclusive), about as
/// well as the pixels' own means do.
bool Predicts(Band& band, int left, int top, int right, int bottom)
{
	float made = 0.0f, own = 0.0f;
	for(const int c : band.channels)
		for(int y = top; y < bottom; y++)
			for(int x = left; x < right; x++)
			{
				const float first = UpTo(JudgedRange, band.first[c].At(x, y)), later = UpTo(JudgedRange, band.later[c].At(x, y));
				const float by_first = UpTo(JudgedRange, band.best_first[c].At(x, y)) - later, by_later = UpTo(JudgedRange, band.best_later[c].At(x, y)) - first;
				made += by_first * by_first + by_later * by_later;
				own += (first - later) * (first - later);
			}
	return made <= own * (1.0f + AllowedError);
}

/// Blocks of the picture in which that is not so stay as they were: where a bright light is next to what has no noise, a
/// kernel that is best on average makes streaks of it.
void JudgeBlocks(const NoisyPicture& picture, int top, int bottom, Band& band)
{
	for(int y = top; y <= bottom; )
	{
		const int below = std::min(bottom + 1, y + JudgedBlock - (picture.top + y) % JudgedBlock);
		for(int x = 0; x < picture.width; )
		{
			const int beside = std::min(picture.width, x + JudgedBlock - (picture.left + x) % JudgedBlock);
			if(!Predicts(band, x + Margin, y - top + Margin, beside + Margin, below - top + Margin))
				for(int v = y - top + Margin; v < below - top + Margin; v++)
					for(int u = x + Margin; u < beside + Margin; u++)
					{
						for(int c = 0; c < PictureChannels; c++)
							band.best[c].At(u, v) = band.mean[c].At(u, v);
						band.cost.At(u, v) = band.variance.At(u, v);
					}
			x = beside;
		}
		y = below;
	}
}

}

double DenoiseRows(const NoisyPicture& picture, int top, int bottom, std::vector<float> (&denoised)[PictureChannels],
                   std::vector<float> *squared_error, std::vector<float> *own_share)
{
	static const std::vector<Kernel> kernels = AllKernels();
	Band band;
	double error = 0.0;

	// Whole blocks.
	const int first = std::max(0, top - (picture.top + top) % JudgedBlock);
	const int last = std::min(picture.height - 1, bottom + JudgedBlock - 1 - (picture.top + bottom) % JudgedBlock);
	CutBand(picture, first, last, band);
	for(const Kernel& kernel : kernels)
		TryKernel(kernel, band);
	Unite(band);
	JudgeBlocks(picture, first, last, band);

	for(int y = top; y <= bottom; y++)
		for(int x = 0; x < picture.width; x++)
		{
			const size_t from = size_t(y - first + Margin) * band.cost.width + x + Margin;
			for(int c = 0; c < PictureChannels; c++)
				denoised[c][size_t(y) * picture.width + x] = band.best[c].v[from];
			// What is left of the variance is taken to be left of red's, green's and blue's too.
			const double light = band.light.v.empty() ? 1.0 : band.light.v[from] / band.variance.v[from];
			const double pixel = band.cost.v[from] * light * Optimism;
			if(squared_error)
				(*squared_error)[size_t(y) * picture.width + x] = float(pixel);
			// Stein's weights: GiveCredit's cost is this share of the own variance.
			if(own_share)
				(*own_share)[size_t(y) * picture.width + x] = band.cost.v[from] / band.variance.v[from];
			error += pixel;
		}
	return error;
}

}
