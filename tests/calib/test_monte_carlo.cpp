// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Are the sigmas true? The same lens and boards measured 200 times with seeded noise: the true values must lie inside
// two sigma as often as for a normal distribution.

#include <tiltcal/calibrate.h>
#include "solve/solve_joint.h"
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
	Task task = MakeTask({ Photograph("untilted", TheLens(0), noise, 3), Photograph("tilted", TheLens(5), other, 3) });
	for (State& state : task.states)
		for (Photo& photo : state.photos)
		{
			std::vector<Edge> some;
			for (size_t k = 0; k < photo.edges.size(); k += 5)
				some.push_back(photo.edges[k]);
			photo.edges = some;
		}
	return task;
}

double Direction(double degrees) { return degrees * 3.14159265358979323846 / 180; }

TEST(MonteCarlo, TrueValuesAreInsideTwoSigmaAsOftenAsTheyShould)
{
	// Solved without noise once; its own small errors (second order in the aperture) are not the noise's, so that
	// the sets are compared with this, which test_solve_curved.cpp compares with the lens.
	const Calibration exact = Calibrate(Photographs({ 0, 0, 1 }), { Model::CURVED, Poses::SHARED });
	std::map<std::string, int> inside;
	for (int i = 0; i < SETS; ++i)
	{
		Geometry g = exact.geometry;
		Solution s = exact.solution;
		ASSERT_TRUE(RefineJointly(Photographs({ 0.04, 0.08, unsigned(i + 1) }), Refinement::EDGES, g, s));
		const auto count = [&](const char* name, const Estimate& found, const Estimate& expected)
		{
			inside[name] += std::abs(found.value - expected.value) < 2 * found.sigma;
		};
		const StateLens &a = s.states[1], &b = exact.solution.states[1];
		count("w", s.w_mm, exact.solution.w_mm);
		count("d", s.aperture_diameter, exact.solution.aperture_diameter);
		count("U", s.focus_distance, exact.solution.focus_distance);
		count("f", s.focal_length, exact.solution.focal_length);
		count("C", s.field_curvature, exact.solution.field_curvature);
		count("lens tilt", a.lens_tilt, b.lens_tilt);
		count("direction", a.tilt_direction, b.tilt_direction);
		count("plane tilt", a.focal_plane_tilt, b.focal_plane_tilt);
		count("U tilted", a.focus_distance, b.focus_distance);
		count("principal point", { g.states[1].principal_point[0], g.states[1].principal_point_sigma[0] }, { exact.geometry.states[1].principal_point[0], 0 });
		count("pose", { g.states[0].poses[1][5], g.states[0].pose_sigmas[1][5] }, { exact.geometry.states[0].poses[1][5], 0 });
	}
	for (const auto& [name, n] : inside)
	{
		RecordProperty(name, n);
		EXPECT_GE(n, SETS * 90 / 100) << name;
		EXPECT_LE(n, SETS * 99 / 100) << name;
	}
	// And what the sets are compared with is the lens.
	EXPECT_LT(TiltError(exact.solution.states[1], TheLens(5)), 0.003);
	EXPECT_NEAR(Direction(exact.solution.states[1].tilt_direction.value), Direction(30), 0.001);
}

}
