// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The hard cases of calibration (povray-patch/lens/MODEL.md): solved, or refused with what to photograph instead, or with a
// verdict that says so; never a confident wrong answer.

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "support/synthetic_lens.h"
#include "calibrate/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{

using namespace tiltcal;
using namespace synthetic;
using testing::HasSubstr;

const Noise NOISE{ 0.03, 0.06, 5 };

/// Refused with advice, or right within what it says of itself.
void ExpectNoConfidentError(const Task& task, const Lens& lens, const std::optional<Model>& model = {})
{
	try
	{
		const Calibration c = Calibrate(task, { model, Poses::AUTO });
		const StateLens& found = c.solution.states[1];
		const double sigma = std::hypot(found.lens_tilt.sigma, found.tilt_direction.sigma * std::abs(lens.tilt) * 0.01745);
		// 0.01: what is of second order in the aperture.
		EXPECT_TRUE(TiltError(found, lens) < 4 * sigma + 0.01 || Judge(c).grade == Grade::POOR)
			<< "off by " << TiltError(found, lens) << " with a sigma of " << sigma << ", verdict " << NameOf(Judge(c).grade);
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_REFUSED);
		EXPECT_THAT(e.what(), HasSubstr("hotograph"));
	}
}

TEST(Degenerate, BlurWithNoSignChange)
{
	// Boards that lie wholly before, or wholly behind the focus at 620 mm.
	for (const double shift : { -220.0, 300.0 })
	{
		const Lens tilted = Tilted(3);
		ExpectNoConfidentError(MakeTask({ Photograph("untilted", Lens(), NOISE, 6, shift), Photograph("tilted", tilted, NOISE, 6, shift) }), tilted, Model::PLANE);
	}
}

TEST(Degenerate, TiltedBoardsAllParallelToTheSensor)
{
	const Lens tilted = Tilted(4, 50);
	ExpectNoConfidentError(MakeTask({ Photograph("untilted", Lens(), NOISE), PhotographParallel("tilted", tilted, 600) }), tilted, Model::PLANE);
}

TEST(Degenerate, OnePhotographOfAState)
{
	const Lens tilted = Tilted(5);
	const Task task = MakeTask({ Photograph("untilted", Lens(), NOISE), Photograph("tilted", tilted, NOISE, 1) });
	ExpectNoConfidentError(task, tilted, Model::PLANE);
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::AUTO });
	const Verdict verdict = Judge(c);
	EXPECT_NE(verdict.grade, Grade::GOOD);
	EXPECT_THAT(verdict.remarks, testing::Contains(testing::Field(&Remark::text, HasSubstr("at least three poses"))));
}

TEST(Degenerate, NoTiltIsFoundToBeNone)
{
	const Calibration c = Calibrate(TwoStates({}, {}, NOISE, { 0.03, 0.06, 6 }), { Model::PLANE, Poses::AUTO });
	EXPECT_LT(std::abs(c.solution.states[1].lens_tilt.value), 4 * c.solution.states[1].lens_tilt.sigma + 0.003);
}

// q = n/f - e_z/w becomes q/1.1 at the same w, and n is the direction of q/1.1 + e_z/w.
TEST(Degenerate, AWrongSquareSizeScalesLengthsAndTheTilt)
{
	// Nothing in the pictures tells a board's size; the focal length does, and may be given.
	const Lens tilted = Tilted(5, 20);
	Task task = TwoStates({}, tilted, NOISE);
	task.board.square_mm *= 1.1;
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::AUTO });
	EXPECT_NEAR(c.solution.w_mm.value, tilted.w, 0.05);
	EXPECT_NEAR(c.solution.focus_distance.value, 1.1 * Lens().FocusDistance(), 2);
	const double across = std::sin(tilted.tilt * M_PI / 180) / tilted.f / 1.1, along = std::cos(tilted.tilt * M_PI / 180) / tilted.f / 1.1 + (1 - 1 / 1.1) / tilted.w;
	EXPECT_NEAR(c.solution.states[1].lens_tilt.value, std::atan2(across, along) * 180 / M_PI, 4 * c.solution.states[1].lens_tilt.sigma);
	task.priors = { { Quantity::FOCAL_LENGTH, tilted.f, 0.01 } };
	// U and w cannot both keep 1/f = 1/U + 1/w then: said, not smoothed over.
	const Calibration held = Calibrate(task, { Model::PLANE, Poses::AUTO });
	const Verdict verdict = Judge(held);
	EXPECT_EQ(verdict.grade, Grade::POOR);
	EXPECT_THAT(verdict.remarks, testing::Contains(testing::Field(&Remark::text, HasSubstr("`square`"))));
}

// CALIBRATING.md: a wrong pitch is invisible. Pixels that are told 1 % too large make w so, and the blur's circles of confusion, which d stands for at that w; U stays.
TEST(Degenerate, AWrongPitchScalesTheCameraAndNothingShowsIt)
{
	const Lens tilted = Tilted(5, 20);
	Task task = TwoStates({}, tilted, NOISE);
	const Calibration right = Calibrate(task, { Model::PLANE, Poses::AUTO });
	task.pitch_mm *= 1.01;
	const Calibration wrong = Calibrate(task, { Model::PLANE, Poses::AUTO });
	const Solution &a = right.solution, &b = wrong.solution;
	// The same numbers in other units but for f, whose 1/f = 1/U + 1/w, and the tilt, of which the direction of q + e_z/w takes 1 %: the disc leans by 0.05 degrees more, 8e-5 of a blur of
	// some ten pixels at the rim.
	EXPECT_NEAR(b.w_mm.value / a.w_mm.value, 1.01, 1e-4);
	EXPECT_NEAR(b.focus_distance.value / a.focus_distance.value, 1, 1e-4);
	EXPECT_NEAR(b.aperture_diameter.value / a.aperture_diameter.value, 1, 1e-4);
	EXPECT_NEAR(b.focal_length.value, 1 / (1 / b.focus_distance.value + 1 / b.w_mm.value), 1e-6);
	EXPECT_NEAR(b.rms_blur, a.rms_blur, 8e-4);
	EXPECT_NEAR(wrong.geometry.rms, right.geometry.rms, 1e-5);
	EXPECT_EQ(wrong.verdict.grade, right.verdict.grade);
}

TEST(Degenerate, ANoisyLensIsSaidToBe)
{
	const Lens tilted = Tilted(5);
	const Calibration c = Calibrate(TwoStates({}, tilted, { 0.5, 1.5, 2 }, { 0.5, 1.5, 3 }), { Model::PLANE, Poses::AUTO });
	EXPECT_LT(TiltError(c.solution.states[1], tilted), 4 * c.solution.states[1].lens_tilt.sigma + 4 * c.solution.states[1].tilt_direction.sigma * 0.0873);
	EXPECT_NE(Judge(c).grade, Grade::GOOD);
}

}
