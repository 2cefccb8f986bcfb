// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The image of one circle's outline.

#ifndef TILTCAL_CIRCLE_OUTLINE_H
#define TILTCAL_CIRCLE_OUTLINE_H

#include "measure/grid_map.h"

#include <array>

namespace tiltcal
{

/// The outline as p(t), t the angle on the board from the columns' direction towards the rows': a Fourier series of order 4
/// of the mapped circle. In perspective its middle is not the image of the circle's centre; here both are known.
class CircleOutline
{
public:
	/// `place` (column, row) of the centre, `radius` in units of the spacing; `centre` is where the picture has the
	/// centre, px: the map gives the shape, not the place.
	CircleOutline(const GridMap& map, const Vec2& place, double radius, const Vec2& centre);

	Vec2 At(double t) const { return All(t).p; }

	/// dp / dt.
	Vec2 Tangent(double t) const { return All(t).first; }

	/// Unit normal away from the circle.
	Vec2 Outward(double t) const;

	/// Curvature (1/px) of the circle that touches the outline at t and cuts it about `reach` px to both sides (mean of both).
	double Curvature(double t, double reach) const;

	struct Foot
	{
		bool found = false;
		double t = 0;
		double distance = 0;   ///< px, positive outside
	};
	/// The outline's point nearest to `pixel`. Not found near and beyond its centres of curvature.
	Foot FootOf(const Vec2& pixel) const;

	/// Mean of the points of the outline's area: what a detector of blobs finds.
	Vec2 Centroid() const;

	/// Half the shorter axis, px.
	double SmallerRadius() const;

private:
	struct Point
	{
		Vec2 p, first, second;   // and derivatives by t
	};
	Point All(double t) const;

	static const int ORDER = 4;
	std::array<Vec2, ORDER + 1> cosines, sines;   // of multiples of t
	Vec2 centre;
	Eigen::Matrix2d place_from_pixel;   // near the centre
};

}

#endif
