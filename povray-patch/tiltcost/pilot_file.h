// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a pilot render wrote (lens/pilot.h), read back.

#ifndef TILTCOST_PILOT_FILE_H
#define TILTCOST_PILOT_FILE_H

#include "lens/pilot.h"
#include "tiltcost/block_choice.h"

#include <optional>
#include <string>
#include <vector>

namespace tiltcost
{

struct PilotBlock
{
	int left = 0, top = 0, width = 0, height = 0;
	double seconds = 0;     ///< CPU, for all samples of all pixels
	double first_seconds = 0;   ///< of them, for the first of each, and what a pixel costs once
	std::optional<tilt_lens::PilotSetting> own;     ///< what the scene says
	SampledBlock sampled;   ///< how it was chosen
	size_t picture = 0;     ///< of a film: which of the frames that have pilots
	/// Row by row; of a pixel the sums at 1, 2, 4, ... samples.
	std::vector<std::vector<tilt_lens::PilotLevel>> pixels;
};

/// What blocks of a picture were chosen from; none: they count alike.
struct Population
{
	double blocks = 0, worth = 0;
};

/// The whole blocks in the text, in its order; a last one that was cut off is left out.
/// All pixels have the same levels. Throws tiltcal::Error when the text is something
/// else, and when a block comes twice: more than one frame was rendered.
std::vector<PilotBlock> ParsePilot(const std::string& text);

/// By rows: a pilot's file has them as threads got them done, and what is estimated is not to depend on that.
void SortByPlace(std::vector<PilotBlock>& blocks);

/// Leaves `count` of the blocks or all, spread over them as they lie in the picture: in a pilot's file the dear ones are last. Sorts them.
void ThinOut(size_t count, std::vector<PilotBlock>& blocks);

/// CPU seconds of all blocks.
double TraceSeconds(const std::vector<PilotBlock>& blocks);

}

#endif
