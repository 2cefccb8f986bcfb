// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `blades N [rotation A] [curvature C]`: the opening is a polygon with its
// corners on the circle of the aperture, with straight edges (C = 0) or edges that are
// arcs of a circle, up to the whole circle (C = 1).
//
// The map from the square preserves area: Shirley and Chiu's concentric squares become
// concentric polygons, and equal lengths along a square's side equal areas of the
// sectors that an edge spans with the centre.

#ifndef TILT_LENS_BLADES_H
#define TILT_LENS_BLADES_H

#include <cmath>

#include "lens/angles.h"
#include "lens/pupil.h"

namespace tilt_lens
{

const int FewestBlades = 3;
const int MostBlades = 64;

/// A polygonal opening of circumradius 1.
struct Blades
{
	int count;
	double rotation;        ///< azimuth of a corner, radians: 0 up, pi/2 right
	double half_angle;      ///< half of what one edge spans, seen from the centre
	double half_chord;      ///< of an edge
	double middle;          ///< distance of an edge's middle from the centre
	double bend;            ///< 1/radius of an edge's arc
	double half_arc;        ///< half of an edge's length
	double half_area;       ///< AreaAlongEdge(half_arc)
};

/// (x - sin x) / x^2, which loses its digits for small x when written so. |x| < 2.
inline double ArcSurplus(double x)
{
	if(std::fabs(x) > 0.1)
		return (x - std::sin(x)) / (x * x);
	const double x2 = x * x;
	return x / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0)));
}

/// Twice the area between the centre and the part of an edge from its middle up to the arc
/// length s. The edge's centre of curvature lies 1/bend behind its middle, so that with
/// alpha = bend s it is [middle alpha + (1/bend - middle)(alpha - sin alpha)] / bend.
inline double AreaAlongEdge(const Blades& b, double s)
{
	return b.middle * s + (1.0 - b.bend * b.middle) * s * s * ArcSurplus(b.bend * s);
}

/// The derivative of that: twice the area per length.
inline double AreaPerLength(const Blades& b, double s)
{
	const double half = 0.5 * b.bend * s;
	return b.middle + (1.0 - b.bend * b.middle) * s * (half != 0.0 ? std::sin(half) * std::sin(half) / half : 0.0);
}

/// count from FewestBlades to MostBlades, rotation in radians, curvature from 0 to 1.
inline Blades MakeBlades(int count, double rotation, double curvature)
{
	Blades b;
	b.count = count;
	b.rotation = rotation;
	b.half_angle = Pi / count;
	b.half_chord = std::sin(b.half_angle);
	// The arc's height over its chord; from it the circle through the three points.
	const double height = curvature * 2.0 * std::sin(0.5 * b.half_angle) * std::sin(0.5 * b.half_angle);
	b.middle = std::cos(b.half_angle) + height;
	b.bend = 2.0 * height / (b.half_chord * b.half_chord + height * height);
	b.half_arc = b.bend > 0.0 ? 2.0 * std::atan2(height, b.half_chord) / b.bend : b.half_chord;
	b.half_area = AreaAlongEdge(b, b.half_arc);
	return b;
}

/// Area of the opening; pi for a circle.
inline double AreaOf(const Blades& b)
{
	return b.count * b.half_area;
}

/// The point of an edge, in a frame whose x axis goes through the edge's middle, up to
/// which a share of the edge's area lies: -1 one end, 0 the middle, 1 the other.
inline PupilPoint PointOfEdge(const Blades& b, double share)
{
	if(b.bend == 0.0)
		return { b.middle, share * b.half_chord };
	double s = share * b.half_arc;
	for(int i = 0; i < 4; i++)      // Newton's method on a nearly straight line
		s -= (AreaAlongEdge(b, s) - share * b.half_area) / AreaPerLength(b, s);
	const double alpha = b.bend * s, half = 0.5 * alpha;
	return { b.middle - (half != 0.0 ? s * std::sin(half) * std::sin(half) / half : 0.0),
	         alpha != 0.0 ? s * std::sin(alpha) / alpha : s };
}

/// Square to the opening, preserving area. u, v in [0, 1].
inline PupilPoint SquareToBlades(const Blades& b, double u, double v)
{
	const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
	double r, turn;         // of the concentric square, and how far around it, in [0, 1)
	if(std::fabs(x) > std::fabs(y))
	{
		r = x;
		turn = 0.125 * (y / x);
	}
	else if(y != 0.0)
	{
		r = y;
		turn = 0.25 - 0.125 * (x / y);
	}
	else
		return { 0.0, 0.0 };
	if(r < 0.0)
	{
		r = -r;
		turn += 0.5;
	}
	const double edges = (turn + 0.125) * b.count;
	const double edge = std::floor(edges);
	const PupilPoint p = PointOfEdge(b, 2.0 * (edges - edge) - 1.0);
	// The edge's middle in azimuth, clockwise from up; its own y axis points counter-clockwise.
	const double azimuth = b.rotation - (2.0 * edge + 1.0) * b.half_angle;
	const double c = std::cos(azimuth), s = std::sin(azimuth);
	return { r * (p.x * s - p.y * c), r * (p.x * c + p.y * s) };
}

}

#endif
