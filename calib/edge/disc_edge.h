// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a straight step edge looks like through a defocused lens and a square pixel.
//
// A uniform blur disc of radius R turns a unit step at x = 0 into
//   ESF(x) = 1/2 + [asin t + t sqrt(1 - t^2)] / pi,  t = x/R, |t| <= 1
// (area of a circular segment; any optics text, e.g. Born & Wolf 8.8 in the
// geometrical limit). A square pixel seen along the edge's normal (nx, ny) is a
// trapezoid: the convolution of two boxes, |nx| and |ny| wide. Convolving with two
// boxes is a second difference of ESF's second antiderivative, so the pixel is exact
// at every R, down to R = 0, where a sampled ESF would not be.

#ifndef TILTCAL_DISC_EDGE_H
#define TILTCAL_DISC_EDGE_H

#include "edge/soft_radius.h"

namespace tiltcal
{

/// ESF(x) of a disc of radius R >= 0; 0 on the far left, 1 on the far right. Pixels.
double DiscEdgeSpread(double x, double radius);

struct EdgeResponse
{
	double value;       ///< 0..1
	double d_position;  ///< derivative by x, 1/px
	double d_radius;    ///< derivative by R, 1/px
};

/// ESF of the disc convolved with boxes of widths `box_a`, `box_b` >= 0 (pixels), at
/// signed distance x from the edge. Domain: radius >= 0, box_a + box_b > 0.
EdgeResponse PixelEdgeResponse(double x, double radius, double box_a, double box_b);

/// The same with the soft radius u (soft_radius.h), `at(radius)` being what it is with a radius of 0 or more; d_radius becomes the derivative by u.
template<typename At>
inline EdgeResponse SoftResponse(double u, const At& at)
{
	const double linear_below = 0.01;   // of v, px^2
	const double v = SquareOfSoft(u), by_u = SquareBySoft(u);
	if (v >= linear_below)
	{
		const double radius = std::sqrt(v);
		EdgeResponse e = at(radius);
		e.d_radius *= by_u / (2 * radius);
		return e;
	}
	// A small blur changes an edge in proportion to v; that is carried on to negative ones.
	const EdgeResponse sharp = at(0.0), small = at(std::sqrt(linear_below));
	const double share = v / linear_below;
	return { sharp.value + share * (small.value - sharp.value), sharp.d_position + share * (small.d_position - sharp.d_position),
		(small.value - sharp.value) / linear_below * by_u };
}

}

#endif
