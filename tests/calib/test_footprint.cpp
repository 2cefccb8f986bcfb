// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The width of the footprint against the paper's blur width, and where astigmatism shows.

#include "model/footprint.h"

#include <tiltcal/photo.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tiltcal;

const double W = 2400;   // px

Geometry Undistorted()
{
	Geometry g;
	g.w_px = W;
	g.states.resize(1);
	return g;
}

/// An edge whose normal in the picture stands at `degrees` from the picture's x axis, y down.
Edge EdgeAt(double degrees)
{
	Edge e;
	e.nx = std::cos(degrees * M_PI / 180);
	e.ny = std::sin(degrees * M_PI / 180);
	return e;
}

double Width(const Geometry& g, const Vec3<double>& q, const Vec3<double>& n, const double* curvature, const Vec3<double>& P, double degrees)
{
	return std::sqrt(SquaredFootprintWidth(16.0, q, n, curvature, P, EdgeGradient(g, 0, P, EdgeAt(degrees))));
}

TEST(Footprint, UntiltedItIsTheBlurWidthOfThePaper)
{
	const double none[2] = { 0, 0 };
	const Vec3<double> q{ 0, 0, 1 / 620.0 };
	for (const Vec3<double>& P : { Vec3<double>{ 0, 0, 700 }, Vec3<double>{ 100, -60, 550 } })
		for (const double degrees : { 0.0, 30.0, 90.0, 200.0 })
			EXPECT_NEAR(Width(Undistorted(), q, { 0, 0, 1 }, none, P, degrees), W * 16 * std::abs(1 / 620.0 - 1 / P.z), 1e-9);
}

TEST(Footprint, ATiltedDiscIsForeshortenedAlongTheTilt)
{
	const double none[2] = { 0, 0 }, t = 10 * M_PI / 180;
	const Vec3<double> n{ 0, -std::sin(t), std::cos(t) }, q{ 0, 0, 1 / 620.0 }, P{ 0, 0, 700 };
	const double across = Width(Undistorted(), q, n, none, P, 0);
	EXPECT_NEAR(Width(Undistorted(), q, n, none, P, 90), across * std::cos(t), 1e-9 * across);
}

TEST(Footprint, AnEdgeAcrossTheRadiusSeesTheTangentialFocus)
{
	// The point lies to the right of the axis at tan = 0.2. The edge that runs up and down there has its normal
	// along the radius.
	const double C_t = -0.002, C_s = 0.0005, curvature[2] = { (C_t + C_s) / 2, (C_t - C_s) / 2 };
	const Vec3<double> q{ 0, 0, 1 / 620.0 }, P{ 140, 0, 700 };
	const auto blur = [&](double C) { return W * 16 * std::abs(1 / 620.0 + C * 0.04 - 1 / 700.0); };
	EXPECT_NEAR(Width(Undistorted(), q, { 0, 0, 1 }, curvature, P, 0), blur(C_t), 1e-9);
	EXPECT_NEAR(Width(Undistorted(), q, { 0, 0, 1 }, curvature, P, 90), blur(C_s), 1e-9);
	// In between the blur is an ellipse with these two axes.
	EXPECT_NEAR(Width(Undistorted(), q, { 0, 0, 1 }, curvature, P, 45), std::hypot(blur(C_t), blur(C_s)) / std::sqrt(2), 1e-9);
}

TEST(Footprint, DistortionStretchesBlurAsItStretchesThePicture)
{
	const double none[2] = { 0, 0 };
	Geometry g = Undistorted();
	g.distortion = { -0.1, 0, 0, 0, 0 };
	const Vec3<double> q{ 0, 0, 1 / 620.0 }, P{ 140, 0, 700 };
	const double straight = Width(Undistorted(), q, { 0, 0, 1 }, none, P, 0);
	// r (1 + k1 r^2): 1 + 3 k1 r^2 along the radius, 1 + k1 r^2 across it.
	EXPECT_NEAR(Width(g, q, { 0, 0, 1 }, none, P, 0), straight * (1 - 0.3 * 0.04), 1e-9);
	EXPECT_NEAR(Width(g, q, { 0, 0, 1 }, none, P, 90), straight * (1 - 0.1 * 0.04), 1e-9);
}

}
