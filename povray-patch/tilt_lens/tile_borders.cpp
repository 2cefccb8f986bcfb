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
		taken.assign(size_t(width) * height, false);
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

void TileBorders::Take(std::vector<TilePixel>& pixels, bool own)
{
	Pixels::iterator kept = begun->end();
	for(size_t i = 0; i < pixels.size(); i++)
	{
		const std::pair<int, int> place(pixels[i].y, pixels[i].x);
		if(own)
			taken[size_t(pixels[i].y) * pictureWidth + pixels[i].x] = true;
		if((i == 0) || (pixels[i - 1].y != pixels[i].y))
			kept = begun->lower_bound(place);
		while((kept != begun->end()) && (kept->first < place))
			++kept;
		if((kept == begun->end()) || (kept->first != place))
			continue;
		pixels[i] = kept->second;
		kept = begun->erase(kept);
	}
}

void TileBorders::Note(int x, int y, Uncertainty uncertainty)
{
	noted[size_t(y) * pictureWidth + x] = uncertainty;
}

void TileBorders::Keep(const std::vector<TilePixel>& pixels)
{
	Pixels::iterator next = begun->begin();
	for(std::vector<TilePixel>::const_iterator pixel = pixels.begin(); pixel != pixels.end(); ++pixel)
	{
		const std::pair<int, int> place(pixel->y, pixel->x);
		if((pixel == pixels.begin()) || ((pixel - 1)->y != pixel->y))
			next = begun->lower_bound(place);
		while((next != begun->end()) && (next->first < place))
			++next;
		if(taken[size_t(pixel->y) * pictureWidth + pixel->x])
			continue;
		if((next == begun->end()) || (next->first != place))
			next = begun->insert(next, std::make_pair(place, *pixel));
		else if(next->second.sums.count < pixel->sums.count)
			next->second = *pixel;
	}
}

}
