// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A checkerboard so blurred that its edges run into each other.
//
// Through a blur disc of radius R a pixel sees the mean of the pattern over the lens points s of the unit disc. A straight
// line of the board at signed distance D from the pixel is on the pixel's far side for s.n > t, t = -D/R_l, R_l the blur
// radius at the line's nearest point. This is exact for the thin lens even where R changes over the board:
// a pixel sees the board at p + R(p) s / (1 - g.s), g the gradient of R, and s.n R / (1 - g.s) > -D is s.(R n - D g) > -D,
// with |R n - D g| = R_l to first order in g.
// The checkerboard is the product of two square waves, each a sum of such half-planes, so its blurred image is
// a sum of shares of the unit disc in half-planes (DiscEdgeSpread) and in wedges of two (WedgeShare), both closed forms.

#ifndef TILTCAL_BLURRED_CHECKER_H
#define TILTCAL_BLURRED_CHECKER_H

#include "edge/edge_fit.h"

#include <cstddef>
#include <vector>

namespace tiltcal
{

/// Share of the unit disc in { s.n1 > t1, s.n2 > t2 }, and its derivatives by t1 and t2. `angle` from n1 to n2, 0..pi.
struct Wedge
{
	double share, d_t1, d_t2;
};
Wedge WedgeShare(double t1, double t2, double angle);

/// A line of the board in the axes of the edge that is measured: x across it, s along it, px.
struct CheckerLine
{
	double nx = 1, ns = 0;   ///< unit normal
	double at = 0;           ///< nx x + ns s = at on the line
	double grow = 0;         ///< R_l - R of the measured edge's middle, R_l the blur radius where the line is nearest; px
};

/// Response of FitEdge for an edge among the others of its board: 0..1 across the edge as for a lone one. The pixel is
/// counted by its variance, 1/12 px^2 in both directions, in the disc's: right to 1e-3 of the contrast for R > 2.5 px.
class BlurredChecker : public EdgeProfile
{
public:
	/// `across`: lines parallel to the edge in the order of x, without the edge itself, `before` of them at x < 0.
	/// `along`: lines that cross it in the order of s, `start` of them at s < 0. Normals point to larger x and s.
	BlurredChecker(std::vector<CheckerLine> across, std::size_t before, std::vector<CheckerLine> along, std::size_t start);

	EdgeResponse At(const EdgeSample& sample, double offset, double slope, double radius) const override;

private:
	std::vector<CheckerLine> across, along;
	std::size_t before, start;
	std::vector<double> angles;   // between across[i] and along[j], row by row
};

}

#endif
