// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Are the sigmas true? The same lens and boards measured 200 times with seeded noise: the true values must lie inside
// two sigma as often as for a normal distribution.

#include <tiltcal/calibrate.h>
#include "solve/solve_joint.h"
#include "support/fewer_edges.h"
#include "support/synthetic_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const int SETS = 200;

Lens TheLens(double tilt)
{
	Lens lens = Tilted(tilt, 30);
	lens.curvature = -0.0006;
	lens.floor = 0.8;
	return lens;
}

/// Three photographs of two states, every fifth edge: as sigmas grow with the root of the edges, nothing is lost by few.
Task Photographs(const Noise& noise)
{
	Noise other = noise;
	other.seed += 100000;
	return WithEveryNth(5, MakeTask({ Photograph("untilted", TheLens(0), noise, 3), Photograph("tilted", TheLens(5), other, 3) }));
}

void AsOften(const std::map<std::string, int>& inside)
{
	for (const auto& [name, n] : inside)
	{
		testing::Test::RecordProperty(name, n);
		EXPECT_GE(n, SETS * 90 / 100) << name;
		EXPECT_LE(n, SETS * 99 / 100) << name;
	}
}

/// Of the plane in focus, degrees: its normal is n/f - e_z/w, as Scheimpflug and Hinge lines have it.
double PlaneTilt(const Lens& lens)
{
	const double tilt = lens.tilt * M_PI / 180;
	return std::atan2(std::sin(tilt) / lens.f, std::cos(tilt) / lens.f - 1 / lens.w) * 180 / M_PI;
}

TEST(MonteCarlo, TrueValuesAreInsideTwoSigmaAsOftenAsTheyShould)
{
	// From the noise-free answer on, so that 200 sets take seconds.
	const Calibration exact = Calibrate(Photographs({ 0, 0, 1 }), { Model::CURVED, Poses::SHARED });
	const Lens lens = TheLens(0), tilted = TheLens(5);
	std::map<std::string, int> inside;
	for (int i = 0; i < SETS; ++i)
	{
		Geometry g = exact.geometry;
		Solution s = exact.solution;
		const Task task = Photographs({ 0.04, 0.08, unsigned(i + 1) });
		ASSERT_TRUE(RefineJointly(task, Refinement::EDGES, g, s));
		const auto count = [&](const std::string& name, const Estimate& found, double truth) { inside[name] += std::abs(found.value - truth) < 2 * found.sigma; };
		const StateLens& a = s.states[1];
		count("w", s.w_mm, lens.w);
		count("d", s.aperture_diameter, lens.d);
		count("U", s.focus_distance, lens.FocusDistance());
		count("f", s.focal_length, lens.f);
		count("C", s.field_curvature, lens.curvature);
		count("lens tilt", a.lens_tilt, tilted.tilt);
		count("direction", a.tilt_direction, tilted.direction);
		count("plane tilt", a.focal_plane_tilt, PlaneTilt(tilted));
		count("U tilted", a.focus_distance, tilted.FocusDistance());
		count("principal point", { g.states[1].principal_point[0], g.states[1].principal_point_sigma[0] }, lens.cx);
		for (const size_t axis : { 0u, 1u, 2u })   // from the tilted state's own lens centre
			count("xyz"[axis] + std::string(" of a tilted pose"), { g.states[1].poses[1][3 + axis], g.states[1].pose_sigmas[1][3 + axis] }, PosesOfPhotographs(3)[1][3 + axis]);
		count("pose", { g.states[0].poses[1][5], g.states[0].pose_sigmas[1][5] }, PosesOfPhotographs(3)[1][5]);
	}
	AsOften(inside);
}

// A lens that distorts shows by places alone where its axis points; every edge says one thing then, not two.
TEST(MonteCarlo, SoAreTiltsByPlacesAlone)
{
	const auto distorting = [](double tilt)
	{
		Lens lens = Tilted(tilt, 30);
		lens.k1 = -0.2;
		return lens;
	};
	const auto photographs = [&](unsigned seed)
	{
		const double noise = seed ? 0.04 : 0;
		return MakeTask({ Photograph("untilted", distorting(0), { noise, 2 * noise, seed + 1 }, 3), Photograph("tilted", distorting(5), { noise, 2 * noise, seed + 100001 }, 3) });
	};
	CalibrateOptions options{ Model::PLANE, Poses::SHARED };
	const Calibration exact = Calibrate(photographs(0), options);
	ASSERT_GT(exact.geometry.distortion_terms, 0);
	std::map<std::string, int> inside;
	for (unsigned seed = 1; seed <= SETS; ++seed)
	{
		const GeometryAlone by_places = TiltFromGeometryAlone(photographs(seed), exact.geometry, exact.solution);
		ASSERT_EQ(by_places.states.size(), 2u);
		const StateLens& tilted = by_places.states[1];
		// As a vector: a direction's own sigma is one of a small tilt.
		for (const bool up : { true, false })
		{
			const double phi = tilted.tilt_direction.value * M_PI / 180, truth = (up ? std::cos(M_PI / 6) : std::sin(M_PI / 6)) * 5;
			const double found = tilted.lens_tilt.value * (up ? std::cos(phi) : std::sin(phi)), across = tilted.tilt_direction.sigma * M_PI / 180 * tilted.lens_tilt.value;
			const double sigma = up ? std::hypot(std::cos(phi) * tilted.lens_tilt.sigma, std::sin(phi) * across) : std::hypot(std::sin(phi) * tilted.lens_tilt.sigma, std::cos(phi) * across);
			inside[up ? "up" : "right"] += std::abs(found - truth) < 2 * sigma;
		}
	}
	AsOften(inside);
}

}
