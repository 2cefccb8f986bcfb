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
		ASSERT_TRUE(RefineJointly(Photographs({ 0.04, 0.08, unsigned(i + 1) }), Refinement::EDGES, g, s));
		const auto count = [&](const char* name, const Estimate& found, double truth) { inside[name] += std::abs(found.value - truth) < 2 * found.sigma; };
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
		count("pose", { g.states[0].poses[1][5], g.states[0].pose_sigmas[1][5] }, PosesOfPhotographs(3)[1][5]);
	}
	for (const auto& [name, n] : inside)
	{
		RecordProperty(name, n);
		EXPECT_GE(n, SETS * 90 / 100) << name;
		EXPECT_LE(n, SETS * 99 / 100) << name;
	}
}

}
