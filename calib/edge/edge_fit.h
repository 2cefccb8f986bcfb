// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Fits position, slope and blur disc of one straight edge to its pixels.

#ifndef TILTCAL_EDGE_FIT_H
#define TILTCAL_EDGE_FIT_H

#include "edge/disc_edge.h"

#include <vector>

namespace tiltcal
{

/// One pixel near an edge, in the edge's own axes (pixels).
struct EdgeSample
{
	double x;      ///< signed distance from the nominal edge, dark side negative
	double s;      ///< position along the edge, 0 at its middle
	double value;  ///< linear light
};

/// How brightness changes around an edge (vignetting, the lamp), relative and per pixel, across it and along.
struct EdgeShading
{
	double x = 0, s = 0;
};

struct EdgeFit
{
	bool valid = false;
	double low = 0, high = 0;           ///< plateaus at the edge's middle, linear light
	EdgeShading shading;                    ///< as it was given
	double offset = 0, slope = 0;       ///< the edge lies at x = offset + slope s
	double radius = 0;                  ///< of the blur disc; negative: its square is (soft_radius.h)
	double offset_sigma = 0, slope_sigma = 0;
	double radius_sigma = 0;            ///< of the soft radius: of the radius itself where it is large
	double rms = 0;                     ///< residual, linear light
};

/// What an edge looks like where it is alone, or among others: 0 on its dark side, 1 on its bright side.
class EdgeProfile
{
public:
	virtual ~EdgeProfile() = default;
	/// At `sample`, the edge lying at x = offset + slope s. d_position is the derivative by -offset.
	virtual EdgeResponse At(const EdgeSample& sample, double offset, double slope, double radius) const = 0;
};

/// A straight edge alone: PixelEdgeResponse with boxes |nx|, |ny|, (nx, ny) its unit normal in the picture.
class LoneEdge : public EdgeProfile
{
public:
	LoneEdge(double nx, double ny);
	EdgeResponse At(const EdgeSample& sample, double offset, double slope, double radius) const override;

private:
	double box_a, box_b;
};

/// Model: value = (1 + shading.x x + shading.s s) (low + (high - low) E), E from `profile`. Levenberg-Marquardt with
/// Huber weights; sigmas from the covariance rescaled by the residuals. A radius below
/// about 0.3 px is not told from 0, and its square may come out negative.
/// The shading is not fitted: a blur with a tail to one side (coma) looks like one, but only where the tail is bright.
/// `start_radius` in pixels. Not valid: fewer than 40 samples, no contrast, no convergence.
EdgeFit FitEdge(const std::vector<EdgeSample>& samples, const EdgeProfile& profile, const EdgeShading& shading, double start_radius);

/// A change of a fit; of the soft radius.
struct EdgeChange
{
	double offset = 0, slope = 0, radius = 0;
};

/// How much `fit`, of samples that look like `profile`, changes to first order when they look like `other`.
EdgeChange FirstOrderChange(const std::vector<EdgeSample>& samples, const EdgeProfile& profile, const EdgeProfile& other, const EdgeFit& fit);

}

#endif
