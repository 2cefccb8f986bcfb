// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/lens_channels.h"

#include <mutex>

namespace tilt_lens
{

const char* const LensChannels::Names[Count] = { "Z", "blur.X", "samples.X", "error.X" };

void LensChannels::Begin(int w, int h)
{
	width = w;
	height = h;
	for(int c = 0; c < Count; c++)
		planes[c].assign(size_t(w) * h, c == 0 ? NothingThere : 0.0f);
}

void LensChannels::Set(int x, int y, const ChannelValues& values)
{
	const double value[Count] = { values.depth, values.blur, values.samples, values.error };

	for(int c = 0; c < Count; c++)
		planes[c][Index(x, y)] = float(value[c]);
}

namespace
{

// The picture is rendered by one part of POV-Ray and written by another, which share nothing but this.
std::mutex current_mutex;
std::shared_ptr<LensChannels> current;

}

std::shared_ptr<LensChannels> LensChannels::Current()
{
	const std::lock_guard<std::mutex> lock(current_mutex);
	return current;
}

void LensChannels::SetCurrent(const std::shared_ptr<LensChannels>& channels)
{
	const std::lock_guard<std::mutex> lock(current_mutex);
	current = channels;
}

}
