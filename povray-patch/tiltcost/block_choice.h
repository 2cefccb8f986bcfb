// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which blocks of the picture have the pilot's many samples, and what each of them stands for: where a scout saw
// neighbours differ, errors are large, and blocks are taken more often and count for less.
// Sampling with unequal chances and calibrated weights: Saerndal, Swensson and Wretman, Model Assisted Survey Sampling, chapters 3.6 and 6.4.

#ifndef TILTCOST_BLOCK_CHOICE_H
#define TILTCOST_BLOCK_CHOICE_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tiltcost
{

/// A block that was looked at (lens/pilot.h).
struct ScoutedBlock
{
	int left = 0, top = 0;
	double seconds = 0;     ///< CPU, for its samples
	int samples = 0;
	double change = 0;      ///< mean square by which neighbouring pixels' samples differ
};

/// The whole lines in the text. Throws tiltcal::Error when it is something else.
std::vector<ScoutedBlock> ParseScouted(const std::string& text);

/// CPU seconds of all, and of a sample on average (0 without blocks).
double TraceSeconds(const std::vector<ScoutedBlock>& blocks);
double SecondsPerSample(const std::vector<ScoutedBlock>& blocks);

class BlockChoice
{
public:
	BlockChoice() = default;
	explicit BlockChoice(const std::vector<ScoutedBlock>& scouted);

	/// Numbers of `count` blocks or all, as of tilt_lens::PilotBlocks in a picture of `columns` blocks a row; what comes first is spread over the
	/// picture and over what blocks are worth, however many follow.
	std::vector<int> Choose(size_t count, int columns) const;

	/// The chance that a block has among `count` that are chosen; nothing for one that was not looked at.
	std::optional<double> ChanceOf(int left, int top, size_t count) const;

	/// What a block is taken to be worth, in any unit: its error's square grows with it. 0 for one that was not looked at.
	double WorthOf(int left, int top) const;

	size_t Blocks() const { return scouted.size(); }
	/// The sum over all that were looked at.
	double Worth() const;

private:
	size_t IndexOf(int left, int top) const;
	std::vector<double> Chances(size_t count) const;

	std::vector<ScoutedBlock> scouted;      ///< along a curve that keeps neighbours together
	std::vector<double> worths;
};

/// What is known of a sampled block when it is weighted.
struct SampledBlock
{
	double chance = 1, worth = 0;
};

/// How many blocks each of these stands for, so that they add up to `blocks` in number and to `worth` in worth; in proportion to 1 / chance where
/// no such weights are above 0.
std::vector<double> CalibratedWeights(const std::vector<SampledBlock>& sampled, double blocks, double worth);

}

#endif
