// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Boards and people as they are: what is wrong is named in the verdict, and a set in which nothing is wrong is left in peace.

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "calibrate/check_photographs.h"
#include "calibrate/thin_lens.h"
#include "calibrate/verdict.h"
#include "model/pose_difference.h"
#include "solve/solve_geometry.h"
#include "report/write_csv.h"
#include "report/write_json.h"
#include "support/synthetic_lens.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace tiltcal;
using namespace synthetic;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

/// As measured in clean renders: corners to 0.03 px, blur to 0.06 px.
Noise NoiseOf(unsigned seed) { return { 0.03, 0.06, seed }; }

const CalibrateOptions PLANE{ Model::PLANE, Poses::AUTO };

auto Says(const std::string& words) { return Contains(Field(&Remark::text, HasSubstr(words))); }

void NameFiles(Task& task)
{
	for (State& state : task.states)
		for (size_t p = 0; p < state.photos.size(); ++p)
			state.photos[p].file = fmt::format("{}-{}.png", state.name, p + 1);
}

Task Named(std::vector<State> states)
{
	Task task = MakeTask(std::move(states));
	NameFiles(task);
	return task;
}

std::string Text(const Verdict& verdict)
{
	std::string text;
	for (const Remark& r : verdict.remarks)
		text += std::string(NameOf(r.grade)) + ": " + r.text + "\n";
	return text;
}

TEST(BoardsAndPeople, NothingIsSaidOfAGoodSet)
{
	for (const unsigned seed : { 11u, 21u })
	{
		const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(seed)), Photograph("tilted", Tilted(5, 30), NoiseOf(seed + 1)) }), PLANE);
		EXPECT_THAT(c.photographs, Each(AllOf(Field(&PhotographCheck::odd_blur, false), Field(&PhotographCheck::odd_places, false), Field(&PhotographCheck::same_as, std::nullopt))));
		EXPECT_EQ(c.verdict.grade, Grade::GOOD) << Text(c.verdict);
		for (const char* const word : { "board is not", "blur says", "same photograph", ".png", "touched between", "stand still", "developed alike" })
			EXPECT_THAT(c.verdict.remarks, Not(Says(word)));
		EXPECT_TRUE(c.board_check.known && c.untilted_check.known);
		// Four numbers about nothing: 4 sigma each fail once in 4000 runs.
		for (const Estimate& e : { c.board_check.widening, c.board_check.bend_along_columns, c.board_check.bend_along_rows, c.board_check.twist, c.untilted_check.lens_tilt })
			EXPECT_LT(std::abs(e.value), 4 * e.sigma);
	}
}

// The ring was turned by 1 % of the image distance before the lens was tilted. Of 0.05 % a pivot beside the pupil may be the reason: 2 (1 - cos 2.5) = 0.19 %.
TEST(BoardsAndPeople, AFocusThatWasTouchedBetweenTheStatesIsSaid)
{
	for (const double change : { 0.01, -0.01, 0.0005 })
	{
		Lens touched = Tilted(2.5, 30);
		touched.w *= 1 + change;
		const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(31)), Photograph("tilted", touched, NoiseOf(32)) }), PLANE);
		const bool much = std::abs(change) > 0.0019;
		EXPECT_EQ(c.verdict.grade, much ? Grade::POOR : Grade::GOOD) << Text(c.verdict);
		EXPECT_THAT(c.verdict.remarks, much ? testing::Matcher<const std::vector<Remark>&>(Says("Was the focus, or the zoom, touched between the two?")) : Not(Says("touched between")));
	}
}

// What is told of a board's distance is no surer than w, by which it is measured, and true: of twelve that hang together one beyond 4 sigma comes once in 1300 runs at the most.
TEST(BoardsAndPeople, DistancesOfBoardsAreToldAsWIs)
{
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(41)), Photograph("tilted", Tilted(5, 30), NoiseOf(42)) }), PLANE);
	const std::vector<Pose> truth = PosesOfPhotographs(6);
	for (const StateGeometry& state : c.geometry.states)
		for (size_t p = 0; p < state.poses.size(); ++p)
		{
			const double z = state.poses[p][5], sigma = state.pose_sigmas[p][5];
			EXPECT_GE(sigma, z * c.solution.w_mm.sigma / c.solution.w_mm.value * (1 - 1e-9));
			EXPECT_LT(std::abs(z - truth[p][5]), 4 * sigma) << p;
		}
}

TEST(BoardsAndPeople, ThePapersMethodIsNotJudged)
{
	const Task task = Named({ Photograph("untilted", Lens(), NoiseOf(11)), Photograph("tilted", Tilted(5, 30), NoiseOf(12)) });
	const std::string paper = CalibrationJson(Calibrate(task, { Model::PAPER, Poses::AUTO })), plane = CalibrationJson(Calibrate(task, PLANE));
	for (const char* const key : { "\"verdict\"", "\"lens_tilt_model_sigma_deg\"" })
	{
		EXPECT_THAT(paper, Not(HasSubstr(key)));
		EXPECT_THAT(plane, HasSubstr(key));
	}
}

TEST(BoardsAndPeople, ATiltedPhotographAmongTheUntiltedIsNamedWithItsState)
{
	State untilted = Photograph("untilted", Lens(), NoiseOf(1));
	const State tilted = Photograph("tilted", Tilted(5), NoiseOf(2)), more = Photograph("tilted", Tilted(5), NoiseOf(3));
	untilted.photos[2] = more.photos[2];
	const Task task = Named({ untilted, tilted });
	const Calibration c = Calibrate(task, PLANE);
	EXPECT_EQ(c.verdict.grade, Grade::POOR);
	EXPECT_THAT(c.verdict.remarks, Says("untilted-3.png: its blur fits"));
	EXPECT_THAT(c.verdict.remarks, Says("it fits the lens of state tilted"));
	for (const PhotographCheck& p : c.photographs)
		EXPECT_EQ(p.odd_blur, p.state == 0 && p.photo == 2) << task.states[p.state].photos[p.photo].file;
	EXPECT_THAT(PhotographsCsv(c), testing::ContainsRegex("untilted,untilted-3.png,.*,1,tilted,"));
	// Sharpened as by an unsharp mask of 1 px and 0.8, which takes 3 px² off a blur, it would miss by 6 px² at most; it misses by its own blur, some 10 px, and is named all the same.
	Calibration sharpened = c;
	sharpened.light.sharpening = { 3, 0.1 };
	const Verdict verdict = Judge(sharpened);
	EXPECT_THAT(verdict.remarks.front().text, HasSubstr("were sharpened"));
	EXPECT_THAT(verdict.remarks, Says("it fits the lens of state tilted: file it there"));
}

/// Each of them from a state of its own.
State Mixed(const std::string& name, const std::vector<Lens>& lenses, unsigned seed)
{
	State state = Photograph(name, lenses[0], NoiseOf(seed));
	for (size_t p = 0; p < state.photos.size(); ++p)
		state.photos[p] = Photograph(name, lenses[p % lenses.size()], NoiseOf(seed + 1)).photos[p];
	return state;
}

Lens Focused(Lens lens, double inverse_mm)
{
	lens.f = 1 / (1 / lens.f + inverse_mm);
	return lens;
}

// By 5 % of 1/U and back, from one photograph to the next: an autofocus that hunts. Nobody stands out where all do.
TEST(BoardsAndPeople, AFocusThatMovesBetweenPhotographsIsSaid)
{
	const double change = 0.05 / Lens().FocusDistance();
	std::vector<State> states;
	for (const Lens& lens : { Lens(), Tilted(5, 30) })
		states.push_back(Mixed(states.empty() ? "untilted" : "tilted", { lens, Focused(lens, change), Focused(lens, -change) }, 51));
	const Calibration c = Calibrate(Named(states), PLANE);
	EXPECT_EQ(c.verdict.grade, Grade::POOR) << Text(c.verdict);
	EXPECT_THAT(c.verdict.remarks, AllOf(Says("did not stand still"), Not(Says("aberrations")))) << Text(c.verdict);
}

// A telephoto's tilted photograph at the end of its range misfits the thin lens by 4.81 px of blur, the others by 0.85: aberrations, which a real lens has.
TEST(BoardsAndPeople, APhotographThatARealLensExplainsDoesNotStandOut)
{
	std::vector<PhotographCheck> thin(4);
	for (size_t p = 0; p < thin.size(); ++p)
	{
		thin[p].photo = p;
		thin[p].edges = p + 1;
		thin[p].rms_blur = 0.85;
	}
	thin[3].rms_blur = 4.81;
	thin[3].odd_blur = thin[3].odd_places = true;
	thin[3].fits_state = 1;
	RealLens lens;
	lens.blur_errors_px.assign(10, 0.1);
	std::vector<PhotographCheck> seen = thin;
	ClearByRealLens(lens, seen);
	EXPECT_FALSE(seen[3].odd_blur || seen[3].fits_state);
	EXPECT_TRUE(seen[3].odd_places);
	// One that is not of this state misfits the real lens too: by its own blur.
	std::fill_n(lens.blur_errors_px.begin() + 6, 4, -3.);
	seen = thin;
	ClearByRealLens(lens, seen);
	EXPECT_TRUE(seen[3].odd_blur && seen[3].fits_state);
	EXPECT_DOUBLE_EQ(seen[3].rms_blur, 4.81);
}

TEST(BoardsAndPeople, AResidualTiltIsSeenAndCanBeLetFree)
{
	for (const double residual : { 0.3, 1.0 })
	{
		const Lens almost = Tilted(residual, 40), tilted = Tilted(5, 90);
		Task task = Named({ Photograph("untilted", almost, NoiseOf(4)), Photograph("tilted", tilted, NoiseOf(5)) });
		const Calibration held = Calibrate(task, PLANE);
		EXPECT_EQ(held.verdict.grade, residual > 0.5 ? Grade::POOR : Grade::FAIR) << Text(held.verdict);
		EXPECT_THAT(held.verdict.remarks, AllOf(Says("its blur says that the lens is tilted by"), Not(Says("aberrations"))));
		task.untilted_free = true;
		const Calibration free = Calibrate(task, PLANE);
		EXPECT_THAT(free.verdict.remarks, Not(Says("its blur says")));
		for (const auto& [state, lens] : { std::pair(size_t(0), almost), std::pair(size_t(1), tilted) })
		{
			const StateLens& found = free.solution.states[state];
			const double sigma = std::hypot(found.lens_tilt.sigma, found.tilt_direction.sigma * std::abs(lens.tilt) * 0.01745);
			EXPECT_LT(TiltError(found, lens), 4 * sigma);
		}
	}
}

TEST(BoardsAndPeople, APrintThatIsOffInOneAxisIsFound)
{
	const Shape wide{ 0.01, 0 };
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(6), 6, 0, wide), Photograph("tilted", Tilted(5), NoiseOf(7), 6, 0, wide) }), PLANE);
	EXPECT_EQ(c.verdict.grade, Grade::POOR);
	EXPECT_THAT(c.verdict.remarks, AllOf(Says("wider than high"), Not(Says("bent"))));
	EXPECT_NEAR(c.board_check.widening.value, 0.01, 4 * c.board_check.widening.sigma);
}

TEST(BoardsAndPeople, ABentBoardIsFound)
{
	for (const double bend : { -1.0, 1.0 })
	{
		const Shape bent{ 0, bend };
		const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(6), 6, 0, bent), Photograph("tilted", Tilted(5), NoiseOf(7), 6, 0, bent) }), PLANE);
		EXPECT_NE(c.verdict.grade, Grade::GOOD);
		EXPECT_THAT(c.verdict.remarks, AllOf(Says("over its width"), Not(Says("wider"))));
		EXPECT_NEAR(c.board_check.bend_along_columns.value, bend, 4 * c.board_check.bend_along_columns.sigma);
	}
}

TEST(BoardsAndPeople, ABoardBentAlongItsRowsOrTwistedIsFound)
{
	const std::tuple<Shape, Estimate BoardCheck::*, double, const char*> boards[] = { { { 0, 0, 1, 0 }, &BoardCheck::bend_along_rows, 1, "over its height" },
		{ { 0, 0, 0, -1 }, &BoardCheck::twist, -1, "its corners are twisted" } };
	for (const auto& [shape, number, truth, words] : boards)
	{
		const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(6), 6, 0, shape), Photograph("tilted", Tilted(5), NoiseOf(7), 6, 0, shape) }), PLANE);
		EXPECT_NE(c.verdict.grade, Grade::GOOD);
		EXPECT_THAT(c.verdict.remarks, AllOf(Says(words), Not(Says("over its width"))));
		EXPECT_NEAR((c.board_check.*number).value, truth, 4 * (c.board_check.*number).sigma);
	}
}

// A bowl of the field and a bent board both blur corners: with the model free, what is told of a bent board is that, not a lens that is good.
TEST(BoardsAndPeople, ABentBoardsFieldCurvatureIsNoGoodCalibration)
{
	const Shape bent{ 0, 1 };
	CalibrateOptions free;
	free.poses = Poses::OWN;
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(6), 6, 0, bent), Photograph("tilted", Tilted(5), NoiseOf(7), 6, 0, bent) }), free);
	EXPECT_NE(c.verdict.grade, Grade::GOOD);
	EXPECT_THAT(c.verdict.remarks, Says("over its width"));
}

TEST(BoardsAndPeople, AForeignBoardsPhotographIsNamed)
{
	State tilted = Photograph("tilted", Tilted(5), NoiseOf(2));
	tilted.photos[4] = Photograph("tilted", Tilted(5), NoiseOf(2), 6, 0, { 0.05, 3 }).photos[4];
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(1)), tilted }), PLANE);
	EXPECT_EQ(c.verdict.grade, Grade::POOR);
	EXPECT_THAT(c.verdict.remarks, Says("tilted-5.png: its corners fit"));
}

TEST(BoardsAndPeople, TheSamePhotographTwiceIsSeenAndABoardThatStoodStillIsNot)
{
	State twice = Photograph("tilted", Tilted(5), NoiseOf(8));
	twice.photos.push_back(twice.photos[1]);
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(9)), twice }), PLANE);
	EXPECT_EQ(c.verdict.grade, Grade::FAIR);
	EXPECT_THAT(c.verdict.remarks, Says("tilted-7.png and tilted-2.png are the same photograph"));

	// Encoded anew, which moves what is measured by half of its sigma.
	int sign = 1;
	for (Edge& e : twice.photos.back().edges)
		e.blur += (sign = -sign) * 0.5 * e.blur_sigma;
	for (Corner& corner : twice.photos.back().corners)
		corner.x += (sign = -sign) * 0.5 * corner.sigma;
	EXPECT_THAT(Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(9)), twice }), PLANE).verdict.remarks, Says("tilted-7.png and tilted-2.png are the same photograph"));

	State still = Photograph("tilted", Tilted(5), NoiseOf(8));
	still.photos.push_back(Photograph("tilted", Tilted(5), NoiseOf(10)).photos[1]);
	EXPECT_THAT(Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(9)), still }), PLANE).verdict.remarks, Not(Says("same photograph")));
}

TEST(BoardsAndPeople, OneUntiltedPhotographKnowsItsImageDistanceAsWellAsItSays)
{
	// A principal point 15 px, one of its sigmas, from the picture's centre.
	Lens lens, tilted = Tilted(5);
	lens.cx = tilted.cx += 15;
	lens.cy = tilted.cy -= 15;
	for (const unsigned seed : { 1u, 2u, 3u })
	{
		const Calibration c = Calibrate(Named({ Photograph("untilted", lens, NoiseOf(seed), 1), Photograph("tilted", tilted, NoiseOf(seed + 10), 1) }), PLANE);
		EXPECT_TRUE(c.geometry.states[0].principal_point_fixed);
		EXPECT_GT(c.geometry.states[0].principal_point_sigma[0], 0);
		EXPECT_LT(std::abs(c.solution.w_mm.value - lens.w), 3 * c.solution.w_mm.sigma) << c.solution.w_mm.value << " +- " << c.solution.w_mm.sigma;
		EXPECT_THAT(c.verdict.remarks, Says("give or take 2 %"));
	}
}

TEST(BoardsAndPeople, TheSquaresSigmaReachesWhatGrowsWithTheBoard)
{
	Task task = Named({ Photograph("untilted", Lens(), NoiseOf(1)), Photograph("tilted", Tilted(5), NoiseOf(2)) });
	const Calibration exact = Calibrate(task, PLANE);
	const double relative = 0.01;
	task.board.square_sigma_mm = relative * task.board.square_mm;
	const Calibration about = Calibrate(task, PLANE);
	task.board.square_mm *= 1 + relative;
	task.board.square_sigma_mm = 0;
	const Calibration larger = Calibrate(task, PLANE);
	const auto expect = [&](const Estimate& a, const Estimate& with, const Estimate& b, const char* what)
	{
		EXPECT_NEAR(a.value, with.value, 1e-6 * a.sigma) << what;
		// First order in `relative`: to 1 %, twice that for products.
		EXPECT_NEAR(std::sqrt(with.sigma * with.sigma - a.sigma * a.sigma), std::abs(b.value - a.value), 0.03 * std::abs(b.value - a.value) + 0.1 * a.sigma) << what;
	};
	expect(exact.solution.aperture_diameter, about.solution.aperture_diameter, larger.solution.aperture_diameter, "d");
	expect(exact.solution.focus_distance, about.solution.focus_distance, larger.solution.focus_distance, "U");
	expect(exact.solution.focal_length, about.solution.focal_length, larger.solution.focal_length, "f");
	expect(exact.solution.states[1].lens_tilt, about.solution.states[1].lens_tilt, larger.solution.states[1].lens_tilt, "tilt");
	EXPECT_NEAR(exact.solution.w_mm.sigma, about.solution.w_mm.sigma, 1e-6 * exact.solution.w_mm.sigma);
	EXPECT_NEAR(about.geometry.states[0].pose_sigmas[0][5], relative * about.geometry.states[0].poses[0][5], 1);
}

TEST(BoardsAndPeople, TheCovarianceIsWholeAndAgreesWithTheSigmas)
{
	const Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(1)), Photograph("tilted", Tilted(5), NoiseOf(2)) }), PLANE);
	const NamedCovariance& v = c.solution.covariance;
	const std::vector<std::string> names{ "image_distance_mm", "aperture_diameter_mm", "psf_floor_squared_px2", "untilted.q_z_per_mm", "tilted.q_x_per_mm", "tilted.q_y_per_mm", "tilted.q_z_per_mm" };
	ASSERT_EQ(v.names, names);
	ASSERT_EQ(v.matrix.size(), names.size() * names.size());
	ASSERT_EQ(v.by_photographs.size(), names.size());
	EXPECT_NEAR(std::max(std::sqrt(v.matrix[0]), v.by_photographs[0]), c.solution.w_mm.sigma, 1e-9);
	EXPECT_NEAR(std::max(std::sqrt(v.matrix[4 * names.size() + 4]), v.by_photographs[4]), c.solution.states[1].q_sigma.x, 1e-12);
	for (size_t i = 0; i < names.size(); ++i)
		for (size_t j = 0; j < names.size(); ++j)
			EXPECT_NEAR(v.matrix[i * names.size() + j], v.matrix[j * names.size() + i], 1e-12);
}

TEST(BoardsAndPeople, EqualNumbersInOtherPosesDoNotMisleadThePapersModel)
{
	// Upward, as the paper's model takes it. The same photographs in another order are the same photographs.
	const State untilted = Photograph("untilted", Lens(), NoiseOf(1));
	State tilted = Photograph("tilted", Tilted(5), NoiseOf(2));
	const Calibration in_order = Calibrate(Named({ untilted, tilted }), PLANE);
	std::rotate(tilted.photos.begin(), tilted.photos.begin() + 1, tilted.photos.end());
	const Calibration c = Calibrate(Named({ untilted, tilted }), PLANE);
	ASSERT_TRUE(in_order.geometry.shared_poses);
	ASSERT_FALSE(c.geometry.shared_poses);
	ASSERT_EQ(c.paper.failure, "");
	const Estimate &own = c.paper.states[1].lens_tilt, &shared = in_order.paper.states[1].lens_tilt;
	// Own poses, which the model's missing tilt of the picture moves a little, against the untilted ones'.
	EXPECT_NEAR(own.value, shared.value, 0.5);
}

// Two far boards, badly measured: with distortion nobody knows w, without it w is just known. Then that says whether the boards stood still.
TEST(BoardsAndPeople, PosesAreComparedWithoutTheDistortionThatNobodyCanTell)
{
	const Task task = Named({ Photograph("untilted", Lens(), { 2.66, 0.06, 2 }, 2, 600), Photograph("tilted", Tilted(5), { 2.66, 0.06, 3 }, 2, 600) });
	for (const bool shared : { false, true })
	{
		ASSERT_FALSE(SolveGeometryIfDetermined(task, { 2, {}, shared }));
		ASSERT_TRUE(SolveGeometryIfDetermined(task, { 0, {}, shared }));
	}
	EXPECT_TRUE(PosesAreShared(task, {}, PLANE));
	Task moved = task;
	std::swap(moved.states[1].photos[0], moved.states[1].photos[1]);
	EXPECT_FALSE(PosesAreShared(moved, {}, PLANE));
}

// By the components that sigmas are of; at half a turn, where the same rotation is the vector and its opposite, too.
TEST(BoardsAndPeople, PosesDifferByTheirRotationVectors)
{
	const Pose rolled{ 0.1, 0.02, M_PI / 2, 1, 2, 3 }, other{ 0.13, 0, M_PI / 2, 1, 5, 3 };
	const Pose difference = FromPoseTo(rolled, other);
	const Pose expected{ 0.03, -0.02, 0, 0, 3, 0 };
	for (size_t k = 0; k < 6; ++k)
		EXPECT_NEAR(difference[k], expected[k], 1e-12) << k;
	const Pose before{ 0, 0, M_PI - 0.01, 0, 0, 0 }, beyond{ 0, 0, -M_PI + 0.01, 0, 0, 0 };
	EXPECT_NEAR(FromPoseTo(before, beyond)[2], 0.02, 1e-12);
	EXPECT_NEAR(FromPoseTo(beyond, before)[2], -0.02, 1e-12);
	EXPECT_EQ(FromPoseTo(before, Pose{})[2], 0.01 - M_PI);
}

// A program of its own may have thrown edges out. Corners still tell the pose; halves of one edge have none.
TEST(BoardsAndPeople, APhotographWithoutEdgesHasItsPoseByCorners)
{
	for (const size_t left : { 0u, 1u })
		for (const Model model : { Model::PLANE, Model::CURVED })
		{
			SCOPED_TRACE(fmt::format("{} edges", left));
			Task task = Named({ Photograph("untilted", Lens(), NoiseOf(1)), Photograph("tilted", Tilted(5), NoiseOf(2)) });
			task.states[1].photos[2].edges.resize(left);
			const Calibration c = Calibrate(task, { model, Poses::OWN });
			EXPECT_NEAR(c.solution.states[1].lens_tilt.value, 5, 4 * c.solution.states[1].lens_tilt.sigma);
			for (const double sigma : c.geometry.states[1].pose_sigmas[2])
				EXPECT_GT(sigma, 0) << "known by corners, not exactly";
		}
}

TEST(BoardsAndPeople, AFailedRefinementIsInTheVerdict)
{
	Task task = Named({ Photograph("untilted", Lens(), NoiseOf(1)), Photograph("tilted", Tilted(5), NoiseOf(2)) });
	ASSERT_TRUE(Calibrate(task, PLANE).refined);
	// A brightness that is no number, as floats may have it: corners and blur, each alone, are solved all the same.
	for (int k = -6; k <= 6; ++k)
		task.states[1].photos[2].edges[10].profile.push_back({ float(k), k ? 0.5f : NAN, 10 });
	std::vector<std::string> warnings;
	CalibrateOptions options = PLANE;
	options.refinement = Refinement::PHOTOMETRIC;
	options.log = Log([&](Severity severity, const std::string& text) { if (severity == Severity::WARNING) warnings.push_back(text); });
	const Calibration c = Calibrate(task, options);
	EXPECT_FALSE(c.refined);
	EXPECT_EQ(c.verdict.grade, Grade::POOR);
	EXPECT_THAT(c.verdict.remarks, Says("the joint refinement did not converge"));
	EXPECT_THAT(warnings, Contains(HasSubstr("the joint refinement did not converge")));
	EXPECT_THAT(CalibrationJson(c), HasSubstr("\"converged\": false"));
}

TEST(BoardsAndPeople, WhatIsKnownBetterFollowsTheCorrelationsSign)
{
	Calibration c = Calibrate(Named({ Photograph("untilted", Lens(), NoiseOf(1)), Photograph("tilted", Tilted(5), NoiseOf(2)) }), PLANE);
	c.solution.correlations = { { "image_distance", "focus_distance", 0.99 }, { "image_distance", "aperture_diameter", -0.99 }, { "a.q_x", "b.q_x", 0.99 }, { "a.q_y", "b.q_y", -0.99 }, { "image_distance", "a.q_y", 0.99 } };
	const std::vector<Remark> remarks = Judge(c).remarks;
	for (const char* const words : { "their ratio", "their product", "their difference", "their sum", "their combination" })
		EXPECT_THAT(remarks, Says(words));
}

}
