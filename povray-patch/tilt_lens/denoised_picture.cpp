// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/tilt_lens/denoised_picture.h"
#include "backend/tilt_lens/sample_sums.h"

// this must be the last file included
#include "base/povdebug.h"

namespace tilt_lens
{

// Rows that are denoised at a time: enough that their margins hardly count.
static const int BandHeight = 128;

DenoisedPicture::DenoisedPicture() :
	part(), extended(), missing(0), squaredError(0.0), shown(false)
{
}

void DenoisedPicture::Begin(int width, int height, int left, int top, int right, int bottom)
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
	bandDone.assign((noisy.height + BandHeight - 1) / BandHeight, false);
	for(int c = 0; c < PictureChannels; c++)
		denoised[c].assign(missing, 0.0f);
	squaredErrors.assign(missing, 0.0f);
	squaredError = 0.0;
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
	const size_t i = size_t(y - extended.top) * noisy.width + (x - extended.left);
	const int part = sums.FirstPart();

	const Colour mean = sums.Mean();
	for(int c = 0; c < PictureChannels; c++)
		noisy.mean[c][i] = mean[c];
	for(int c = 0; c < 3; c++)
		noisy.first[c][i] = part > 0 ? float(sums.FirstMean(c)) : mean[c];
	noisy.count[i] = float(sums.count);
	if(!recorded[i])
		missing--;
	recorded[i] = true;
}

double DenoisedPicture::Denoised(int x, int y, float *channels)
{
	const int row = y - extended.top, band = row / BandHeight;

	if(!bandDone[band])
	{
		squaredError += DenoiseRows(noisy, band * BandHeight, std::min((band + 1) * BandHeight, noisy.height) - 1, denoised, &squaredErrors);
		bandDone[band] = true;
	}
	const size_t i = size_t(row) * noisy.width + (x - extended.left);
	for(int c = 0; c < PictureChannels; c++)
		channels[c] = denoised[c][i];
	shown = true;
	return std::sqrt(double(squaredErrors[i]));
}

double DenoisedPicture::RmsError() const
{
	return recorded.empty() ? 0.0 : std::sqrt(squaredError / double(recorded.size()));
}

}
