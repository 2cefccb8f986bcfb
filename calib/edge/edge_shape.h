// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The shape of a measured edge's blur.

#ifndef TILTCAL_EDGE_SHAPE_H
#define TILTCAL_EDGE_SHAPE_H

#include <tiltcal/photo.h>
#include "edge/disc_shape.h"

#include <array>
#include <optional>

namespace tiltcal
{

/// Blurs below this diameter, px, have no shape: a pixel hides it.
const double LEAST_SHAPED = 3;

/// As parts of the light (disc_shape.h).
struct EdgeShape
{
	std::array<double, SHAPES> value{}, sigma{};
};

/// Beside place, width and plateaus, to first order about the fit, from the profile that was kept. None: no profile, or a blur below LEAST_SHAPED.
std::optional<EdgeShape> ShapeOfEdge(const Edge& edge);

}

#endif
