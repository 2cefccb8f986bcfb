// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the tiles of a picture know of each other. A pixel's decision looks a little
// beyond its tile; sampling those neighbours again for every tile would cost a
// quarter more rays.

#ifndef TILT_LENS_TILE_BORDERS_H
#define TILT_LENS_TILE_BORDERS_H

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <boost/thread/mutex.hpp>

#include "lens/adaptive.h"

namespace tilt_lens
{

struct TilePixel;

/// Shared by all threads of a render. What is kept is what any tile would find by
/// itself, so the picture does not depend on which tile comes first.
class TileBorders
{
	public:
		TileBorders();
		~TileBorders();

		/// Copies the uncertainties of left..right, top..bottom (inclusive) of a picture of
		/// width x height into `known`, row by row, UnknownUncertainty where no tile has been yet.
		void Look(int left, int top, int right, int bottom, int width, int height, std::vector<Uncertainty>& known);

		/// The same of the means of pixels' first samples, so many numbers a pixel; the first is NaN where no tile has been yet. After Look.
		void LookAtFirst(int left, int top, int right, int bottom, int channels, std::vector<float>& means);

		/// Hands over those of the pixels, which stand row by row, that another tile has begun. `own`: they are the tile's own, and
		/// nothing is kept for it from now on.
		void Take(std::vector<TilePixel>& pixels, bool own);

		/// Notes a pixel's uncertainty.
		void Note(int x, int y, Uncertainty uncertainty);

		/// Notes a row of means as LookAtFirst gives them.
		void NoteFirst(int left, int right, int y, int channels, const float *means);

		/// Keeps pixels that belong to other tiles, row by row, for them; of two the one with more samples.
		void Keep(const std::vector<TilePixel>& pixels);

		/// Held while any of the above is called.
		boost::mutex mutex;
	private:
		TileBorders(const TileBorders&);
		TileBorders& operator=(const TileBorders&);

		typedef std::map<std::pair<int, int>, TilePixel> Pixels;
		int pictureWidth, pictureHeight;
		std::vector<Uncertainty> noted;
		std::vector<bool> taken;        // by the tile that it belongs to
		std::vector<float> firstMeans;  // only where a scene's pixels may stop at so few samples: 20 bytes a pixel
		Pixels *begun;                  // by (y, x)
};

}

#endif
