// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The blocks that a pilot render has still to trace, whichever thread asks.

#ifndef TILT_LENS_PILOT_QUEUE_H
#define TILT_LENS_PILOT_QUEUE_H

#include <cstddef>
#include <vector>

#include <boost/thread/mutex.hpp>

#include "lens/pilot.h"

namespace tilt_lens
{

/// In the order in which blocks are spread, not tile by tile: a pilot whose time is up has seen
/// all parts of the picture.
class PilotQueue
{
	public:
		explicit PilotQueue(const PilotRequest& asked);

		/// Begins a picture of width x height pixels, of which left..right, top..bottom
		/// (inclusive) are rendered: blocks count whose first pixel is.
		void Begin(int width, int height, int left, int top, int right, int bottom);

		/// The first pixel of the next block. False when none is left, or the pilot's time is up.
		bool Next(int& x, int& y);

	private:
		double Seconds();

		const PilotRequest request;
		boost::mutex mutex;
		std::vector<int> blocks;
		std::size_t next;
		int columns;
		double begun;                   // when the first block was, below 0 before
};

}

#endif
