// SPDX-License-Identifier: AGPL-3.0-or-later

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
		noted.assign(size_t(width) * height, UnknownUncertainty);
	}
	known.clear();
	for(int y = top; y <= bottom; y++)
		known.insert(known.end(), noted.begin() + size_t(y) * width + left, noted.begin() + size_t(y) * width + right + 1);
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
	begun->insert(std::make_pair(std::make_pair(pixel.y, pixel.x), pixel));
}

}
