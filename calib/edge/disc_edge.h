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

}

#endif
