// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Adaptive sampling of pixel and lens, a tile at a time.

#include <algorithm>
#include <cmath>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/denoised_picture.h"
#include "backend/tilt_lens/sample_sums.h"
#include "backend/tilt_lens/tile_borders.h"
#include "lens/lens_channels.h"
#include "lens/neighbourhood.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::SampleLevel;
using tilt_lens::TilePixel;

/// Samples a pixel, from its level on, until its own mean is as certain as the scene asks, or until
/// blur_samples are spent.
void TracePixel::ConvergeTiltLensPixel(TilePixel& pixel, DBL width, DBL height)
{
	const vector<SampleLevel>& levels = camera.Tilt_Lens.levels;

	for(; ; pixel.level++)
	{
		SampleTiltLensPixel(pixel, levels[pixel.level].samples, width, height);
		if((pixel.level + 1 == levels.size()) || StopsAt(levels[pixel.level], pixel.sums.VarianceToJudgeBy()))
			break;
	}
	cooperate();
}

/// Traces the pixels left..right, top..bottom (inclusive) of a picture of
/// width x height into `colours`, row by row.
void TracePixel::TraceTiltLensTile(int left, int top, int right, int bottom, int width, int height, vector<Colour>& colours)
{
	tilt_lens::CameraLens& lens = camera.Tilt_Lens;
	vector<TilePixel> tile;

	if(lens.pilot)
	{
		TraceTiltLensPilot(left, top, right, bottom, width, height, colours);
		return;
	}

	if(lens.Denoises() && GiveDenoisedTile(left, top, right, bottom, colours))
		return;

	int l = left, t = top, r = right, b = bottom;
	if(lens.Denoises())
		lens.denoised->Extend(l, t, r, b);
	const bool adapts = lens.levels.size() > 1;
	const int rays = lens.lens.splits ? tilt_lens::Wavelengths : 1;     // a sample
	tile.reserve((r - l + 1) * (b - t + 1));
	for(int y = t; y <= b; y++)
		for(int x = l; x <= r; x++)
			tile.push_back(TilePixel(x, y, lens.Seed()));

	if(adapts)
		ConvergeTiltLensTile(tile, l, t, r, b, width, height);

	for(vector<TilePixel>::iterator pixel = tile.begin(); pixel != tile.end(); pixel++)
	{
		ConvergeTiltLensPixel(*pixel, width, height);
		if((pixel->x >= left) && (pixel->x <= right) && (pixel->y >= top) && (pixel->y <= bottom))
		{
			colours.push_back(pixel->sums.Mean());
			if(lens.Records())
				RecordTiltLensChannels(*pixel, width, height);
		}
		threadData->tiltLensCounts.AddPixel(pixel->sums.count, pixel->sums.Changes(pixel->neighbourhood_variance));
		threadData->tiltLensCounts.AddLight(pixel->sums.count * rays - pixel->sums.stopped, pixel->sums.Rarity(lens.levels.front().samples), pixel->sums.count < lens.levels.back().samples);
	}
	threadData->Stats()[Number_Of_Pixels] += colours.size();

	if(lens.Denoises())
	{
		boost::mutex::scoped_lock lock(lens.denoised->mutex);
		for(vector<TilePixel>::iterator pixel = tile.begin(); pixel != tile.end(); pixel++)
			lens.denoised->Record(pixel->x, pixel->y, pixel->sums);
	}
}

/// The second pass over a picture that is denoised. False in the first.
bool TracePixel::GiveDenoisedTile(int left, int top, int right, int bottom, vector<Colour>& colours)
{
	tilt_lens::DenoisedPicture& picture = *camera.Tilt_Lens.denoised;
	boost::mutex::scoped_lock lock(picture.mutex);
	float c[tilt_lens::PictureChannels];

	if(!picture.IsComplete())
		return false;
	picture.Make(top, bottom, lock);
	for(int y = top; y <= bottom; y++)
		for(int x = left; x <= right; x++)
		{
			const DBL error = picture.Denoised(x, y, c);
			colours.push_back(Colour(c[0], c[1], c[2], c[3], c[4]));
			if(camera.Tilt_Lens.Records() && picture.KnowsError(x, y))
				camera.Tilt_Lens.channels->SetError(x, y, error);
		}
	return true;
}

/// The first samples of the pixels of `tile` and `apron`, which fill left..right, top..bottom as far as other tiles have not, and what
/// they differ by from those of their neighbours.
void TracePixel::CompareFirstTiltLensSamples(vector<TilePixel>& tile, vector<TilePixel>& apron, int left, int top, int right, int bottom, int width, int height)
{
	using namespace tilt_lens;
	TileBorders& borders = *camera.Tilt_Lens.borders;
	const int samples = camera.Tilt_Lens.levels.front().samples, channels = SampleSums::Channels;
	const int l = max(left - 1, 0), r = min(right + 1, width - 1), t = max(top - 1, 0), b = min(bottom + 1, height - 1), columns = r - l + 1;
	vector<float> means;
	vector<TilePixel> ring;

	{
		boost::mutex::scoped_lock lock(borders.mutex);
		borders.LookAtFirst(l, t, r, b, channels, means);
	}
	const auto index = [&](int x, int y) { return size_t(y - t) * columns + (x - l); };
	const auto look = [&](TilePixel& pixel)
	{
		float *const mean = &means[index(pixel.x, pixel.y) * channels];
		if(!std::isnan(mean[0]))
			return;
		SampleTiltLensPixel(pixel, samples, width, height);
		const Colour colour = pixel.sums.Mean();
		for(int c = 0; c < channels; c++)
			mean[c] = colour[c];
	};
	std::for_each(tile.begin(), tile.end(), look);
	std::for_each(apron.begin(), apron.end(), look);
	for(int y = t; y <= b; y++)
		for(int x = l; x <= r; x++)
			if(std::isnan(means[index(x, y) * channels]))
			{
				ring.push_back(TilePixel(x, y, camera.Tilt_Lens.Seed()));
				look(ring.back());
			}

	{
		boost::mutex::scoped_lock lock(borders.mutex);
		for(int y = t; y <= b; y++)
			borders.NoteFirst(l, r, y, channels, &means[index(l, y) * channels]);
		borders.Keep(ring);
	}

	const vector<Between> between = BetweenNeighbours(means, columns, b - t + 1, channels, samples);
	const auto compare = [&](TilePixel& pixel) { pixel.sums.between = between[index(pixel.x, pixel.y)]; };
	std::for_each(tile.begin(), tile.end(), compare);
	std::for_each(apron.begin(), apron.end(), compare);
}

/// Samples the pixels of a tile as far as they need it by themselves, and the
/// neighbours beyond its edges too, and sets the level that each is to reach at least.
/// Neighbours within the picture count wherever the tile ends, so that the picture
/// does not depend on tiles, strips or threads.
void TracePixel::ConvergeTiltLensTile(vector<TilePixel>& tile, int left, int top, int right, int bottom, int width, int height)
{
	using namespace tilt_lens;
	CameraLens& lens = camera.Tilt_Lens;
	TileBorders& borders = *lens.borders;
	const int l = max(left - NeighbourReach, 0), r = min(right + NeighbourReach, width - 1);
	const int t = max(top - NeighbourReach, 0), b = min(bottom + NeighbourReach, height - 1);
	const int columns = r - l + 1;
	vector<Uncertainty> uncertainty;
	vector<TilePixel> apron;

	{
		boost::mutex::scoped_lock lock(borders.mutex);
		borders.Look(l, t, r, b, width, height, uncertainty);
		borders.Take(tile, true);
		for(int y = t; y <= b; y++)
			for(int x = l; x <= r; x++)
			{
				const bool in_tile = (x >= left) && (x <= right) && (y >= top) && (y <= bottom);
				if(!in_tile && (uncertainty[(y - t) * columns + (x - l)] == UnknownUncertainty))
					apron.push_back(TilePixel(x, y, lens.Seed()));
			}
		borders.Take(apron, false);
	}

	if(lens.levels.front().samples < LeastOwnVariance)
		CompareFirstTiltLensSamples(tile, apron, l, t, r, b, width, height);
	vector<TilePixel> *const parts[2] = { &tile, &apron };
	for(int part = 0; part < 2; part++)
		for(vector<TilePixel>::iterator pixel = parts[part]->begin(); pixel != parts[part]->end(); pixel++)
		{
			ConvergeTiltLensPixel(*pixel, width, height);
			uncertainty[(pixel->y - t) * columns + (pixel->x - l)] = ToUncertainty(pixel->sums.VarianceToJudgeBy());
		}

	{
		boost::mutex::scoped_lock lock(borders.mutex);
		for(int y = t; y <= b; y++)
			for(int x = l; x <= r; x++)
				borders.Note(x, y, uncertainty[(y - t) * columns + (x - l)]);
		borders.Keep(apron);
	}

	const Neighbourhoods around(uncertainty, columns, b - t + 1);
	for(vector<TilePixel>::iterator pixel = tile.begin(); pixel != tile.end(); pixel++)
	{
		const size_t i = (pixel->y - t) * columns + (pixel->x - l);
		pixel->neighbourhood_variance = around.variance[i];
		pixel->level = NeighbourhoodLevel(lens.levels, pixel->level, around.near[i], around.far[i]);
	}
}

}
