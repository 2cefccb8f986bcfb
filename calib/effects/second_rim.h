// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether a lens has a second rim, and where.

#ifndef TILTCAL_SECOND_RIM_H
#define TILTCAL_SECOND_RIM_H

#include "effects/rim_fit.h"

namespace tiltcal
{

/// What one rim and what two rims leave over, and the two.
struct TwoRims
{
	Rims rims;                              ///< the first before the lens; empty: no fit
	std::vector<RimEstimate> estimates;     ///< of the same; sigmas of covariance and jackknife, the larger ones
	std::vector<Rims> left_out;             ///< without each group in turn; empty where nothing was left out
	SecondRim verdict;
};

/// Tries, beside the rim `one` before the lens, another behind it and another before it, and takes the one whose light fits better. It
/// is kept (verdict.used) where it is significant (SIGNIFICANT_RIM) and predicts groups left out better than one rim does (WORTH_IT), brightness and
/// places of edges together, each in its sigmas.
TwoRims TrySecondRim(const RimFit& start, const tilt_lens::Rim& one, double focal_length);

}

#endif
