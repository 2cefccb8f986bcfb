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
#include "lens/pilot.h"
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

/// In place of TraceTiltLensTile: the blocks of the pilot that begin in this tile, and
/// black elsewhere. Blocks at tile edges belong to the tile of their first pixel.
void TracePixel::TraceTiltLensPilot(int left, int top, int right, int bottom, int width, int height, vector<Colour>& colours)
{
	const tilt_lens::PilotRequest& request = camera.Tilt_Lens.pilot;
	const vector<bool> chosen = tilt_lens::PilotBlocks(request, width, height);
	const int columns = (width + PilotBlockSize - 1) / PilotBlockSize;

	for(int y = (top + PilotBlockSize - 1) / PilotBlockSize * PilotBlockSize; y <= bottom; y += PilotBlockSize)
		for(int x = (left + PilotBlockSize - 1) / PilotBlockSize * PilotBlockSize; x <= right; x += PilotBlockSize)
		{
			if(!chosen[(y / PilotBlockSize) * columns + x / PilotBlockSize])
				continue;
			const int w = min(PilotBlockSize, width - x), h = min(PilotBlockSize, height - y);
			vector<vector<PilotLevel> > pixels;
			const DBL start = Thread_Seconds();

			for(int i = 0; i < w * h; i++)
			{
				TilePixel pixel(x + i % w, y + i / w, camera.Tilt_Lens.Seed());
				pixels.push_back(vector<PilotLevel>());
				for(int n = 1; n <= request.samples; n *= 2)
				{
					SampleTiltLensPixel(pixel, n, width, height);
					const Colour mean = pixel.sums.Mean();
					const PilotLevel level = { n, { mean.red(), mean.green(), mean.blue() }, n > 1 ? pixel.sums.Variance() : 0.0 };
					pixels.back().push_back(level);
				}
				threadData->tiltLensCounts.AddPixel(pixel.sums.count, pixel.sums.Changes());
				cooperate();
			}
			Append_To_Pilot_File(request.file, tilt_lens::PilotText(x, y, w, h, Thread_Seconds() - start, pixels));
		}
	colours.resize(size_t(right - left + 1) * (bottom - top + 1), Colour(0.0));
}

}
