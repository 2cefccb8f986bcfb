// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <numeric>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/tilt_lens/denoised_picture.h"
#include "backend/tilt_lens/sample_sums.h"

// this must be the last file included
#include "base/povdebug.h"

namespace tilt_lens
{

DenoisedPicture::DenoisedPicture() :
	part(), extended(), firstBand(0), lastBand(0), missing(0), making(0), shown(false)
{
}

void DenoisedPicture::Begin(int width, int height, int left, int top, int right, int bottom, bool errors)
{
	const Rectangle p = { left, top, right, bottom };
	const Rectangle e = { std::max(0, left - DenoiseReach), std::max(0, top - DenoiseReach),
	                      std::min(width - 1, right + DenoiseReach), std::min(height - 1, bottom + DenoiseReach) };
	part = p;
	extended = e;
	noisy.Resize(e.right - e.left + 1, e.bottom - e.top + 1);
	noisy.left = e.left;
	noisy.top = e.top;
	missing = size_t(noisy.width) * noisy.height;
	recorded.assign(missing, false);
	// Those that lie in the margins alone are not wanted.
	bands.assign((noisy.height + DenoiseBand - 1) / DenoiseBand, Band::IsDone);
	firstBand = (top - e.top) / DenoiseBand;
	lastBand = (bottom - e.top) / DenoiseBand;
	std::fill(bands.begin() + firstBand, bands.begin() + lastBand + 1, Band::Waits);
	sums.assign(bands.size(), 0.0);
	for(int c = 0; c < PictureChannels; c++)
		denoised[c].assign(missing, 0.0f);
	squaredErrors.assign(errors ? missing : 0, 0.0f);
	shown = false;
}

void DenoisedPicture::Extend(int& left, int& top, int& right, int& bottom) const
{
	left = left == part.left ? extended.left : left;
	top = top == part.top ? extended.top : top;
	right = right == part.right ? extended.right : right;
	bottom = bottom == part.bottom ? extended.bottom : bottom;
}

void DenoisedPicture::Record(int x, int y, const SampleSums& sums)
{
	const size_t i = Index(x, y);
	const int part = sums.FirstPart();

	const Colour mean = sums.Mean();
	for(int c = 0; c < PictureChannels; c++)
	{
		noisy.mean[c][i] = mean[c];
		noisy.first[c][i] = part > 0 ? float(sums.FirstMean(c)) : mean[c];
	}
	noisy.count[i] = float(sums.count);
	if(!recorded[i])
		missing--;
	recorded[i] = true;
}

void DenoisedPicture::Make(int top, int bottom, boost::mutex::scoped_lock& lock)
{
	const size_t last = (bottom - extended.top) / DenoiseBand;

	for(size_t band = (top - extended.top) / DenoiseBand; band <= last; band++)
		while(bands[band] != Band::IsDone)
		{
			const size_t next = NextBand(band);

			if((next < bands.size()) && (making < DenoiseThreads))
				MakeBand(next, lock);
			else
				changed.wait(lock);
		}
}

/// The first that nobody has begun, from the wanted one on and then from the top; bands.size() where there is none.
size_t DenoisedPicture::NextBand(size_t wanted) const
{
	for(size_t i = 0; i < bands.size(); i++)
	{
		const size_t band = (wanted + i) % bands.size();

		if(bands[band] == Band::Waits)
			return band;
	}
	return bands.size();
}

void DenoisedPicture::MakeBand(size_t band, boost::mutex::scoped_lock& lock)
{
	const int top = int(band) * DenoiseBand, bottom = std::min(top + DenoiseBand, noisy.height) - 1;

	const auto finish = [&](Band state)
	{
		lock.lock();
		bands[band] = state;
		making--;
		changed.notify_all();
	};

	bands[band] = Band::IsMade;
	making++;
	lock.unlock();
	try
	{
		// Bands write to rows and sums of their own, and the samples are all there.
		sums[band] = DenoiseRows(noisy, top, bottom, denoised, squaredErrors.empty() ? nullptr : &squaredErrors);
	}
	catch(...)
	{
		finish(Band::Waits);
		throw;
	}
	finish(Band::IsDone);
}

double DenoisedPicture::Denoised(int x, int y, float *channels)
{
	const size_t i = Index(x, y);

	for(int c = 0; c < PictureChannels; c++)
		channels[c] = denoised[c][i];
	shown = true;
	return squaredErrors.empty() ? 0.0 : std::sqrt(double(squaredErrors[i]));
}

double DenoisedPicture::RmsError() const
{
	double sum = 0.0, pixels = 0.0;

	for(size_t band = firstBand; (band <= lastBand) && (band < bands.size()); band++)
		if(bands[band] == Band::IsDone)
		{
			const int top = int(band) * DenoiseBand;
			sum += sums[band];
			pixels += double(std::min(DenoiseBand, noisy.height - top)) * noisy.width;
		}
	return pixels > 0.0 ? std::sqrt(sum / pixels) : -1.0;
}

}
