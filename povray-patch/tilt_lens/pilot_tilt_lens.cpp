// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tracing the blocks of a pilot render (pilot.h).

#include <ctime>
#include <fstream>

#include <boost/thread/mutex.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/parser/parse.h"
#include "lens/neighbourhood.h"
#include "lens/pilot.h"
#include "backend/tilt_lens/pilot_queue.h"
#include "backend/tilt_lens/sample_sums.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::PilotBlockSize;
using tilt_lens::PilotLevel;
using tilt_lens::TilePixel;

static DBL Thread_Seconds()
{
	timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return DBL(t.tv_sec) + 1e-9 * DBL(t.tv_nsec);
}

/// Appended whole, so that a pilot that is stopped leaves whole blocks.
static void Append_To_Pilot_File(const std::string& file, const std::string& text)
{
	static boost::mutex mutex;
	boost::mutex::scoped_lock lock(mutex);
	std::ofstream(file.c_str(), std::ios::app) << text << std::flush;
}

/// What the renderer does with the first samples of a block of w x h pixels: a pixel costs it once.
static void Judge_First_Pilot_Samples(vector<TilePixel>& block, int w, int h)
{
	const int channels = tilt_lens::SampleSums::Channels;
	vector<float> means;
	vector<tilt_lens::Uncertainty> uncertainty;

	for(const TilePixel& pixel : block)
	{
		const Colour mean = pixel.sums.Mean();
		for(int c = 0; c < channels; c++)
			means.push_back(mean[c]);
	}
	for(const tilt_lens::Between& between : tilt_lens::BetweenNeighbours(means, w, h, channels, 1))
		uncertainty.push_back(tilt_lens::ToUncertainty(between.most));
	const tilt_lens::Neighbourhoods around(uncertainty, w, h);
	for(size_t i = 0; i < block.size(); i++)
		block[i].neighbourhood_variance = around.variance[i];
}

/// One sample each of a few pixels that are spread over a block of w x h pixels; `sample` gives one's mean, of a pixel of the block.
template<typename Sample>
static std::string Scout_Pilot_Block(int x, int y, int w, int h, const Sample& sample)
{
	const int step = PilotBlockSize / tilt_lens::ScoutSide;
	const int columns = max(1, (w + step / 2 - 1) / step), rows = max(1, (h + step / 2 - 1) / step);
	vector<double> rgb;
	const DBL start = Thread_Seconds();

	for(int i = 0; i < columns * rows; i++)
	{
		const Colour mean = sample(x + min(i % columns * step + step / 2, w - 1), y + min(i / columns * step + step / 2, h - 1));
		for(int c = 0; c < 3; c++)
			rgb.push_back(mean[c]);
	}
	return tilt_lens::ScoutText(x, y, Thread_Seconds() - start, columns * rows, tilt_lens::ScoutedChange(rgb, columns, rows));
}

/// In place of TraceTiltLensTile: as many blocks of the pilot as this tile has room for, one at least, from
/// anywhere in the picture, which itself stays black.
void TracePixel::TraceTiltLensPilot(int left, int top, int right, int bottom, int width, int height, vector<Colour>& colours)
{
	for(int y = top; y <= bottom; y += PilotBlockSize)
		for(int x = left; x <= right; x += PilotBlockSize)
		{
			int block_x, block_y;
			if(camera.Tilt_Lens.pilot_queue->Next(block_x, block_y))
				TraceTiltLensPilotBlock(block_x, block_y, width, height);
		}
	colours.resize(size_t(right - left + 1) * (bottom - top + 1), Colour(0.0));
}

void TracePixel::TraceTiltLensPilotBlock(int x, int y, int width, int height)
{
	const tilt_lens::PilotRequest& request = camera.Tilt_Lens.pilot;
	const int w = min(PilotBlockSize, width - x), h = min(PilotBlockSize, height - y);
	const int rays = camera.Tilt_Lens.lens.splits ? tilt_lens::Wavelengths : 1;     // a sample
	vector<vector<PilotLevel> > pixels;
	vector<TilePixel> tile;
	const auto sampled = [&](int px, int py)
	{
		TilePixel pixel(px, py, camera.Tilt_Lens.Seed());
		SampleTiltLensPixel(pixel, 1, width, height);
		return pixel.sums.Mean();
	};
	if(request.Scouts())
	{
		Append_To_Pilot_File(request.file, Scout_Pilot_Block(x, y, w, h, sampled));
		return;
	}
	const DBL start = Thread_Seconds();

	for(int i = 0; i < w * h; i++)
	{
		tile.push_back(TilePixel(x + i % w, y + i / w, camera.Tilt_Lens.Seed()));
		SampleTiltLensPixel(tile.back(), 1, width, height);
	}
	Judge_First_Pilot_Samples(tile, w, h);
	const DBL first = Thread_Seconds() - start;

	for(TilePixel& pixel : tile)
	{
		pixels.push_back(vector<PilotLevel>());
		for(int n = 1; n <= request.samples; n *= 2)
		{
			if(n > 1)
				SampleTiltLensPixel(pixel, n, width, height);
			const Colour mean = pixel.sums.Mean();
			const PilotLevel level = { n, { mean.red(), mean.green(), mean.blue(), mean.filter(), mean.transm() }, n > 1 ? pixel.sums.Variance() : 0.0 };
			pixels.back().push_back(level);
		}
		threadData->tiltLensCounts.AddPixel(pixel.sums.count, pixel.sums.Changes());
		threadData->tiltLensCounts.AddLight(pixel.sums.count * rays - pixel.sums.stopped, tilt_lens::RareLight(), false);
		cooperate();
	}
	const tilt_lens::PilotSetting own = { camera.Blur_Samples_Min, camera.Blur_Samples, camera.Variance, camera.Confidence, camera.Tilt_Lens.spec.denoise };
	Append_To_Pilot_File(request.file, tilt_lens::PilotText(x, y, w, h, Thread_Seconds() - start, first, own, pixels));
}

/// For #fopen: what tiltcost tries is not to leave traces in the user's files.
void Parser::Refuse_To_Write_In_Pilot(const UCS2String& file)
{
	if(tilt_lens::PilotIsOn() && !tilt_lens::PilotMayWrite())
		Error("%s: %s", tilt_lens::PilotWritesNothing, UCS2toASCIIString(file).c_str());
}

}

namespace tilt_lens
{

PilotQueue::PilotQueue(const PilotRequest& asked) :
	request(asked), next(0), columns(1), begun(-1.0)
{
}

void PilotQueue::Begin(int width, int height, int left, int top, int right, int bottom)
{
	columns = (width + PilotBlockSize - 1) / PilotBlockSize;
	blocks = PilotBlocks(request, width, height, left, top, right, bottom);
	next = 0;
	begun = -1.0;
}

double PilotQueue::Seconds()
{
	timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

bool PilotQueue::Next(int& x, int& y)
{
	boost::mutex::scoped_lock lock(mutex);
	const double now = Seconds();

	if(begun < 0.0)
		begun = now;
	if((next == blocks.size()) || ((now - begun > request.seconds) && (next >= size_t(FewestPilotBlocks))))
		return false;
	x = blocks[next] % columns * PilotBlockSize;
	y = blocks[next] / columns * PilotBlockSize;
	next++;
	return true;
}

}
