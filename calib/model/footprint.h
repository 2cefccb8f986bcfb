// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How wide a point's image is across an edge: the footprint of the lens's disc on the
// sensor, as the exact models see it (povray-patch/lens/MODEL.md, Blur and footprint).
//
// Through the lens point S, n.S = 0, the point P is seen where the lens centre sees
// P - sigma S, sigma = 1 - kappa(P) (optics.h, PixelDirectionThroughLensPoint, but for a
// factor 1 + q.S, which makes the footprint lopsided and changes its width by (d/2)^2 |q|^2
// of itself, 1e-4 to 1e-3). The place of the edge across itself, in pixels, changes with P by
// the gradient G; so S moves it by -sigma G.S, and S runs over a disc of diameter d in the
// lens plane: the width is d |sigma| |G - (G.n) n|. Untilted and without distortion this is
// b = w d |1 - q.P| / z; in a tilted lens it is the width of an ellipse.
//
// Astigmatism: across the radius from the lens axis (the sagittal direction) a lens has
// another focus than along it (tangential): sigma is then a matrix in the lens plane with
// these two eigenvalues, one curvature for each.

#ifndef TILTCAL_FOOTPRINT_H
#define TILTCAL_FOOTPRINT_H

#include <tiltcal/calibration.h>

#include "lens/field_curvature.h"

namespace tiltcal
{

/// How far (px) the lens point S moves an edge at p (camera frame, mm) across itself: -S times this. q 1/mm, n the
/// unit lens normal. `curvature`: C, the mean of the tangential and the sagittal field curvature, and half their
/// difference, C_t - C and C - C_s; 1/mm. G px/mm. It lies in the lens plane.
template<typename T>
inline Vec3<T> MoveByLensPoint(const Vec3<T>& q, const Vec3<T>& n, const T* curvature, const Vec3<T>& p, const Vec3<T>& G)
{
	const Vec3<T> across = G - Dot(G, n) * n;
	const T depth = Dot(p, n);
	const Vec3<T> aside = p - depth * n;   // r times the unit vector along the radius
	const T sagittal = T(1) - Dot(q, p) - (curvature[0] - curvature[1]) * tilt_lens::CurvatureTerm(n, p);
	// sigma across = sagittal across + (tangential - sagittal) r r^T across, without dividing by r.
	return sagittal * across - (T(2) * curvature[1] * Dot(aside, across) / depth) * aside;
}

/// Square of the width (px) across an edge at p of the image of a point there. d mm, the rest as above. Squared, because
/// that is smooth where the width is 0.
template<typename T>
inline T SquaredFootprintWidth(const T& d, const Vec3<T>& q, const Vec3<T>& n, const T* curvature, const Vec3<T>& p, const Vec3<T>& G)
{
	const Vec3<T> moved = MoveByLensPoint(q, n, curvature, p, G);
	return d * d * Dot(moved, moved);
}

/// The edge's own normal in the picture: (nx, ny), turned by its slope; y down.
Point EdgeNormal(const Edge& edge);

/// G of an edge of state `state` at P: d(nx u + ny v)/dP, px/mm, (nx, ny) its fitted normal. The distortion, which
/// stretches blur as it stretches the picture, is in it.
Vec3<double> EdgeGradient(const Geometry& geometry, size_t state, const Vec3<double>& P, const Edge& edge);

}

#endif
