// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The pilot render, by which tiltcost learns what a scene's accuracy costs: small
// blocks spread over the picture at its full size, every pixel with the same large
// number of samples, and the sums on the way written to a file.
//
// Asked for in the environment, because a scene is not to be changed for it:
//   TILT_LENS_PILOT=BLOCKS,SAMPLES,SECONDS,FILE
// With SAMPLES 1 it only scouts: one sample of a few pixels of each block, and how much they differ, by which blocks are chosen that are
// worth the many samples. TILT_LENS_PILOT_BLOCKS=FILE names those, numbers as of PilotBlocks in their order; else they are spread evenly.
// The picture itself stays black. Files of the user's are not written: a scene that opens one
// for writing is refused, unless TILT_LENS_PILOT_WRITES is set too.

#ifndef TILT_LENS_PILOT_H
#define TILT_LENS_PILOT_H

#include <cstddef>
#include <string>
#include <vector>

namespace tilt_lens
{

/// Pixels along the side of a block.
const int PilotBlockSize = 16;

/// Names of the environment's variables.
const char PilotVariable[] = "TILT_LENS_PILOT";
const char PilotWritesVariable[] = "TILT_LENS_PILOT_WRITES";
const char PilotBlocksVariable[] = "TILT_LENS_PILOT_BLOCKS";

/// What the parser says of a file that a scene opens for writing; tiltcost looks for it.
const char PilotWritesNothing[] = "A pilot render writes no files, and this scene opens one for writing";

/// No block is begun later than its seconds, once so many are.
const int FewestPilotBlocks = 4;

struct PilotRequest
{
	int blocks = 0;             ///< how many are wanted; 0: no pilot
	int samples = 0;            ///< per pixel, a power of two; 1: a scout
	double seconds = 0.0;       ///< wall time from the first block on, after which no block is begun
	std::string file;           ///< there, and empty, from when the picture of a lens that is sampled begins; appended to, one block at a time
	std::string chosen;         ///< file of the blocks' numbers; empty: spread evenly

	explicit operator bool() const { return blocks > 0; }
	bool Scouts() const { return samples == 1; }
};

/// The request in a text such as "64,256,10,/tmp/pilot.txt"; none for a null pointer or
/// a text that says something else.
PilotRequest ParsePilotRequest(const char *text);

/// What the environment asks for.
PilotRequest PilotOfEnvironment();

/// Whether this process renders a pilot, and whether its scene may write files.
bool PilotIsOn();
bool PilotMayWrite();

/// A pilot's blocks in a picture of width x height pixels, each as (y / PilotBlockSize) *
/// columns + x / PilotBlockSize, columns = ceil(width / PilotBlockSize). In the order of
/// Roberts' R2 sequence: what comes first is spread evenly however many follow. Fewer than
/// asked for where two fall together.
std::vector<int> PilotBlocks(const PilotRequest& request, int width, int height);

/// The same of those that begin in left..right, top..bottom (inclusive), or of the one that holds its corner where none does. Of those that
/// request.chosen names, what is in the picture, in that order.
std::vector<int> PilotBlocks(const PilotRequest& request, int width, int height, int left, int top, int right, int bottom);

/// The sums of one pixel at one power of two.
struct PilotLevel
{
	int samples;
	double mean[5];             ///< red, green, blue, linear; filter, transmit
	double variance;            ///< of a sample, the largest of the channels; 0 for one sample
};

/// What the scene's own camera says: what the picture itself will take.
struct PilotSetting
{
	int min, max;               ///< blur_samples; min 0: none named
	double variance, confidence;
	bool denoise;
};

/// One block as text:
///   block LEFT TOP WIDTH HEIGHT SECONDS FIRST MIN MAX VARIANCE CONFIDENCE DENOISE
/// (pixels; CPU seconds for all its samples, and for its pixels' first ones with all that a pixel costs once; the scene's setting), then row by row a line a pixel:
///   N MEAN_R MEAN_G MEAN_B MEAN_FILTER MEAN_TRANSMIT VARIANCE, for N = 1, 2, 4, ... up to the samples.
std::string PilotText(int left, int top, int width, int height, double seconds, double first_seconds, const PilotSetting& setting, const std::vector<std::vector<PilotLevel> >& pixels);

/// Samples of a scouted block along its side, of pixels in the middle of as many equal parts. A block that the picture cuts has fewer.
const int ScoutSide = 8;

/// Light beyond this counts as this for a scout: a few samples of a lamp tell that its disc is bright.
const double ScoutWhite = 4.0;

/// The mean square by which neighbours among columns x rows scouted pixels differ, mean over red, green and blue (linear, 0 .. ScoutWhite). 0 for a single one.
double ScoutedChange(const std::vector<double>& rgb, int columns, int rows);

/// A scouted block as text:
///   scout LEFT TOP SECONDS SAMPLES CHANGE
/// (pixels; CPU seconds for so many samples; ScoutedChange).
std::string ScoutText(int left, int top, double seconds, int samples, double change);

}

#endif
