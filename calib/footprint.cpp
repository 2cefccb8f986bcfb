// SPDX-License-Identifier: AGPL-3.0-or-later

#include "footprint.h"

#include <ceres/jet.h>

#include <cmath>

namespace tiltcal
{

Vec3<double> EdgeGradient(const Geometry& g, size_t state, const Vec3<double>& P, const Edge& e)
{
	using Jet = ceres::Jet<double, 3>;
	Jet k[5], pixel[2];
	for (size_t i = 0; i < 5; ++i)
		k[i] = Jet(g.distortion[i]);
	const Jet origin[2] = { Jet(0), Jet(0) };
	Project(Jet(g.w_px), k, origin, g.lens_normal[state], Vec3<Jet>{ Jet(P.x, 0), Jet(P.y, 1), Jet(P.z, 2) }, pixel);
	// The edge runs along (ny, -nx) + slope (nx, ny).
	const double nx = e.nx - e.slope * e.ny, ny = e.ny + e.slope * e.nx, length = std::hypot(nx, ny);
	const Eigen::Vector3d G = (nx / length) * pixel[0].v + (ny / length) * pixel[1].v;
	return { G[0], G[1], G[2] };
}

}
