// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SOLVE_REAL_LENS_H
#define TILTCAL_SOLVE_REAL_LENS_H

#include <tiltcal/calibration.h>

#include <functional>
#include <optional>
#include <vector>

namespace tiltcal
{

/// What is found of one lens's glass.
struct RealLenses
{
	RealLens tilts;                  ///< six numbers
	std::optional<RealLens> scene;   ///< sixteen, and the rims; where it converges. `held_out_thin` of it is that of `tilts` in its own units
	int fits_without_answer = 0;   ///< of four halves of the edges, those that do not tell the numbers of `tilts` apart
};

/// One real lens for all states, from the thin lens on; `rims`: what vignettes; `through_rims`: the task with edges as they were measured, while those of `task` are without what rims
/// make of them, as a thin lens has them. Where there is no answer, its failure says so. `judge`
/// sets `used` of the one found, and says whether the one of sixteen numbers, which takes three times as long, is asked for beside it.
RealLenses FindRealLens(const Task& task, const Task& through_rims, const Geometry& geometry, const Solution& thin, const std::vector<RimEstimate>& rims,
	const std::function<bool(RealLens& tilts)>& judge);

/// Where a rim holds back the axis's own light, nothing shows the border of the stop, of whose two images m is the ratio: what is known of m is what is known of lenses.
void WidenHiddenStop(RealLens& lens);

}

#endif
