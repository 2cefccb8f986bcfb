// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is kept of an edge's pixels for the photometric refinement: its brightness across
// itself, in bins finer than a pixel.

#ifndef TILTCAL_BINNED_PROFILE_H
#define TILTCAL_BINNED_PROFILE_H

#include <tiltcal/photo.h>
#include "edge/edge_fit.h"

#include <vector>

namespace tiltcal
{

/// The profile of the samples that `fit` was made from: slope, shading and place are taken out of
/// it, so that x is the distance from the fitted edge. Bins are a 16th of the blur's radius
/// wide, within 0.1 to 0.5 px: what a bin's width adds to the blur is then below 0.1 % of it, and at
/// small blur below 0.03 px. Sorted by x.
std::vector<ProfileBin> BinnedProfile(const std::vector<EdgeSample>& samples, const EdgeFit& fit);

}

#endif
