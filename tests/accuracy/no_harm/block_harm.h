// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether one way to make a picture is worse than another one, block by block, by more than chance.
#pragma once
#include "support/picture.h"

#include <vector>

/// What many pairs of pictures say, each pair of samples of its own.
struct BlockHarm
{
	int blocks = 0, judged = 0;     ///< of a picture; and blocks of all pictures
	int once = 0;                   ///< of `judged`, more than a tenth worse in RMS error
	int tenth = 0, any = 0;         ///< of `blocks`, in the mean of all pairs: more than a tenth worse, worse at all
	double raw = 0, made = 0;       ///< squared errors, summed over pictures
	double worst = 0;               ///< the largest ratio of RMS errors in the mean, of blocks that are worse at all
	int worst_x = 0, worst_y = 0;   ///< where, pixels

	void Add(const BlockHarm& other);
};

/// Side of a block: those that denoise judges.
const int HarmBlock = 8;

/// A block counts as worse by Student's t at this level, one-sided, over the pairs.
const double HarmLevel = 0.001;

/// Compares `made` with `raw`, pair by pair, each against the truth, as displayed: clipped to 0 ... 1.
BlockHarm CompareBlocks(const std::vector<Picture>& raw, const std::vector<Picture>& made, const Picture& truth);

/// So many of `blocks` that are in truth no worse are called worse by chance, or fewer, but once in 10,000. Neighbours' noise is
/// nearly independent: Poisson's distribution.
int HarmAllowed(int blocks);
