// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the fit of a disc's edge (edge_fit.h) makes of light that does not fall into a disc.

#ifndef TILTCAL_FIT_RESPONSE_H
#define TILTCAL_FIT_RESPONSE_H

#include "edge/disc_shape.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tiltcal
{

/// Of the light at a distance x from an edge by place, soft diameter and both plateaus; `soft`: its soft diameter.
Eigen::RowVector4d ByFit(double x, double nx, double ny, double soft);

/// The same and by the shapes, of an edge of this blur diameter.
Eigen::Matrix<double, 1, 4 + SHAPES> ByFitAndShape(double x, double nx, double ny, double diameter);

/// To first order about the fit that was made, the fit's place and soft diameter (soft_radius.h) are sums over the light: a point of light that
/// falls x px to the bright side of the fitted line, all light being 1, moves them by place(x) and soft(x). By least squares over pixels at
/// distances up to `reach`, with both plateaus free. So a halo, a tail or a sharp core counts as the fit counts it, not by its variance.
class FitResponse
{
public:
	/// An edge with the unit normal (nx, ny) and the fitted blur diameter (its sign as in Edge::blur), px; a point is itself a blur of the variance `own` px^2.
	/// `shaped`: with ShapeOf.
	FitResponse(double nx, double ny, double diameter, double reach, double own, bool shaped = false);

	/// At a distance x, and the derivative by x. 0 far beyond the reach, where light is plateau.
	struct Value { double value, derivative; };
	Value Place(double x) const { return Interpolated(place, x); }
	Value Soft(double x) const { return Interpolated(soft, x); }
	/// What ShapeOfEdge (edge_shape.h) makes of it, place and width fitted beside. Of a `shaped` one.
	Value ShapeOf(Shape k, double x) const { return Interpolated(shapes[k], x); }

private:
	Value Interpolated(const std::vector<double>& table, double x) const;

	double first = 0, step = 1;
	std::vector<double> place, soft;
	std::array<std::vector<double>, SHAPES> shapes;
};

}

#endif
