// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Adaptive sampling of pixel and lens, a tile at a time.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/sample_sums.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::SampleLevel;
using tilt_lens::TilePixel;

/// Goes on with a pixel until it has `samples` samples.
void TracePixel::SampleTiltLensPixel(TilePixel& pixel, int samples, DBL width, DBL height)
{
	Ray ray;

	while(pixel.sums.count < samples)
	{
		// No ray, where the pixel looks along or behind the lens: empty, transparent.
		Colour c(0.0, 0.0, 0.0, 0.0, 1.0);

		tiltLensSample = pixel.sampler.Next();
		// remove interiors accumulated from previous sample (if any)
		ray.ClearInteriors();
		if(CreateCameraRay(ray, pixel.x + tiltLensSample.pixel_x - 0.5, pixel.y + tiltLensSample.pixel_y - 0.5, width, height, 0))
		{
			c.clear();
			Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
			TraceRay(ray, c, 1.0, ticket, false, camera.Max_Ray_Distance);
		}
		pixel.sums.Add(c);
	}
}

/// Samples a pixel until its own mean is as certain as the scene asks, or until
/// blur_samples are spent.
void TracePixel::ConvergeTiltLensPixel(TilePixel& pixel, DBL width, DBL height)
{
	const vector<SampleLevel>& levels = camera.Tilt_Lens.levels;

	for(pixel.own_level = 0; ; pixel.own_level++)
	{
		SampleTiltLensPixel(pixel, levels[pixel.own_level].samples, width, height);
		if((pixel.own_level + 1 == levels.size()) || (pixel.sums.VarianceOfMean() < levels[pixel.own_level].stop_below))
			break;
	}
}

/// Traces the pixels left..right, top..bottom (inclusive) of a picture of
/// width x height into `colours`, row by row.
///
/// Sixteen samples can miss what covers a few percent of the lens, and then find
/// nothing to be uncertain about; of the nine pixels around, hardly all miss it. So a
/// pixel takes as many samples as the neediest of its 3 x 3 neighbours by themselves.
/// Neighbours beyond the tile are sampled too, as far as that answer needs, so that
/// the picture does not depend on tiles, strips or threads.
void TracePixel::TraceTiltLensTile(int left, int top, int right, int bottom, int width, int height, vector<Colour>& colours)
{
	const vector<SampleLevel>& levels = camera.Tilt_Lens.levels;
	const bool adaptive = levels.size() > 1;
	const int apron = adaptive ? 1 : 0;
	const int l = max(left - apron, 0), r = min(right + apron, width - 1);
	const int t = max(top - apron, 0), b = min(bottom + apron, height - 1);
	const int columns = r - l + 1;
	vector<TilePixel> tile;

	tile.reserve(columns * (b - t + 1));
	for(int y = t; y <= b; y++)
		for(int x = l; x <= r; x++)
		{
			tile.push_back(TilePixel(x, y));
			ConvergeTiltLensPixel(tile.back(), width, height);
			cooperate();
		}

	for(int y = top; y <= bottom; y++)
		for(int x = left; x <= right; x++)
		{
			TilePixel& pixel = tile[(y - t) * columns + (x - l)];
			size_t level = pixel.own_level;
			for(int ny = max(y - apron, t); ny <= min(y + apron, b); ny++)
				for(int nx = max(x - apron, l); nx <= min(x + apron, r); nx++)
					level = max(level, tile[(ny - t) * columns + (nx - l)].own_level);
			SampleTiltLensPixel(pixel, levels[level].samples, width, height);
			cooperate();

			colours.push_back(pixel.sums.Mean());
			threadData->tiltLensCounts.AddPixel(pixel.sums.count, pixel.sums.SquaredError());
		}
}

}
