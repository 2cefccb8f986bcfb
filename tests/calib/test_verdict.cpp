// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the verdict says of a calibration that something is wrong with, or was not asked for; each made from a good one, so that nothing else is.

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "calibrate/verdict.h"
#include "model/tilt_angles.h"
#include "report/report_html.h"
#include "report/write_json.h"
#include "solve/solve_joint.h"
#include "support/code_of.h"
#include "support/synthetic_lens.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace tiltcal;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

auto Says(Grade grade, const std::string& words) { return Contains(AllOf(Field(&Remark::grade, grade), Field(&Remark::text, HasSubstr(words)))); }

/// As measured in clean renders.
Task TwoStates() { return synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 }); }

const CalibrateOptions PLANE{ Model::PLANE, Poses::OWN };

const Calibration& Good()
{
	static const Calibration c = Calibrate(TwoStates(), PLANE);
	return c;
}

/// With a change.
template<typename Change>
Verdict JudgedWith(const Change& change)
{
	Calibration c = Good();
	change(c);
	return Judge(c);
}

TEST(Verdict, IsGoodOfAGoodOne) { EXPECT_EQ(Judge(Good()).grade, Grade::GOOD) << testing::PrintToString(Judge(Good()).remarks.size()); }

// Three and ten times the hundredth that is wanted of them.
TEST(Verdict, GradesTheApertureAndTheFocus)
{
	const auto of_aperture = [](double relative) { return JudgedWith([&](Calibration& c) { c.solution.aperture_diameter.sigma = relative * c.solution.aperture_diameter.value; }); };
	EXPECT_EQ(of_aperture(0.02).grade, Grade::GOOD);
	EXPECT_THAT(of_aperture(0.05).remarks, Says(Grade::FAIR, "the aperture is known to 5 % only"));
	EXPECT_THAT(of_aperture(0.2).remarks, Says(Grade::POOR, "the aperture is known to 20 % only"));
	const auto of_focus = [](double relative) { return JudgedWith([&](Calibration& c) { c.solution.states[0].q_sigma.z = relative * c.solution.states[0].q.z; }); };
	EXPECT_EQ(of_focus(0.02).grade, Grade::GOOD);
	// The boards stand about the plane of focus: their mean 1/z is its own, to a third.
	EXPECT_THAT(of_focus(0.05).remarks, Says(Grade::FAIR, "where the lens is focused is known to"));
	EXPECT_THAT(of_focus(0.2).remarks, Says(Grade::POOR, "where the lens is focused is known to"));
}

TEST(Verdict, GradesTheTiltOfAnUntiltedStateThatIsFree)
{
	const auto with = [](bool free) { return JudgedWith([&](Calibration& c) { c.task.untilted_free = free; c.solution.states[0].lens_tilt.sigma = 0.2; }); };
	EXPECT_THAT(with(false).remarks, Not(Says(Grade::POOR, "the tilt is known to")));
	EXPECT_THAT(with(true).remarks, Says(Grade::POOR, fmt::format("state {}: the tilt is known to 0.20 degrees only", Good().task.states[0].name)));
}

TEST(Verdict, SaysWhatCouldNotBeChecked)
{
	EXPECT_THAT(JudgedWith([](Calibration& c) { c.untilted_check = {}; }).remarks, Says(Grade::FAIR, "whether its lens stands straight could not be checked"));
	EXPECT_EQ(JudgedWith([](Calibration& c) { c.untilted_check = {}; c.task.untilted_free = true; }).grade, Grade::GOOD) << "nothing to check";
	EXPECT_THAT(JudgedWith([](Calibration& c) { c.board_check = {}; }).remarks, Says(Grade::FAIR, "whether the board is as it was told could not be checked"));
	ASSERT_FALSE(Good().solution.left_out.empty());
	EXPECT_THAT(JudgedWith([](Calibration& c) { c.solution.left_out.pop_back(); }).remarks, Says(Grade::FAIR, "without 1 of its"));
}

// Blur that fits worse than its noise is glass: a thin lens that was forced on it may be several sigmas off.
TEST(Verdict, AForcedThinLensThatMisfitsIsNotGood)
{
	const auto with = [](bool tried) { return JudgedWith([&](Calibration& c) { c.solution.rms_blur = 1; if (tried) c.real_lens = RealLens{}; }); };
	EXPECT_THAT(with(false).remarks, Says(Grade::FAIR, "Leave `model` and `effects` free"));
	EXPECT_THAT(with(true).remarks, Says(Grade::GOOD, "the sigmas hold them only as far as parts of the edges put the lens apart"));
	EXPECT_EQ(with(true).grade, Grade::GOOD);
}

// Blur and places, each alone, 0.4 degrees apart across the tilt, where one of them knows that direction to 0.2 degrees, and to 0.05.
TEST(Verdict, BlurAndPlacesAreHeldAgainstEachOtherAsWellAsTheyAreKnown)
{
	const auto with = [](double across)
	{
		return JudgedWith([&](Calibration& c)
		{
			StateLens lens;
			lens.lens_tilt = { 5, 0.01 };
			lens.tilt_direction = { 30, 0.01 };
			c.blur_alone = { lens, lens };
			lens.tilt_direction = { 30 + 0.4 / 5 * 180 / M_PI, across / 5 * 180 / M_PI };
			c.geometry_alone.states = { lens, lens };
		});
	};
	EXPECT_THAT(with(0.2).remarks, Not(Contains(Field(&Remark::text, HasSubstr("disagree")))));
	EXPECT_THAT(with(0.05).remarks, Says(Grade::FAIR, "disagree by 0.40 degrees (8 sigma)"));
}

// Geometry and blur one after the other: that is said, and not that there were too few photographs.
TEST(Verdict, WithoutRefinementIsSaid)
{
	CalibrateOptions options = PLANE;
	options.refinement = Refinement::NONE;
	const Calibration c = Calibrate(TwoStates(), options);
	EXPECT_TRUE(c.refined);
	EXPECT_THAT(c.verdict.remarks, Says(Grade::FAIR, "geometry and blur were not refined together"));
	const std::string report = ReportHtml(c, { "none", "", "" }, ReportPictures(c.task));
	EXPECT_THAT(report, HasSubstr("Geometry and blur were not refined together"));
	EXPECT_THAT(report, Not(HasSubstr("too few photographs to judge")));
}

// Places, lens and sigmas of the camera without distortion are one fit's, where there is none to leave out.
TEST(Calibrated, WithoutDistortionThereIsOneCamera)
{
	const Calibration& c = Good();
	ASSERT_EQ(c.geometry.distortion_terms, 0);
	EXPECT_EQ(c.pinhole.w_px, c.geometry.w_px);
	EXPECT_DOUBLE_EQ(c.pinhole.w_px * c.task.pitch_mm, c.render.w_mm.value);
	for (size_t s = 0; s < 2; ++s)
	{
		EXPECT_EQ(c.pinhole.states[s].principal_point, c.geometry.states[s].principal_point);
		EXPECT_EQ(c.pinhole.states[s].poses, c.geometry.states[s].poses);
	}
}

TEST(Calibrated, AStateWithoutEdgesIsNoAnswer)
{
	Calibration c = Good();
	for (Photo& photo : c.task.states[1].photos)
		photo.edges.clear();
	EXPECT_FALSE(RefineJointly(c.task, Refinement::EDGES, c.geometry, c.solution));
}

TEST(Calibrated, TasksThatContradictThemselvesAreRefused)
{
	Task flat = TwoStates(), prior = TwoStates();
	flat.flat_fields.push_back({ 2, "flat.png", {} });
	prior.priors.push_back({ Quantity::FOCAL_LENGTH, 45, 0 });
	for (const Task& task : { flat, prior })
		EXPECT_EQ(CodeOf([&] { Calibrate(task, PLANE); }), EXIT_USAGE);
}

}
