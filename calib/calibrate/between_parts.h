// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a thin lens's numbers are worth where no real lens was found.

#ifndef TILTCAL_BETWEEN_PARTS_H
#define TILTCAL_BETWEEN_PARTS_H

#include <tiltcal/calibration.h>

#include <limits>
#include <vector>

namespace tiltcal
{

/// What a part of the edges, or all of them read otherwise, says of the thin lens.
struct PartAnswer
{
	Geometry geometry;
	Solution solution;
	double chance = 1;         ///< so much of its own variance is chance in its squared distance; 0: the same edges, which scatter alike
	double share = 1;          ///< of its distance that sigmas are to hold
};

/// The joint fit of `calibration` again, by edges, of the half of each photograph's edges that is nearer to the picture's middle, the half farther from
/// it, the sharper and the more blurred half. Those that converge, the others are added to `without_answer`; calibration.solution is an exact model's, jointly refined.
/// `by_place_alone`: the first two; noise on small blurs puts the sharper half apart by itself, some sigmas where all fits to its noise.
std::vector<PartAnswer> SolveParts(const Calibration& calibration, int& without_answer, bool by_place_alone = false);

/// Where no real lens is used, what the thin lens leaves out is the same in every photograph: neither
/// residuals nor the photographs against each other scatter by it, and noise may hide it in each edge that still puts all of them elsewhere. It differs from part to part of the picture and of the blur, so w, f, U, d and tilts
/// are put elsewhere by parts of the edges; the sigmas of `told` are widened in quadrature by the farthest part's distance, less what that part
/// scatters itself; where blur and places fit to their noise less twice that, for a half is apart from the whole by half its own variance: two sigmas, within which it is chance. `covariance` and `sigma_by_photographs` stay what scatters.
void WidenByParts(const Solution& whole, const std::vector<PartAnswer>& parts, Solution& told);

/// The same of where boards, lens centres and principal points are.
void WidenPlacesByParts(const Geometry& whole, const std::vector<PartAnswer>& parts, Geometry& told);

/// A thin lens does near its axis what real ones of any pupil magnification do, each with an f of its own (model/thin_lens_of_real.h): the sigma of f is
/// widened by what is not known of that, up to what is `known` of f beforehand (a sigma). Those of photographic lenses lie between some 0.5 (telephoto) and 1.7 (wide angle, retrofocus), about 1.
void WidenByPupils(Solution& told, double known = std::numeric_limits<double>::infinity());

}

#endif
