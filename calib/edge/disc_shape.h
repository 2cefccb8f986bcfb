// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The shape of an edge's blur: how its light lies otherwise than a disc's of the same place and width.

#ifndef TILTCAL_DISC_SHAPE_H
#define TILTCAL_DISC_SHAPE_H

#include <Eigen/Core>

namespace tiltcal
{

/// A disc's light across an edge is 2/pi sqrt(1 - u^2) at u radii. Light that lies otherwise is that times a sum of Chebyshev's polynomials of the second kind: the first
/// two are the disc's place and width; of the next, U3 is more light on the bright side beyond half a radius (coma's tail) and U4 more at the rim and in the middle than between
/// (spherical aberration on one side of the focus; minus that on the other).
enum Shape { ASYMMETRY, HOLLOWNESS, SHAPES };

/// What a unit of each does to an edge at x px, seen by a pixel with boxes `box_a`, `box_b` (disc_edge.h); 1 is all light. Domain: radius > 0, of some 1.5 px or more, for boxes are
/// taken for a few points.
Eigen::Vector2d ShapeResponse(double x, double radius, double box_a, double box_b);

}

#endif
