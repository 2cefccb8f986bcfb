// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <limits>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/tilt_lens/sample_sums.h"
#include "backend/tilt_lens/tile_borders.h"

// this must be the last file included
#include "base/povdebug.h"

namespace tilt_lens
{

TileBorders::TileBorders() :
	pictureWidth(0), pictureHeight(0), begun(new Pixels())
{
}

TileBorders::~TileBorders()
{
	delete begun;
}

void TileBorders::Look(int left, int top, int right, int bottom, int width, int height, std::vector<Uncertainty>& known)
{
	if((width != pictureWidth) || (height != pictureHeight))
	{
		pictureWidth = width;
		pictureHeight = height;
		begun->clear();
		firstMeans.clear();
		noted.assign(size_t(width) * height, UnknownUncertainty);
	}
	known.clear();
	for(int y = top; y <= bottom; y++)
		known.insert(known.end(), noted.begin() + size_t(y) * width + left, noted.begin() + size_t(y) * width + right + 1);
}

void TileBorders::LookAtFirst(int left, int top, int right, int bottom, int channels, std::vector<float>& means)
{
	if(firstMeans.empty())
		firstMeans.assign(size_t(pictureWidth) * pictureHeight * channels, std::numeric_limits<float>::quiet_NaN());
	means.clear();
	for(int y = top; y <= bottom; y++)
	{
		const std::vector<float>::const_iterator row = firstMeans.begin() + size_t(y) * pictureWidth * channels;
		means.insert(means.end(), row + left * channels, row + (right + 1) * channels);
	}
}

void TileBorders::NoteFirst(int left, int right, int y, int channels, const float *means)
{
	std::copy(means, means + (right - left + 1) * channels, firstMeans.begin() + (size_t(y) * pictureWidth + left) * channels);
}

bool TileBorders::Take(TilePixel& pixel)
{
	const Pixels::iterator found = begun->find(std::make_pair(pixel.y, pixel.x));
	if(found == begun->end())
		return false;
	pixel = found->second;
	begun->erase(found);
	return true;
}

void TileBorders::Note(int x, int y, Uncertainty uncertainty)
{
	noted[size_t(y) * pictureWidth + x] = uncertainty;
}

void TileBorders::Keep(const TilePixel& pixel)
{
	const std::pair<Pixels::iterator, bool> kept = begun->insert(std::make_pair(std::make_pair(pixel.y, pixel.x), pixel));
	if(!kept.second && (kept.first->second.sums.count < pixel.sums.count))
		kept.first->second = pixel;
}

}
