// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a curved edge looks like through a defocused lens and a square pixel.
//
// A pixel at signed distance x from a circle of radius rho sees, through a blur disc of radius R, the part of the disc
// that is outside of the circle: the overlap of two circles (two segments, any book of geometry), exact at every R. To this
// the pixel's square is added as for a straight edge (disc_edge.h): the response is the straight one, plus the difference of curved
// and straight for a disc of the variance of both, R'^2 = R^2 + 1/3. An outline that is not a circle is taken for the circle
// that touches it at the point nearest to the pixel and cuts it R'/sqrt(2) to both sides, where the disc weighs
// the second and the fourth power of the distance alike.

#ifndef TILTCAL_CIRCLE_EDGE_H
#define TILTCAL_CIRCLE_EDGE_H

#include "edge/edge_fit.h"

#include <vector>

namespace tiltcal
{

/// As PixelEdgeResponse, for an edge of `curvature` (1/px), positive when it bends around its dark side.
/// Domain: |x| below 1/|curvature| on the inner side; right to 4e-3 for 1/|curvature| above 6 px, which is 0.003 px of
/// place.
EdgeResponse CurvedEdgeResponse(double x, double radius, double curvature, double box_a, double box_b);

/// A point of an edge that bends.
struct BendPoint
{
	double s;             ///< along the edge, px
	double nx, ny;        ///< unit normal in the picture, dark to bright
	double curvature;     ///< 1/px, positive around the dark side
};

/// Response of FitEdge for a curved edge: sample.x is the signed distance from the nominal curve, sample.s the length
/// along it.
class CurvedEdge : public EdgeProfile
{
public:
	/// At least two points, s increasing; linear between them.
	explicit CurvedEdge(std::vector<BendPoint> points) : bend(std::move(points)) {}
	EdgeResponse At(const EdgeSample& sample, double offset, double slope, double radius) const override;

private:
	std::vector<BendPoint> bend;
};

}

#endif
