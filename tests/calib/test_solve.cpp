// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The whole solver on widths and corners built ray by ray (synthetic_lens.h), back to
// the parameters they were built from.

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "solve/solve_lens.h"
#include "solve/solve_geometry.h"
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

class EveryTilt : public testing::TestWithParam<Case> {};

TEST_P(EveryTilt, ComesBackWithoutNoise)
{
	Lens untilted, tilted = Tilted(GetParam().tilt, GetParam().direction);
	tilted.cy += 5;    // a real lens's picture moves when it is tilted
	const Calibration c = Calibrate(TwoStates(untilted, tilted), { Model::PLANE, Poses::AUTO });
	const Solution& s = c.solution;
	// Corners are exact, so w is: only the solver's tolerance is left.
	EXPECT_NEAR(s.w_mm.value, untilted.w, 1e-3);
	EXPECT_NEAR(c.geometry.states[1].principal_point[1], tilted.cy, 0.01);
	// Left out is what is of second order in the aperture, (d/2)^2 |q|^2 = 4e-4 of the blur at most.
	EXPECT_NEAR(s.aperture_diameter.value, untilted.d, 0.001 * untilted.d);
	EXPECT_NEAR(s.states[0].focus_distance.value, untilted.FocusDistance(), 0.1);
	EXPECT_NEAR(s.states[1].focus_distance.value, tilted.FocusDistance(), 0.2);
	EXPECT_NEAR(s.states[1].focal_length.value, tilted.f, 0.002);
	EXPECT_LT(TiltError(s.states[1], tilted), 0.002);
	EXPECT_LT(s.rms_blur, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Tilts, EveryTilt, testing::Values(Case{ 0, 0 }, Case{ 5, 0 }, Case{ -5, 0 }, Case{ 5, 30 }, Case{ -3, 75 }, Case{ 7, -40 }, Case{ 2, 90 }, Case{ 1, 200 }, Case{ 8, 130 }),
	[](const auto& tested) { return "case" + std::to_string(tested.index); });

TEST(SolvePlane, NoiseComesOutAsSigma)
{
	Lens untilted, tilted = Tilted(5, 30);
	untilted.floor = tilted.floor = 1;
	const Calibration c = Calibrate(TwoStates(untilted, tilted, { 0.03, 0.06, 11 }), { Model::PLANE, Poses::AUTO });
	const StateLens& lens = c.solution.states[1];
	// The noise floor: some thousandths of a degree for six photographs with 0.06 px per edge.
	EXPECT_LT(lens.lens_tilt.sigma, 0.01);
	EXPECT_GT(lens.lens_tilt.sigma, 0.0005);
	EXPECT_NEAR(lens.lens_tilt.value, 5, 4 * lens.lens_tilt.sigma);
	EXPECT_NEAR(lens.tilt_direction.value, 30, 4 * lens.tilt_direction.sigma);
	EXPECT_NEAR(c.solution.w_mm.value, 48, 4 * c.solution.w_mm.sigma);
	// The floor is told from the blur: 942 edges, most of them far above it.
	EXPECT_NEAR(c.solution.psf_floor_px.value, 1, 0.1);
}

TEST(SolvePlane, OneOutlierInTenDoesNotMoveIt)
{
	Task task = TwoStates({}, Tilted(5), { 0.02, 0.05, 3 }, { 0.02, 0.05, 4 });
	int k = 0;
	for (State& state : task.states)
		for (Photo& photo : state.photos)
			for (Edge& e : photo.edges)
				if (k++ % 10 == 0)
					e.blur += 6;
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::AUTO });
	// Plain least squares is off by more than 0.3 degrees here.
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 0.1);
}

TEST(SolvePlane, OwnPosesWhenTheBoardsMoved)
{
	const Calibration c = Calibrate(MakeTask({ Photograph("untilted", {}, {}), Photograph("tilted", Tilted(-4), {}, 6, 15) }), { Model::PLANE, Poses::AUTO });
	EXPECT_FALSE(c.geometry.shared_poses);
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, -4, 0.03);
}

TEST(SolvePlane, SharedPosesAreSeen)
{
	EXPECT_TRUE(Calibrate(TwoStates({}, Tilted(-4), { 0.03, 0.05, 5 }), { Model::PLANE, Poses::AUTO }).geometry.shared_poses);
}

TEST(SolvePaper, StageOneIsExactUntilted)
{
	// Untilted the paper's (2) is the exact blur, so (3) must give back everything.
	Lens lens;
	const Task task = MakeTask({ Photograph("untilted", lens, {}) });
	Geometry found;
	const Solution s = SolvePaper(task, SolveGeometry(task, {}), found);
	ASSERT_EQ(s.failure, "");
	EXPECT_NEAR(s.w_mm.value, lens.w, 0.05);
	EXPECT_NEAR(s.focus_distance.value, lens.FocusDistance(), 1);
	// The blur of a feature is the mean of its edges': at the rim of the board it belongs to a
	// place a third of a square further in, and at the focus the mean of |b| is not the |b|
	// of the mean. Both make the blur look smaller, by 2 % here.
	EXPECT_NEAR(s.aperture_diameter.value, lens.d, 0.03 * lens.d);
}

TEST(SolvePaper, StageTwoFindsTheSignAndASizeNearIt)
{
	// (4) is an approximation: of one board 0.2 to 4.7 for a true 5, by its pose (povray-patch/lens/MODEL.md). Of several: between a half and the whole, or so.
	for (const double tilt : { 5.0, -5.0 })
	{
		const Task task = TwoStates({}, Tilted(tilt));
		Geometry found;
		const Solution s = SolvePaper(task, SolveGeometry(task, {}), found);
		ASSERT_EQ(s.failure, "");
		EXPECT_GT(s.states[1].lens_tilt.value / tilt, 0.4);
		EXPECT_LT(s.states[1].lens_tilt.value / tilt, 1.2);
		// (1), with what the model itself found.
		const double theta = s.states[1].focal_plane_tilt.value * M_PI / 180;
		EXPECT_NEAR(std::tan(s.states[1].lens_tilt.value * M_PI / 180),
			s.w_mm.value * std::tan(theta) / (s.focus_distance.value + s.w_mm.value), 1e-9);
	}
}

TEST(SolvePlane, OneTiltedPhotographIsNotMistakenForItsMirrorImage)
{
	// |1 - q.P| of one board fits two planes of focus exactly; the focal length decides.
	const Noise noise{ 0.02, 0.05, 8 };
	const Calibration c = Calibrate(MakeTask({ Photograph("untilted", {}, noise), Photograph("tilted", Tilted(5), noise, 1) }), { Model::PLANE, Poses::AUTO });
	// The one board's own pose is known to 0.1 degrees or so, and the tilt no better.
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 0.2);
}

/// Why it was refused, or "" when it was not.
std::string Refusal(const Task& task, Model model = Model::PLANE)
{
	try
	{
		Calibrate(task, { model, Poses::AUTO });
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_REFUSED);
		return e.what();
	}
	return "";
}

TEST(Refuses, BoardParallelToTheSensor)
{
	EXPECT_THAT(Refusal(MakeTask({ PhotographParallel("untilted", {}, 600) })), testing::HasSubstr("inclined"));
}

TEST(Refuses, EverythingInFocus)
{
	// An aperture of 0.2 mm: the blur is below the noise everywhere.
	Lens lens;
	lens.d = 0.2;
	lens.floor = 1;
	EXPECT_THAT(Refusal(MakeTask({ Photograph("untilted", lens, { 0.02, 0.05, 2 }) })), testing::HasSubstr("blur"));
}

TEST(Refuses, TooFewEdges)
{
	Task task = MakeTask({ Photograph("untilted", Lens(), {}, 1) });
	task.states[0].photos[0].edges.resize(10);
	EXPECT_THAT(Refusal(task), testing::HasSubstr("only 10 edges"));
}

}
