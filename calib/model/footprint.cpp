// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/footprint.h"

#include "model/projection.h"
#include <cmath>

namespace tiltcal
{

Point EdgeNormal(const Edge& e)
{
	// The edge runs along (ny, -nx) + slope (nx, ny).
	const double nx = e.nx - e.slope * e.ny, ny = e.ny + e.slope * e.nx, length = std::hypot(nx, ny);
	return { nx / length, ny / length };
}

Vec3<double> EdgeGradient(const Geometry& g, size_t state, const Vec3<double>& P, const Edge& e)
{
	const Point normal = EdgeNormal(e);
	const Vec3<double>& n = g.states[state].lens_normal;
	const PictureOf<double> picture{ g.w_px, g.distortion.data(), g.states[state].principal_point.data(), n, tilt_lens::BasisOfLensPlane(n) };
	return picture.Gradient(P, normal[0], normal[1]);
}

}
