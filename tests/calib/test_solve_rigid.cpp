// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The rigid model on lenses that are rigid, and on one that is not.

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "solve/solve_lens.h"
#include "support/synthetic_lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tiltcal;
using namespace synthetic;

struct Case
{
	double tilt, direction;
};

class RigidTilt : public testing::TestWithParam<Case> {};

TEST_P(RigidTilt, ComesBackFromExactBlur)
{
	const Lens untilted, tilted = Tilted(GetParam().tilt, GetParam().direction);
	const Calibration c = Calibrate(TwoStates(untilted, tilted), { Model::RIGID, Poses::AUTO });
	const Solution& s = c.solution;
	EXPECT_EQ(s.model, Model::RIGID);
	// Left out is what is of second order in the aperture, (d/2)^2 |q|^2 = 4e-4 of the blur at most. As vectors, because
	// 2 degrees at 90 is -2 degrees at -90.
	const double found = s.states[1].lens_tilt.value, phi = s.states[1].tilt_direction.value * M_PI / 180, true_phi = tilted.direction * M_PI / 180;
	EXPECT_NEAR(found * std::sin(phi), tilted.tilt * std::sin(true_phi), 0.002);
	EXPECT_NEAR(found * std::cos(phi), tilted.tilt * std::cos(true_phi), 0.002);
	EXPECT_NEAR(s.aperture_diameter.value, 16, 0.016);
	EXPECT_NEAR(s.focal_length.value, untilted.f, 0.002);
	EXPECT_NEAR(s.states[1].focal_length.value, s.focal_length.value, 1e-9);
	EXPECT_NEAR(s.states[1].focus_distance.value, tilted.FocusDistance(), 0.1);
	EXPECT_LT(s.rms_blur, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Tilts, RigidTilt, testing::Values(Case{ 0, 0 }, Case{ 5, 0 }, Case{ -5, 0 }, Case{ 5, 30 }, Case{ -3, 75 }, Case{ 7, -40 }, Case{ 2, 90 }),
	[](const auto& tested) { return "case" + std::to_string(tested.index); });

TEST(SolveRigid, NoiseComesOutAsSigmaSmallerThanOfPlane)
{
	Lens untilted, tilted = Tilted(5, 30);
	untilted.floor = tilted.floor = 1;
	const Task task = TwoStates(untilted, tilted, { 0.03, 0.06, 11 });
	const Calibration rigid = Calibrate(task, { Model::RIGID, Poses::AUTO }), plane = Calibrate(task, { Model::PLANE, Poses::AUTO });
	const StateLens& lens = rigid.solution.states[1];
	EXPECT_NEAR(lens.lens_tilt.value, 5, 4 * lens.lens_tilt.sigma);
	EXPECT_NEAR(lens.tilt_direction.value, 30, 4 * lens.tilt_direction.sigma);
	// One unknown less per state cannot be known worse.
	EXPECT_LT(lens.lens_tilt.sigma, plane.solution.states[1].lens_tilt.sigma);
	EXPECT_GT(lens.lens_tilt.sigma, 0.0003);
	EXPECT_GT(lens.focus_distance.sigma, 0);
}

TEST(SolveRigid, ThreeStatesShareOneLens)
{
	const Noise noise{ 0.03, 0.06, 4 };
	const Calibration c = Calibrate(MakeTask({ Photograph("untilted", {}, noise), Photograph("plus", Tilted(5), noise), Photograph("minus", Tilted(-5), noise) }), { Model::RIGID, Poses::AUTO });
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 4 * c.solution.states[1].lens_tilt.sigma);
	EXPECT_NEAR(c.solution.states[2].lens_tilt.value, -5, 4 * c.solution.states[2].lens_tilt.sigma);
	EXPECT_NEAR(c.solution.states[1].focal_length.value, c.solution.states[2].focal_length.value, 1e-9);
}

TEST(SolveRigid, OneTiltedPhotographHasNoMirrorImage)
{
	// The mirror image of the plane of focus in the board asks for another focal length,
	// which this model does not have.
	const Noise noise{ 0.02, 0.05, 8 };
	const Calibration c = Calibrate(MakeTask({ Photograph("untilted", {}, noise), Photograph("tilted", Tilted(5), noise, 1) }), { Model::RIGID, Poses::AUTO });
	// The one board's own pose is known to 0.1 degrees or so, and the tilt no better.
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 0.2);
}

TEST(SolveRigid, UntiltedAlone)
{
	Lens lens;
	const Task task = MakeTask({ Photograph("untilted", lens, {}) });
	const Calibration c = Calibrate(task, { Model::RIGID, Poses::AUTO });
	// Untilted both models are the same.
	const Calibration plane = Calibrate(task, { Model::PLANE, Poses::AUTO });
	EXPECT_NEAR(c.solution.focus_distance.value, plane.solution.focus_distance.value, 1e-3);
	EXPECT_NEAR(c.solution.focus_distance.sigma, plane.solution.focus_distance.sigma, 1e-3);
}

TEST(SolveRigid, ALensThatIsRefocusedFitsWorseThanInPlane)
{
	// Another focal length in the tilted state: rigid must show that it does not hold.
	Lens tilted = Tilted(5);
	tilted.f = 44.4;
	const Task task = TwoStates({}, tilted, { 0.02, 0.05, 9 });
	EXPECT_GT(Calibrate(task, { Model::RIGID, Poses::AUTO }).solution.rms_blur, 2 * Calibrate(task, { Model::PLANE, Poses::AUTO }).solution.rms_blur);
}

}
